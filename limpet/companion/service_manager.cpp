// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/service_manager.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace limpet::companion {
namespace {

std::string_view environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// @return 0 for what is no number
std::uint64_t number(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

}  // namespace

ServiceManager::ServiceManager() : address_(environment("NOTIFY_SOCKET")) {
    const bool known = address_.size() < sizeof(sockaddr_un::sun_path) && address_.size() > 1 &&
                       (address_[0] == '/' || address_[0] == '@');
    if (!known) {
        return;
    }
    if (address_[0] == '@') {  // a name that is in no file system
        address_[0] = '\0';
    }
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const std::string_view whom = environment("WATCHDOG_PID");
    if (whom.empty() || number(whom) == static_cast<std::uint64_t>(getpid())) {
        every_ = std::chrono::microseconds(number(environment("WATCHDOG_USEC")) / 4);
    }
}

ServiceManager::~ServiceManager() {
    if (socket_ >= 0) {
        close(socket_);
    }
}

void ServiceManager::ready() {
    say("READY=1");
}

void ServiceManager::stopping() {
    say("STOPPING=1");
}

void ServiceManager::alive() {
    const auto now = std::chrono::steady_clock::now();
    if (every_.count() > 0 && now - sent_ >= every_) {
        sent_ = now;
        say("WATCHDOG=1");
    }
}

/// What cannot be sent now is sent again: nothing waits for it.
void ServiceManager::say(const char* word) {
    if (socket_ < 0) {
        return;
    }
    sockaddr_un to{};
    to.sun_family = AF_UNIX;
    std::memcpy(to.sun_path, address_.data(), address_.size());
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
    (void)sendto(socket_, word, std::strlen(word), MSG_NOSIGNAL,
                 reinterpret_cast<const sockaddr*>(&to), size);
}

}  // namespace limpet::companion
