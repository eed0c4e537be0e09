// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <cstring>
#include <thread>

#include "limpet/wire/serial_line.hpp"
#include "limpet/wire/stream_transport.hpp"

namespace limpet::wire {
namespace {

using boost::asio::posix::stream_descriptor;
namespace fs = std::filesystem;

// Time for 1440 bytes at 57600 baud, more than any message of ours.
constexpr std::chrono::nanoseconds kDrain = std::chrono::milliseconds(250);

/// @return 0, or why an open port is not ours alone and set: errno
int claim(int port, unsigned baud) {
    if (isatty(port) == 0) {
        return ENOTTY;
    }
    if (flock(port, LOCK_EX | LOCK_NB) != 0) {  // TIOCEXCL does not hold back root
        return errno == EWOULDBLOCK ? EBUSY : errno;
    }
    return ioctl(port, TIOCEXCL) != 0 ? errno : set_line(port, baud);
}

class SerialPort final : public StreamTransport<stream_descriptor> {
public:
    explicit SerialPort(const TransportAddress& address)
        : StreamTransport(address, TransferStatus::peer_lost) {
        // Not blocking: else open() waits for a modem's carrier.
        const int port = ::open(address.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
        if (port < 0) {
            refuse_address(address, errno);
        }
        stream_.assign(port);
        if (const int error = claim(port, address.baud); error != 0) {
            refuse_address(address, error);
        }
        flush_line(port);
        stream_.non_blocking(true);
        statistics_.peers = 1;
    }
    ~SerialPort() override { SerialPort::shut(); }

    std::string describe() const override {
        return fmt::format("{} (8N1, {})", to_text(address_),
                           stream_.is_open() ? "open"
                           : closed_         ? "closed"
                                             : "lost");
    }

private:
    /// The last words, "pump off" may be among them, still go out.
    bool drained() {
        const Deadline deadline(kDrain);
        int left = 0;
        while (ioctl(stream_.native_handle(), TIOCOUTQ, &left) == 0 && left > 0) {
            if (deadline.passed()) {
                return false;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }

    void shut() override {
        if (stream_.is_open()) {
            ioctl(stream_.native_handle(), TIOCNXCL);  // it outlives us while others hold the port
            if (!drained()) {  // else close() waits for a stuck device, up to 30 s
                flush_line(stream_.native_handle());
            }
            StreamTransport::shut();
        }
    }
};

class PseudoTerminal final : public StreamTransport<stream_descriptor> {
public:
    explicit PseudoTerminal(const fs::path& link)
        : StreamTransport({.medium = Medium::serial, .device = link.string(), .baud = kBaud},
                          TransferStatus::peer_lost),
          link_(link) {
        const auto expect = [this](bool good) {
            if (!good) {
                refuse(std::strerror(errno));
            }
        };
        const int cable = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
        expect(cable >= 0);
        stream_.assign(cable);
        stream_.non_blocking(true);
        std::array<char, 128> name = {};
        expect(::grantpt(cable) == 0 && ::unlockpt(cable) == 0 &&
               ::ptsname_r(cable, name.data(), name.size()) == 0);
        // Held open: while no one else has it, reading this end would be an error.
        const int terminal = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        expect(terminal >= 0);
        terminal_.assign(terminal);
        (void)set_line(terminal, kBaud);  // else the first bytes are echoed before anybody opens it
        std::error_code error;
        if (fs::is_symlink(link_, error)) {  // left behind by one that was killed
            fs::remove(link_, error);
        }
        fs::create_symlink(name.data(), link_, error);
        if (error) {
            refuse(error.message());
        }
        statistics_.peers = 1;
    }
    ~PseudoTerminal() override { PseudoTerminal::shut(); }

    std::string describe() const override { return "pty:" + link_.string(); }

private:
    static constexpr unsigned kBaud = 115200;  // to be named: there is no line

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(fmt::format("pseudo-terminal '{}': {}", link_.string(), why));
    }

    void shut() override {
        if (stream_.is_open()) {
            std::error_code ignored;
            fs::remove(link_, ignored);
            StreamTransport::shut();
        }
    }

    fs::path link_;
    stream_descriptor terminal_{io_};
};

}  // namespace

std::unique_ptr<Transport> open_serial(const TransportAddress& address) {
    return std::make_unique<SerialPort>(address);
}

std::unique_ptr<Transport> open_pseudo_terminal(const fs::path& link) {
    return std::make_unique<PseudoTerminal>(link);
}

}  // namespace limpet::wire
