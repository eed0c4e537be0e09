// SPDX-License-Identifier: Apache-2.0
#include "null_modem.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <stdexcept>

namespace limpet {

NullModem::NullModem() {
    for (int end = 0; end < 2; ++end) {
        master_[end] = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (master_[end] < 0 || grantpt(master_[end]) != 0 || unlockpt(master_[end]) != 0) {
            throw std::runtime_error("no pseudo-terminal");
        }
        device_[end] = ptsname(master_[end]);
        slave_[end] = open(device_[end].c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        termios raw{};
        tcgetattr(slave_[end], &raw);
        cfmakeraw(&raw);
        tcsetattr(slave_[end], TCSANOW, &raw);
    }
    thread_ = std::thread([this] { carry(); });
}

NullModem::~NullModem() {
    stop_ = true;
    thread_.join();
    for (int end = 0; end < 2; ++end) {
        close(slave_[end]);
        close(master_[end]);
    }
}

void NullModem::carry() {
    char buffer[4096];
    while (!stop_) {
        pollfd fds[2] = {{master_[0], POLLIN, 0}, {master_[1], POLLIN, 0}};
        if (poll(fds, 2, 20) <= 0) {
            continue;
        }
        for (int end = 0; end < 2; ++end) {
            const ssize_t got =
                (fds[end].revents & POLLIN) != 0 ? read(master_[end], buffer, sizeof(buffer)) : 0;
            for (ssize_t sent = 0; sent < got && !stop_;) {
                const ssize_t count =
                    write(master_[1 - end], buffer + sent, static_cast<std::size_t>(got - sent));
                sent += count > 0 ? count : 0;
            }
        }
    }
}

}  // namespace limpet
