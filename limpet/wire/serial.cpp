// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/serial.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <cstring>
#include <thread>

#include "limpet/core/errors.hpp"
#include "limpet/wire/readiness.hpp"
#include "limpet/wire/serial_line.hpp"
#include "limpet/wire/stream_transfer.hpp"

namespace limpet::wire {
namespace {

using boost::system::error_code;
using std::chrono::nanoseconds;

// Time for 1440 bytes at 57600 baud, more than any message of ours.
constexpr nanoseconds kDrain = std::chrono::milliseconds(250);

std::string why_not(int error, const TransportAddress& address) {
    switch (error) {
        case ENOENT:
        case ENODEV:
        case ENXIO: return "there is no such device";
        case EACCES:
        case EPERM: return "not allowed to this user (is he in the group dialout?)";
        case EBUSY: return "in use by another program";
        case ENOTTY: return "is not a serial port";
        case EINVAL: return fmt::format("the device does not do {} baud", address.baud);
        default: return std::strerror(error);
    }
}

/// @return descriptor of the port, ours alone and set, or -errno
int open_port(const TransportAddress& address) {
    // Not blocking: else open() waits for a modem's carrier.
    const int port = ::open(address.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (port < 0) {
        return -errno;
    }
    int error = 0;
    if (isatty(port) == 0) {
        error = ENOTTY;
    } else if (flock(port, LOCK_EX | LOCK_NB) != 0) {  // TIOCEXCL does not hold back root
        error = errno == EWOULDBLOCK ? EBUSY : errno;
    } else if (ioctl(port, TIOCEXCL) != 0) {
        error = errno;
    } else {
        error = set_line(port, address.baud);
    }
    if (error != 0) {
        ::close(port);
        return -error;
    }
    flush_line(port);
    return port;
}

class SerialPort final : public Transport {
public:
    explicit SerialPort(const TransportAddress& address) : address_(address), io_(1), port_(io_) {
        const int descriptor = open_port(address);
        if (descriptor < 0) {
            throw InputError(
                fmt::format("address '{}': {}", to_text(address), why_not(-descriptor, address)));
        }
        port_.assign(descriptor);
        port_.non_blocking(true);
        statistics_.peers = 1;
    }

    ~SerialPort() override { release(); }
    SerialPort(const SerialPort&) = delete;
    SerialPort& operator=(const SerialPort&) = delete;

    Transfer send(std::span<const std::byte> bytes, nanoseconds timeout) override {
        if (!port_.is_open()) {
            statistics_.void_sends += closed_ ? 0 : 1;
            return {closed_ ? TransferStatus::closed : TransferStatus::no_peer, 0};
        }
        const Deadline deadline(timeout);
        return noticing_loss(send_all(
            port_, bytes, [&](short events) { return wait(events, deadline); }, statistics_));
    }

    Transfer receive(std::span<std::byte> into, nanoseconds timeout) override {
        require(!into.empty(), "receive is given room");
        if (!port_.is_open()) {
            return {closed_ ? TransferStatus::closed : TransferStatus::peer_lost, 0};
        }
        const Deadline deadline(timeout);
        return noticing_loss(receive_some(
            port_, into, [&](short events) { return wait(events, deadline); }, statistics_));
    }

    bool wait_for_peer(nanoseconds) override { return port_.is_open(); }

    void close() override {
        closed_ = true;
        release();
    }

    TransportAddress address() const override { return address_; }

    std::string describe() const override {
        return fmt::format("{} (8N1, {})", to_text(address_),
                           port_.is_open() ? "open"
                           : closed_       ? "closed"
                                           : "lost");
    }

    const TransportStatistics& statistics() const override { return statistics_; }

private:
    bool wait(short events, const Deadline& deadline) {
        pollfd fd{port_.native_handle(), events, 0};
        return wait_ready({&fd, 1}, deadline);
    }

    /// The last words, "pump off" may be among them, still go out.
    bool drained() {
        const Deadline deadline(kDrain);
        int left = 0;
        while (ioctl(port_.native_handle(), TIOCOUTQ, &left) == 0 && left > 0) {
            if (deadline.passed()) {
                return false;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }

    void release() {
        if (port_.is_open()) {
            ioctl(port_.native_handle(), TIOCNXCL);  // it outlives us while others hold the port
            if (!drained()) {  // else close() waits for a stuck device, up to 30 s
                flush_line(port_.native_handle());
            }
            error_code ignored;
            port_.close(ignored);
        }
    }

    Transfer noticing_loss(Transfer transfer) {
        if (transfer.status == TransferStatus::peer_lost) {
            release();
            ++statistics_.peers_lost;
        }
        return transfer;
    }

    TransportAddress address_;
    boost::asio::io_context io_;
    boost::asio::posix::stream_descriptor port_;
    TransportStatistics statistics_;
    bool closed_ = false;
};

}  // namespace

std::unique_ptr<Transport> open_serial(const TransportAddress& address) {
    return std::make_unique<SerialPort>(address);
}

}  // namespace limpet::wire
