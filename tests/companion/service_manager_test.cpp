// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/service_manager.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace limpet::companion {
namespace {

using namespace std::chrono_literals;
using testing::Each;
using testing::ElementsAre;
using testing::SizeIs;

/// systemd's end: a socket that the environment names.
struct Systemd {
    Systemd() : socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
        forget();
    }
    ~Systemd() {
        close(socket);
        forget();
    }
    /// @param name  '@' before one that is in no file system
    void listen(std::string name) {
        setenv("NOTIFY_SOCKET", name.c_str(), 1);
        sockaddr_un here{};
        here.sun_family = AF_UNIX;
        if (name[0] == '@') {
            name[0] = '\0';
        } else {
            (void)unlink(name.c_str());
        }
        std::memcpy(here.sun_path, name.data(), name.size());
        const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
        ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&here), size), 0);
    }
    [[nodiscard]] std::vector<std::string> heard() const {
        std::vector<std::string> words;
        char text[100];
        for (ssize_t size = 0; (size = recv(socket, text, sizeof(text), 0)) >= 0;) {
            words.emplace_back(text, static_cast<std::size_t>(size));
        }
        return words;
    }
    static void forget() {
        for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) {
            unsetenv(name);
        }
    }
    Systemd(const Systemd&) = delete;
    Systemd& operator=(const Systemd&) = delete;
    int socket;
};

void run_loop() {
    ServiceManager manager;
    manager.ready();
    for (int k = 0; k < 10; ++k) {
        manager.alive();
    }
    manager.stopping();
}

TEST(ServiceManager, HearsThatTheLoopBeginsAndEnds) {
    for (const std::string& name :
         {testing::TempDir() + "limpet_notify_" + std::to_string(getpid()),
          "@limpet_notify_" + std::to_string(getpid())}) {
        Systemd systemd;
        systemd.listen(name);
        run_loop();
        EXPECT_THAT(systemd.heard(), ElementsAre("READY=1", "STOPPING=1")) << name;
        (void)unlink(name.c_str());
    }
}

TEST(ServiceManager, HearsOfTheLoopFourTimesInAWatchdogsTime) {
    Systemd systemd;
    systemd.listen("@limpet_watchdog_" + std::to_string(getpid()));
    setenv("WATCHDOG_USEC", "200000", 1);
    setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
    ServiceManager manager;
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < 210ms) {
        manager.alive();
        std::this_thread::sleep_for(1ms);
    }
    const std::vector<std::string> words = systemd.heard();
    EXPECT_THAT(words, Each("WATCHDOG=1"));
    EXPECT_GE(words.size(), 2U);
    EXPECT_LE(words.size(), 5U) << "not with every tick";
}

TEST(ServiceManager, WatchesItsOwnProcessAlone) {
    Systemd systemd;
    systemd.listen("@limpet_other_" + std::to_string(getpid()));
    setenv("WATCHDOG_USEC", "1000", 1);
    setenv("WATCHDOG_PID", "1", 1);
    run_loop();
    EXPECT_THAT(systemd.heard(), SizeIs(2)) << "no watchdog of ours";
}

TEST(ServiceManager, ThatIsNotThereIsNotSpokenTo) {
    Systemd systemd;
    run_loop();
    for (const std::string& name : {std::string("/no/such/socket"), std::string("not absolute"),
                                    std::string("@"), std::string(200, '/')}) {
        setenv("NOTIFY_SOCKET", name.c_str(), 1);
        setenv("WATCHDOG_USEC", "often", 1);
        run_loop();
    }
    EXPECT_THAT(systemd.heard(), SizeIs(0));
}

TEST(ServiceManager, WhoDoesNotListenIsNotWaitedFor) {
    Systemd systemd;
    systemd.listen("@limpet_deaf_" + std::to_string(getpid()));
    setenv("WATCHDOG_USEC", "4", 1);
    ServiceManager manager;
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < 2000; ++k) {
        manager.alive();
        std::this_thread::sleep_for(2us);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
    EXPECT_GT(systemd.heard().size(), 5U);
}

}  // namespace
}  // namespace limpet::companion
