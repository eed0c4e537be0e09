// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>

namespace limpet {
namespace fs = std::filesystem;

bool Finished::one_line_of_error() const {
    return err.rfind("limpet: ", 0) == 0 && std::count(err.begin(), err.end(), '\n') == 1;
}

void expect_line_of_error(const Finished& finished, int exit_code,
                          const std::vector<std::string>& texts) {
    EXPECT_EQ(finished.exit_code, exit_code) << finished.err;
    EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
    for (const std::string& text : texts) {
        EXPECT_THAT(finished.err, testing::HasSubstr(text));
    }
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

/// @return its pid, 0 when it does not start
pid_t spawn(const fs::path& folder, const std::vector<std::string>& arguments, const fs::path& out,
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
    const bool there =
        posix_spawn(&child, LIMPET_PROGRAM, &actions, nullptr, argv.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    return there ? child : 0;
}

}  // namespace

Finished Bench::run(const std::vector<std::string>& arguments) const {
    return run_in(folder_, arguments);
}

Finished Bench::run_in(const fs::path& folder, const std::vector<std::string>& arguments) const {
    const fs::path out = folder_.string() + ".out";
    const fs::path err = folder_.string() + ".err";
    Finished finished;
    if (const pid_t child = spawn(folder, arguments, out, err); child != 0) {
        int status = 0;
        waitpid(child, &status, 0);
        finished.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    finished.out = text_of(out);
    finished.err = text_of(err);
    fs::remove(out);
    fs::remove(err);
    return finished;
}

Started::Started(const fs::path& folder, const std::string& name,
                 const std::vector<std::string>& arguments)
    : out_(folder / (name + ".out")),
      err_(folder / (name + ".err")),
      child_(spawn(folder, arguments, out_, err_)),
      running_(child_ != 0) {}

Started::~Started() {
    if (running_) {
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
    }
}

void Started::signal(int number) const {
    if (running_) {
        kill(child_, number);
    }
}

bool Started::ended(std::chrono::milliseconds limit) {
    if (!running_) {
        return true;
    }
    const int handle = static_cast<int>(syscall(SYS_pidfd_open, child_, 0));
    pollfd watched{.fd = handle, .events = POLLIN, .revents = 0};
    const bool over = poll(&watched, 1, static_cast<int>(limit.count())) > 0;
    close(handle);
    if (over) {
        int status = 0;
        waitpid(child_, &status, 0);
        exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        running_ = false;
    }
    return over;
}

Finished Started::wait(std::chrono::seconds limit) {
    Finished finished;
    finished.exit_code = ended(limit) ? exit_code_ : -1;
    finished.out = text_of(out_);
    finished.err = text_of(err_);
    return finished;
}

bool Started::prints(const std::string& text, std::chrono::seconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (std::chrono::steady_clock::now() < end) {
        const bool over = ended(std::chrono::milliseconds(10));
        if (output().find(text) != std::string::npos) {
            return true;
        }
        if (over) {
            return false;
        }
    }
    return false;
}

std::string Started::output() const {
    return text_of(out_);
}

std::string on_terminal(std::vector<std::string> arguments, unsigned short columns) {
    arguments.insert(arguments.begin(), LIMPET_PROGRAM);
    std::vector<char*> argv;
    for (std::string& word : arguments) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const struct winsize size = {.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
        execv(LIMPET_PROGRAM, argv.data());
        _exit(127);
    }
    std::string all;
    char part[4096];
    for (ssize_t got = 1; got > 0;) {
        got = read(terminal, part, sizeof part);  // fails once the other end is closed
        all.append(part, static_cast<std::size_t>(std::max<ssize_t>(0, got)));
    }
    close(terminal);
    (void)waitpid(child, nullptr, 0);
    return all;
}

}  // namespace limpet
