// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/real_time.hpp"

#include <gmock/gmock.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

namespace limpet::companion {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(RealTime, SaysWhatItGot) {
    EXPECT_EQ(text_of({.priority = 20}), "real time: SCHED_FIFO 20, memory locked");
    EXPECT_EQ(text_of({.priority = 0}),
              "real time: not requested (loop.real_time_priority is 0); a busy machine may hold it "
              "up");
}

TEST(RealTime, SaysWhatItDidNotGetAndWhatToDoAboutIt) {
    EXPECT_EQ(text_of({.priority = 20,
                       .scheduler_error = EPERM,
                       .memory_error = EPERM,
                       .memory_limit_bytes = 8 << 20}),
              "real time: refused SCHED_FIFO 20 (Operation not permitted), locked memory (limit "
              "8192 kB); flies on at ordinary priority, where a busy machine may hold it up: give "
              "it the limits rtprio 20, memlock unlimited (docs/companion.md), or request neither "
              "with loop.real_time_priority=0");
    const std::string memory = text_of({.priority = 5, .memory_error = ENOMEM});
    EXPECT_THAT(memory, HasSubstr("refused locked memory (Cannot allocate memory)"));
    EXPECT_THAT(memory, HasSubstr("flies on with memory that may be swapped"));
    EXPECT_THAT(memory, HasSubstr("the limits memlock unlimited ("));
    const std::string priority = text_of({.priority = 5, .scheduler_error = EPERM});
    EXPECT_THAT(priority, HasSubstr("refused SCHED_FIFO 5 (Operation not permitted); flies on"));
    EXPECT_THAT(priority, Not(HasSubstr("mem")));
}

int policy() {
    return sched_getscheduler(0);
}

/// Rights are a thread's own.
template <class Work>
void in_a_thread(const Work& work) {
    std::thread(work).join();
}

void give_up_rights() {
    __user_cap_header_struct whose{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
    __user_cap_data_struct none[2] = {};
    ASSERT_EQ(syscall(SYS_capset, &whose, none), 0);
}

TEST(RealTime, IsAskedForAndGivenBack) {
    in_a_thread([] {
        {
            const RealTime real_time(1);
            if (real_time.answer().scheduler_error != 0) {
                GTEST_SKIP() << text_of(real_time.answer());
            }
            EXPECT_EQ(policy(), SCHED_FIFO | SCHED_RESET_ON_FORK);
            sched_param parameters{};
            EXPECT_EQ(sched_getparam(0, &parameters), 0);
            EXPECT_EQ(parameters.sched_priority, 1);
            in_a_thread([] { EXPECT_EQ(policy(), SCHED_OTHER) << "a helper is an ordinary one"; });
        }
        EXPECT_EQ(policy() & ~SCHED_RESET_ON_FORK, SCHED_OTHER);
    });
}

TEST(RealTime, WhoMayNotRunsOnAsBefore) {
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_RTPRIO, &limit), 0);
    if (limit.rlim_max != 0) {
        GTEST_SKIP() << "everybody may, here: rtprio " << limit.rlim_max;
    }
    in_a_thread([] {
        give_up_rights();
        const RealTime real_time(1);
        EXPECT_EQ(real_time.answer().scheduler_error, EPERM);
        EXPECT_EQ(policy(), SCHED_OTHER);
        EXPECT_THAT(text_of(real_time.answer()), HasSubstr("flies on at ordinary priority"));
    });
}

TEST(RealTime, IsNotAskedForByWhoWantsNone) {
    in_a_thread([] {
        const RealTime real_time(0);
        EXPECT_EQ(policy(), SCHED_OTHER);
    });
}

}  // namespace
}  // namespace limpet::companion
