// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/real_time.hpp"

#include <fmt/format.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace limpet::companion {
namespace {

int schedule(int policy, int priority) {
    const sched_param parameters{.sched_priority = priority};
    return sched_setscheduler(0, policy | SCHED_RESET_ON_FORK, &parameters) == 0 ? 0 : errno;
}

int ask_for_priority(int priority) {
    rlimit limit{};
    if (getrlimit(RLIMIT_RTPRIO, &limit) == 0) {  // as far as we may without rights
        limit.rlim_cur = limit.rlim_max;
        (void)setrlimit(RLIMIT_RTPRIO, &limit);
    }
    return schedule(SCHED_FIFO, priority);
}

/// CAP_IPC_LOCK: limits are not for us.
bool is_above_limits() {
    __user_cap_header_struct whose{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
    __user_cap_data_struct sets[2] = {};
    return syscall(SYS_capget, &whose, sets) == 0 &&
           (sets[0].effective & (1U << CAP_IPC_LOCK)) != 0;
}

/// Only without a limit: under one that happens to suffice now, memory requested later is refused,
/// and a stack that grows ends the process.
void ask_for_memory(RealTimeAnswer& answer) {
    const rlimit none{.rlim_cur = RLIM_INFINITY, .rlim_max = RLIM_INFINITY};
    if (!is_above_limits() && setrlimit(RLIMIT_MEMLOCK, &none) != 0) {
        answer.memory_error = errno;
        rlimit limit{};
        (void)getrlimit(RLIMIT_MEMLOCK, &limit);
        answer.memory_limit_bytes = limit.rlim_max;
    } else if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
        answer.memory_error = errno;
    }
}

}  // namespace

RealTime::RealTime(int priority) : answer_{.priority = priority} {
    if (priority > 0) {
        ask_for_memory(answer_);
        answer_.scheduler_error = ask_for_priority(priority);
    }
}

RealTime::~RealTime() {
    if (answer_.priority > 0 && answer_.scheduler_error == 0) {
        (void)schedule(SCHED_OTHER, 0);
    }
    if (answer_.priority > 0 && answer_.memory_error == 0) {
        (void)munlockall();
    }
}

std::string text_of(const RealTimeAnswer& answer) {
    if (answer.priority == 0) {
        return "real time: not requested (loop.real_time_priority is 0); a busy machine may hold "
               "it up";
    }
    const std::string priority = fmt::format("SCHED_FIFO {}", answer.priority);
    if (answer.scheduler_error == 0 && answer.memory_error == 0) {
        return fmt::format("real time: {}, memory locked", priority);
    }
    std::string refused;
    std::string remedy;
    const auto add = [](std::string& list, const std::string& what) {
        list += (list.empty() ? "" : ", ") + what;
    };
    if (answer.scheduler_error != 0) {
        add(refused, fmt::format("{} ({})", priority, std::strerror(answer.scheduler_error)));
        add(remedy, fmt::format("rtprio {}", answer.priority));
    }
    if (answer.memory_error != 0) {
        add(refused, fmt::format("locked memory ({})",
                                 answer.memory_limit_bytes > 0
                                     ? fmt::format("limit {} kB", answer.memory_limit_bytes / 1024)
                                     : std::strerror(answer.memory_error)));
        add(remedy, "memlock unlimited");
    }
    return fmt::format(
        "real time: refused {}; flies on {}, where a busy machine may hold it up: give it the "
        "limits {} (docs/companion.md), or request neither with loop.real_time_priority=0",
        refused,
        answer.scheduler_error == 0 ? "with memory that may be swapped" : "at ordinary priority",
        remedy);
}

}  // namespace limpet::companion
