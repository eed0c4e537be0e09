// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/spawn.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <iterator>
#include <system_error>

namespace limpet {
namespace {

namespace fs = std::filesystem;
using testing::Not;
using testing::StartsWith;

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class Spawn : public testing::Test {
protected:
    Spawn() { fs::create_directories(folder_); }
    ~Spawn() override { fs::remove_all(folder_); }
    fs::path folder_ = fs::temp_directory_path() / ("limpet_spawn_" + std::to_string(getpid()));
};

/// As a library opens one: inheritable until somebody says otherwise.
class Listening {
public:
    explicit Listening(in_port_t wanted = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = wanted;
        socklen_t length = sizeof(address);
        auto* raw = reinterpret_cast<sockaddr*>(&address);
        listens = bind(socket_, raw, length) == 0 && listen(socket_, 1) == 0 &&
                  getsockname(socket_, raw, &length) == 0;
        port = address.sin_port;
    }
    ~Listening() { close(socket_); }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;

    in_port_t port = 0;
    bool listens = false;

private:
    int socket_;
};

TEST_F(Spawn, AProcessHasNoSocketOfOurs) {
    in_port_t port = 0;
    Spawned sleeps;
    {
        const Listening before;
        ASSERT_TRUE(before.listens);
        port = before.port;
        sleeps = spawn({.words = {"sleep", "60"}});
        ASSERT_EQ(sleeps.error, 0);
    }
    EXPECT_TRUE(Listening(port).listens) << "somebody else still has it";
    for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(sleeps.id) + "/fd")) {
        std::error_code gone;  // it may be loading a library
        EXPECT_THAT(fs::read_symlink(entry, gone).string(), Not(StartsWith("socket:")));
    }
    EXPECT_EQ(kill(sleeps.id, SIGKILL), 0);
    const int status = wait_for(sleeps.id);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

TEST_F(Spawn, WordsGoWhereTheyAreSent) {
    const auto run = [this](Program program) {
        program.output = folder_ / "out";
        const Spawned ran = spawn(program);
        EXPECT_EQ(ran.error, 0);
        return WEXITSTATUS(wait_for(ran.id));
    };
    EXPECT_EQ(
        run({.words = {"sh", "-c", "echo a; echo b >&2; cat; pwd; exit 3"}, .folder = folder_}), 3);
    EXPECT_EQ(text_of(folder_ / "out"), "a\nb\n" + fs::canonical(folder_).string() + "\n");
    int ends[2] = {-1, -1};
    ASSERT_EQ(pipe(ends), 0);
    ASSERT_EQ(write(ends[1], "said", 4), 4);
    close(ends[1]);
    EXPECT_EQ(run({.words = {"sh", "-c", "cat; echo b >&2; cut -d' ' -f5 /proc/$$/stat"},
                   .input = ends[0],
                   .errors = folder_ / "err",
                   .own_group = true}),
              0);
    close(ends[0]);
    EXPECT_EQ(text_of(folder_ / "err"), "b\n");
    EXPECT_EQ(text_of(folder_ / "out").substr(0, 4), "said");
    EXPECT_NE(std::stoi(text_of(folder_ / "out").substr(4)), getpgrp());
}

TEST_F(Spawn, NoProcessIsSaid) {
    const Spawned none = spawn({.words = {"limpet_no_such_program"}});
    EXPECT_EQ(none.id, 0);
    EXPECT_EQ(none.error, ENOENT);
    EXPECT_EQ(wait_for(getpid()), -1);
    const int status = wait_for(getpid());
    EXPECT_FALSE(WIFEXITED(status) || WIFSIGNALED(status));
}

}  // namespace
}  // namespace limpet
