// SPDX-License-Identifier: Apache-2.0
#include "running.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace limpet::campaign {

Running::Running(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                 const std::vector<std::string>& launcher) {
    std::vector<std::string> words = launcher;
    words.emplace_back(LIMPET_PROGRAM);
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::string log = folder.string() + "/log";
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    if (posix_spawnp(&child_, words.front().c_str(), &actions, nullptr, argv.data(), environ) !=
        0) {
        child_ = 0;
    }
    posix_spawn_file_actions_destroy(&actions);
}

Running::~Running() {
    if (child_ > 0) {
        signal(SIGKILL);
        (void)wait();
    }
}

void Running::signal(int number) const {
    kill(child_, number);
}

int Running::wait() {
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool eventually(const std::function<bool()>& happened) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::seconds(30);
    while (Clock::now() < end) {
        if (happened()) {
            return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

}  // namespace limpet::campaign
