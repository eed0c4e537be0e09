// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/readiness.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "limpet/core/errors.hpp"

namespace limpet::wire {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

namespace {
constexpr nanoseconds kLongest = std::chrono::hours(24 * 365);  // now + more might overflow
}

Deadline::Deadline(nanoseconds timeout)
    : end_(steady_clock::now() + std::clamp(timeout, nanoseconds(0), kLongest)) {}

nanoseconds Deadline::remaining() const {
    return std::max(nanoseconds(0), nanoseconds(end_ - steady_clock::now()));
}

bool wait_ready(std::span<pollfd> descriptors, const Deadline& deadline) {
    for (;;) {
        const nanoseconds left = deadline.remaining();
        timespec wait{};
        wait.tv_sec = static_cast<time_t>(left.count() / 1'000'000'000);
        wait.tv_nsec = static_cast<long>(left.count() % 1'000'000'000);
        const int ready = ppoll(descriptors.data(), descriptors.size(), &wait, nullptr);
        if (ready > 0) {
            for (const pollfd& each : descriptors) {
                require((each.revents & POLLNVAL) == 0, "only open descriptors are waited for");
            }
            return true;
        }
        require(ready == 0 || errno == EINTR, "ppoll fails by signals alone");
        if (ready == 0 && deadline.passed()) {
            return false;
        }
    }
}

void close_on_exec(int descriptor) {
    fcntl(descriptor, F_SETFD, fcntl(descriptor, F_GETFD) | FD_CLOEXEC);
}

}  // namespace limpet::wire
