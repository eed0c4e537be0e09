// SPDX-License-Identifier: Apache-2.0
#include "gazebo/ode_messages.hpp"

#include <gazebo/ode/error.h>

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace limpet::gazebo11 {
namespace {

std::atomic<long long> complaints{0};

void hear(int /*number*/, const char* text, std::va_list values) {
    if (std::strstr(text, "LCP internal error") != nullptr) {
        ++complaints;
        return;
    }
    std::fputs("ODE: ", stderr);
    std::vfprintf(stderr, text, values);
    std::fputs("\n", stderr);
}

}  // namespace

void count_solver_complaints() {
    dSetMessageHandler(&hear);
}

long long take_solver_complaints() {
    return complaints.exchange(0);
}

}  // namespace limpet::gazebo11
