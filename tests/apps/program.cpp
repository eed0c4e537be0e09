// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

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

namespace {

/// @return process id, 0 when it could not be started
pid_t spawn(const std::vector<std::string>& arguments, const fs::path& folder, const fs::path& out,
            const fs::path& err) {
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
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    pid_t child = 0;
    const int failed = posix_spawn(&child, LIMPET_PROGRAM, &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return failed == 0 ? child : 0;
}

int exit_code(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Looks every 20 ms until it is so or the time is up.
template <class Condition>
bool comes_true(const Condition& condition, double limit_s) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit_s);
    while (!condition()) {
        if (std::chrono::steady_clock::now() >= end) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
}

}  // namespace

Running::~Running() {
    if (child_ > 0) {
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
    }
}

Finished Running::wait(double limit_s) {
    Finished finished;
    int status = 0;
    if (child_ > 0 &&
        comes_true([&] { return waitpid(child_, &status, WNOHANG) == child_; }, limit_s)) {
        child_ = 0;
        finished.exit_code = exit_code(status);
    }
    finished.out = text_of(out_);
    finished.err = text_of(err_);
    return finished;
}

void Running::interrupt() const {
    if (child_ > 0) {
        kill(child_, SIGINT);
    }
}

bool Running::says(std::string_view text, double limit_s) const {
    return comes_true([&] { return text_of(out_).find(text) != std::string::npos; }, limit_s);
}

std::unique_ptr<Running> Bench::start(const std::string& name,
                                      const std::vector<std::string>& arguments) const {
    const fs::path out = folder_ / (name + ".out");
    const fs::path err = folder_ / (name + ".err");
    return std::make_unique<Running>(spawn(arguments, folder_, out, err), out, err);
}

Finished Bench::run(const std::vector<std::string>& arguments) const {
    const fs::path out = folder_.string() + ".out";
    const fs::path err = folder_.string() + ".err";
    Finished finished;
    if (const pid_t child = spawn(arguments, folder_, out, err); child > 0) {
        int status = 0;
        waitpid(child, &status, 0);
        finished.exit_code = exit_code(status);
    }
    finished.out = text_of(out);
    finished.err = text_of(err);
    fs::remove(out);
    fs::remove(err);
    return finished;
}

}  // namespace limpet
