// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mujoco/mujoco.h>

#include <string>

namespace limpet::loaded {

/// What we use of MuJoCo, under its own names and with the types of its header.
struct Mujoco {
    /// @throws NotInstalled naming the package when the library is not there, or not the header's
    /// version
    explicit Mujoco(const std::string& file);

    decltype(&::mj_camlight) mj_camlight = nullptr;
    decltype(&::mj_comPos) mj_comPos = nullptr;
    decltype(&::mj_contactForce) mj_contactForce = nullptr;
    decltype(&::mj_defaultVFS) mj_defaultVFS = nullptr;
    decltype(&::mj_deleteData) mj_deleteData = nullptr;
    decltype(&::mj_deleteModel) mj_deleteModel = nullptr;
    decltype(&::mj_deleteVFS) mj_deleteVFS = nullptr;
    decltype(&::mj_findFileVFS) mj_findFileVFS = nullptr;
    decltype(&::mj_kinematics) mj_kinematics = nullptr;
    decltype(&::mj_loadXML) mj_loadXML = nullptr;
    decltype(&::mj_makeData) mj_makeData = nullptr;
    decltype(&::mj_makeEmptyFileVFS) mj_makeEmptyFileVFS = nullptr;
    decltype(&::mj_name2id) mj_name2id = nullptr;
    decltype(&::mj_ray) mj_ray = nullptr;
    decltype(&::mj_resetData) mj_resetData = nullptr;
    decltype(&::mj_step1) mj_step1 = nullptr;
    decltype(&::mj_step2) mj_step2 = nullptr;
    decltype(&::mj_tendon) mj_tendon = nullptr;
    decltype(&::mju_rotVecMatT) mju_rotVecMatT = nullptr;
    decltype(&::mju_warningText) mju_warningText = nullptr;
    decltype(&::mjv_defaultCamera) mjv_defaultCamera = nullptr;
    decltype(&::mjv_defaultOption) mjv_defaultOption = nullptr;
    decltype(&::mjv_defaultScene) mjv_defaultScene = nullptr;
    decltype(&::mjv_freeScene) mjv_freeScene = nullptr;
    decltype(&::mjv_makeScene) mjv_makeScene = nullptr;
    decltype(&::mjv_updateScene) mjv_updateScene = nullptr;
    decltype(&::mjr_defaultContext) mjr_defaultContext = nullptr;
    decltype(&::mjr_freeContext) mjr_freeContext = nullptr;
    decltype(&::mjr_makeContext) mjr_makeContext = nullptr;
    decltype(&::mjr_readPixels) mjr_readPixels = nullptr;
    decltype(&::mjr_render) mjr_render = nullptr;
    decltype(&::mjr_setBuffer) mjr_setBuffer = nullptr;
    decltype(&::mju_user_error) mju_user_error = nullptr;
    decltype(&::mju_user_warning) mju_user_warning = nullptr;
};

/// @return the header's version: 2.2.2
[[nodiscard]] std::string mujoco_version();
/// @return Debian's package of the library
[[nodiscard]] std::string mujoco_package();

/// MuJoCo, loaded on first use: the library that LIMPET_MUJOCO names, else the one of the
/// header's version next to the program or where the system has it. From any thread.
/// @throws NotInstalled as Mujoco
[[nodiscard]] const Mujoco& mujoco();

}  // namespace limpet::loaded
