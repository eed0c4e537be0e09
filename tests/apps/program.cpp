// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <utility>

namespace limpet {
namespace fs = std::filesystem;

bool Finished::one_line_of_error() const {
    return err.rfind("limpet: ", 0) == 0 && std::count(err.begin(), err.end(), '\n') == 1;
}

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Bench::Bench() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        fs::path(testing::TempDir()) / ("limpet_" + std::to_string(getpid()) + "_" + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
}

Bench::~Bench() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

fs::path Bench::write(const std::string& name, const std::string& text) const {
    const fs::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

std::vector<std::string> Bench::files() const {
    std::vector<std::string> list;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
        list.push_back(fs::relative(entry.path(), folder_).string());
    }
    std::sort(list.begin(), list.end());
    return list;
}

std::unique_ptr<Running> Bench::start(const std::vector<std::string>& arguments) const {
    static int count = 0;
    const std::string stem = folder_.string() + "." + std::to_string(++count);
    const fs::path out = stem + ".out";
    const fs::path err = stem + ".err";
    std::vector<std::string> words = {LIMPET_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), flags, 0600);
    posix_spawn_file_actions_addchdir_np(&actions, folder_.c_str());
    pid_t child = -1;
    if (posix_spawn(&child, LIMPET_PROGRAM, &actions, nullptr, argv.data(), environ) != 0) {
        child = -1;
    }
    posix_spawn_file_actions_destroy(&actions);
    return std::make_unique<Running>(child, out, err);
}

Finished Bench::run(const std::vector<std::string>& arguments) const {
    return start(arguments)->wait();
}

Running::Running(int pid, fs::path out, fs::path err)
    : pid_(pid), out_(std::move(out)), err_(std::move(err)) {}

Running::~Running() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        (void)wait();
    }
}

Finished Running::interrupt() {
    if (pid_ > 0) {
        kill(pid_, SIGINT);
    }
    return wait();
}

Finished Running::wait() {
    Finished finished;
    if (pid_ > 0) {
        int status = 0;
        waitpid(pid_, &status, 0);
        finished.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    pid_ = -1;
    finished.out = text_of(out_);
    finished.err = text_of(err_);
    fs::remove(out_);
    fs::remove(err_);
    return finished;
}

}  // namespace limpet
