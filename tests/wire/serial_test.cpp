// SPDX-License-Identifier: Apache-2.0
#include <asm/termbits.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>

#include <thread>

#include "../support/allocations.hpp"
#include "wires.hpp"

using namespace limpet;
using namespace limpet::wire;
using namespace limpet::wire::wires;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

wire::TransportAddress port_at(const std::string& device, unsigned baud = 921600) {
    return {.medium = wire::Medium::serial, .host = "", .device = device, .baud = baud};
}

/// The other end of a cable: the master of a pseudo-terminal, by plain system calls.
class Cable {
public:
    Cable() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
        grantpt(master_);
        unlockpt(master_);
        device = ptsname(master_);
    }
    ~Cable() { unplug(); }
    Cable(const Cable&) = delete;
    Cable& operator=(const Cable&) = delete;

    void unplug() {
        if (master_ >= 0) {
            ::close(master_);
        }
        master_ = -1;
    }
    void say(std::string_view text) {
        EXPECT_EQ(::write(master_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
    /// @return `count` bytes, fewer when none comes for 10 s
    std::string heard(std::size_t count) {
        std::string all;
        char buffer[4096];
        pollfd fd{master_, POLLIN, 0};
        while (all.size() < count) {
            const int ready = poll(&fd, 1, 10000);
            if (ready < 0 && errno == EINTR) {
                continue;  // a signal for this thread, not the one under test
            }
            if (ready <= 0) {
                break;
            }
            const ssize_t got = ::read(master_, buffer, sizeof(buffer));
            if (got <= 0) {
                break;
            }
            all.append(buffer, static_cast<std::size_t>(got));
        }
        return all;
    }
    /// Sends back what comes, until `count` bytes went through.
    void echo(std::size_t count) {
        while (count > 0) {
            const std::string piece = heard(1);
            if (piece.empty()) {
                return;
            }
            for (std::size_t at = 0; at < piece.size();) {
                const ssize_t put = ::write(master_, piece.data() + at, piece.size() - at);
                if (put <= 0) {
                    return;
                }
                at += static_cast<std::size_t>(put);
            }
            count -= std::min(count, piece.size());
        }
    }
    ssize_t take(char* into, std::size_t room) { return ::read(master_, into, room); }
    ssize_t put(const char* from, std::size_t count) { return ::write(master_, from, count); }
    termios2 line() const {
        termios2 settings{};
        EXPECT_EQ(ioctl(master_, TCGETS2, &settings), 0);
        return settings;
    }

    std::string device;

private:
    int master_;
};

struct SerialCable : testing::Test {
    Cable cable;
    std::unique_ptr<wire::Transport> port =
        open_transport(port_at(cable.device), wire::Role::connect);
};

/// Every byte, among them those that a terminal would act upon (3, 4, 10, 13, 17, 19, 26, 28).
std::string every_byte() {
    std::string all;
    for (int i = 0; i < 256; ++i) {
        all += static_cast<char>(i);
    }
    return all;
}

}  // namespace

TEST_F(SerialCable, CarriesEveryByteUnchangedBothWays) {
    EXPECT_EQ(say(*port, every_byte()), wire::TransferStatus::done);
    EXPECT_EQ(cable.heard(256), every_byte());
    cable.say(every_byte());
    std::string came;
    while (came.size() < 256) {
        came += heard(*port);
    }
    EXPECT_EQ(came, every_byte());
}

TEST_F(SerialCable, DeliversHalfAFrameAndTheOtherHalfLater) {
    cable.say("FRA");
    EXPECT_EQ(heard(*port), "FRA");
    EXPECT_EQ(heard(*port, 10ms), "<timed out>");
    cable.say("ME");
    EXPECT_EQ(heard(*port), "ME");
}

TEST(SerialLine, IsRaw8N1AtAnyBaud) {
    for (const unsigned baud : {57600U, 420000U, 921600U, 3000000U}) {  // 420000: no standard rate
        const Cable cable;
        const auto port = wire::open_transport(port_at(cable.device, baud), wire::Role::connect);
        const termios2 line = cable.line();
        EXPECT_EQ(line.c_ospeed, baud);
        EXPECT_EQ(line.c_ispeed, baud);
        EXPECT_EQ(line.c_cflag & CSIZE, static_cast<tcflag_t>(CS8));
        EXPECT_EQ(line.c_cflag & (PARENB | CSTOPB | CRTSCTS), 0U);
        EXPECT_EQ(line.c_iflag, 0U);
        EXPECT_EQ(line.c_oflag, 0U);
        EXPECT_EQ(line.c_lflag, 0U);
    }
}

TEST(SerialLine, DropsWhatCameBeforeItWasOpened) {
    Cable cable;
    const int early = ::open(cable.device.c_str(), O_RDWR | O_NOCTTY);
    cable.say("stale\n");
    std::this_thread::sleep_for(20ms);
    const auto port = wire::open_transport(port_at(cable.device), wire::Role::connect);
    cable.say("fresh");
    EXPECT_EQ(heard(*port), "fresh");
    ::close(early);
}

TEST_F(SerialCable, IsForOneProgram) {
    const std::string line =
        refusal([&] { (void)wire::open_transport(port_at(cable.device), wire::Role::connect); });
    EXPECT_THAT(line, AllOf(HasSubstr("address 'serial:" + cable.device + ":921600'"),
                            HasSubstr("in use by another program"), Not(HasSubstr("\n"))));
    port->close();
    EXPECT_NO_THROW((void)wire::open_transport(port_at(cable.device), wire::Role::connect));
}

TEST_F(SerialCable, CarriesTenMegabytesEachWay) {
    const std::size_t count = 10'000'000;
    const Bytes all = many_bytes(count);
    Bytes back;
    std::thread echo([&] { cable.echo(count); });
    const std::size_t piece = 2000;  // less than the kernel's 4 kB: no deadlock with the echo
    for (std::size_t at = 0; at < count; at += piece) {
        if (port->send(std::span(all).subspan(at, piece), kLong).status !=
            wire::TransferStatus::done) {
            break;
        }
        const Bytes part = receive_all(*port, piece);
        back.insert(back.end(), part.begin(), part.end());
    }
    echo.join();
    EXPECT_TRUE(back == all);
}

TEST_F(SerialCable, AMessageBeyondTheKernelsBufferGoesOutWhole) {
    const Interruptions interruptions;
    const Bytes all = many_bytes(1'000'000);
    std::string came;
    std::thread reader([&] { came = cable.heard(all.size()); });
    EXPECT_EQ(port->send(all, kLong).status, wire::TransferStatus::done);
    reader.join();
    EXPECT_TRUE(came == std::string(reinterpret_cast<const char*>(all.data()), all.size()));
}

TEST_F(SerialCable, SendTimesOutWhenNobodyReads) {
    const Bytes much = many_bytes(1'000'000);
    wire::Transfer transfer;
    const auto took = time_of([&] { transfer = port->send(much, 60ms); });
    EXPECT_EQ(transfer.status, wire::TransferStatus::timed_out);
    EXPECT_GT(transfer.bytes, 0U);
    EXPECT_LT(transfer.bytes, much.size());
    EXPECT_GE(took, 60ms);
    EXPECT_LT(took, 1s);
}

TEST_F(SerialCable, WaitsEndOnTimeThroughSignals) {
    const Interruptions interruptions;
    const auto took = time_of([&] { EXPECT_EQ(heard(*port, 60ms), "<timed out>"); });
    EXPECT_GE(took, 60ms);
    EXPECT_LT(took, 1s);
}

TEST_F(SerialCable, UnpluggedWhileListeningItIsLost) {
    std::thread pull([&] {
        std::this_thread::sleep_for(20ms);
        cable.unplug();
    });
    EXPECT_EQ(heard(*port), "<peer lost>");
    pull.join();
    EXPECT_EQ(say(*port, "x"), wire::TransferStatus::no_peer);
    EXPECT_EQ(heard(*port), "<peer lost>");
    EXPECT_FALSE(port->wait_for_peer(kLong));
    EXPECT_EQ(port->statistics().peers_lost, 1U);
    EXPECT_THAT(port->describe(), HasSubstr("lost"));
}

TEST_F(SerialCable, UnpluggedInTheMiddleOfASendItIsLost) {
    std::thread pull([&] {
        std::this_thread::sleep_for(20ms);
        cable.unplug();
    });
    const wire::Transfer transfer = port->send(many_bytes(1'000'000), kLong);
    pull.join();
    EXPECT_EQ(transfer.status, wire::TransferStatus::peer_lost);
    EXPECT_LT(transfer.bytes, 1'000'000U);
}

TEST_F(SerialCable, LastWordsStillGoOut) {
    EXPECT_EQ(say(*port, "pump off"), wire::TransferStatus::done);
    port->close();
    EXPECT_EQ(cable.heard(8), "pump off");
    EXPECT_EQ(heard(*port), "<closed>");
    EXPECT_EQ(say(*port, "x"), wire::TransferStatus::closed);
}

TEST_F(SerialCable, SendAndReceiveDoNotAllocate) {
    const Bytes message = many_bytes(280);
    Bytes buffer(1000);
    char theirs[280];
    std::size_t came = 0;
    const long before = allocations();
    for (int i = 0; i < 100; ++i) {
        (void)port->send(message, kLong);
        for (std::size_t got = 0; got < sizeof(theirs);) {
            const ssize_t count = cable.take(theirs + got, sizeof(theirs) - got);
            if (count <= 0) {
                break;
            }
            got += static_cast<std::size_t>(count);
        }
        (void)cable.put(theirs, sizeof(theirs));
        for (std::size_t got = 0; got < sizeof(theirs);) {
            const wire::Transfer transfer = port->receive(buffer, kLong);
            ASSERT_EQ(transfer.status, wire::TransferStatus::done);
            got += transfer.bytes;
            came += transfer.bytes;
        }
    }
    EXPECT_EQ(allocations() - before, 0);
    EXPECT_EQ(came, 100U * 280U);
}

TEST(SerialDevice, ThatIsMissingIsOneClearLine) {
    EXPECT_EQ(refusal([] {
                  (void)open_transport(parse_address("serial:/dev/ttyNONE9:921600"), Role::connect);
              }),
              "address 'serial:/dev/ttyNONE9:921600': there is no such device");
}

TEST(SerialDevice, ThatIsNoSerialPortIsOneClearLine) {
    EXPECT_THAT(
        refusal([] { (void)wire::open_transport(port_at("/dev/null"), wire::Role::connect); }),
        HasSubstr("'serial:/dev/null:921600': is not a serial port"));
    EXPECT_THAT(refusal([] { (void)wire::open_transport(port_at("/"), wire::Role::connect); }),
                HasSubstr("'serial:/:921600': "));
}
