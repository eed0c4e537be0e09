// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mujoco_errors.hpp"

#include <mujoco/mujoco.h>

#include <string>

#include "limpet/core/errors.hpp"

namespace limpet::plant {

namespace {

void throw_error(const char* message) {
    throw InternalError(std::string("MuJoCo: ") + message);
}
void count_only(const char*) {}

}  // namespace

void guard_mujoco() {
    [[maybe_unused]] static const bool installed = [] {
        mju_user_error = throw_error;
        mju_user_warning = count_only;
        return true;
    }();
}

}  // namespace limpet::plant
