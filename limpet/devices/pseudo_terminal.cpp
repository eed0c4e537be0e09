// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/pseudo_terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "limpet/core/errors.hpp"
#include "limpet/wire/readiness.hpp"

namespace limpet::devices {
namespace {

using std::chrono::nanoseconds;
namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& link, const std::string& why) {
    throw InputError(fmt::format("pseudo-terminal '{}': {}", link.string(), why));
}

/// No echo, no line discipline: else the first bytes come back before anybody has opened it.
void set_raw(int terminal) {
    termios settings = {};
    tcgetattr(terminal, &settings);
    cfmakeraw(&settings);
    tcsetattr(terminal, TCSANOW, &settings);
}

class PseudoTerminal final : public wire::Transport {
public:
    explicit PseudoTerminal(const fs::path& link) : link_(link) {
        cable_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
        std::array<char, 128> name = {};
        if (cable_ < 0 || ::grantpt(cable_) != 0 || ::unlockpt(cable_) != 0 ||
            ::ptsname_r(cable_, name.data(), name.size()) != 0) {
            give_up(std::strerror(errno));
        }
        // Held open: while no one else has it, reading this end would be an error.
        terminal_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (terminal_ < 0) {
            give_up(std::strerror(errno));
        }
        set_raw(terminal_);
        std::error_code error;
        if (fs::is_symlink(link_, error)) {  // left behind by one that was killed
            fs::remove(link_, error);
        }
        fs::create_symlink(name.data(), link_, error);
        if (error) {
            give_up(error.message());
        }
        statistics_.peers = 1;
    }
    ~PseudoTerminal() override { close(); }
    PseudoTerminal(const PseudoTerminal&) = delete;
    PseudoTerminal& operator=(const PseudoTerminal&) = delete;

    wire::Transfer send(std::span<const std::byte> bytes, nanoseconds timeout) override {
        const wire::Deadline deadline(timeout);
        std::size_t sent = 0;
        while (cable_ >= 0 && sent < bytes.size()) {
            const ssize_t count = ::write(cable_, bytes.data() + sent, bytes.size() - sent);
            if (count > 0) {
                sent += static_cast<std::size_t>(count);
            } else if (errno != EINTR && !ready(POLLOUT, deadline)) {
                ++statistics_.cut_sends;
                return {wire::TransferStatus::timed_out, sent};
            }
        }
        if (cable_ < 0) {
            return {wire::TransferStatus::closed, 0};
        }
        statistics_.bytes_sent += sent;
        ++statistics_.sends;
        return {wire::TransferStatus::done, sent};
    }

    wire::Transfer receive(std::span<std::byte> into, nanoseconds timeout) override {
        require(!into.empty(), "receive is given room");
        const wire::Deadline deadline(timeout);
        while (cable_ >= 0 && ready(POLLIN, deadline)) {
            const ssize_t count = ::read(cable_, into.data(), into.size());
            if (count > 0) {
                ++statistics_.receives;
                statistics_.bytes_received += static_cast<std::uint64_t>(count);
                return {wire::TransferStatus::done, static_cast<std::size_t>(count)};
            }
        }
        return {cable_ < 0 ? wire::TransferStatus::closed : wire::TransferStatus::timed_out, 0};
    }

    bool wait_for_peer(nanoseconds) override { return cable_ >= 0; }

    void close() override {
        if (cable_ < 0) {
            return;
        }
        std::error_code ignored;
        fs::remove(link_, ignored);
        ::close(terminal_);
        ::close(cable_);
        cable_ = -1;
    }

    wire::TransportAddress address() const override {
        return {.medium = wire::Medium::serial, .device = link_.string(), .baud = kBaud};
    }
    std::string describe() const override { return "pty:" + link_.string(); }
    const wire::TransportStatistics& statistics() const override { return statistics_; }

private:
    static constexpr unsigned kBaud = 115200;  // to be named: there is no line

    [[noreturn]] void give_up(const std::string& why) {
        ::close(terminal_);
        ::close(cable_);
        refuse(link_, why);
    }

    bool ready(short events, const wire::Deadline& deadline) const {
        pollfd fd{cable_, events, 0};
        return wait_ready({&fd, 1}, deadline);
    }

    fs::path link_;
    int cable_ = -1;
    int terminal_ = -1;
    wire::TransportStatistics statistics_;
};

}  // namespace

std::unique_ptr<wire::Transport> open_pseudo_terminal(const fs::path& link) {
    return std::make_unique<PseudoTerminal>(link);
}

}  // namespace limpet::devices
