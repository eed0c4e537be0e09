// SPDX-License-Identifier: Apache-2.0
#include "limpet/loaded/mujoco.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "limpet/core/errors.hpp"
#include "limpet/loaded/library.hpp"

namespace limpet::loaded {
namespace {

std::string version_text(int version) {
    return fmt::format("{}.{}.{}", version / 100, version / 10 % 10, version % 10);
}

[[noreturn]] void give_up(const std::string& why) {
    throw NotInstalled(fmt::format(
        "MuJoCo {} is not there, which pictures of the vehicle and simulation.engine mujoco need "
        "(apt-get install {}): {}",
        mujoco_version(), mujoco_package(), why));
}

std::string file_of_mujoco() {
    const char* given = std::getenv("LIMPET_MUJOCO");
    return given != nullptr && *given != '\0' ? given
                                              : fmt::format("libmujoco.so.{}", mujoco_version());
}

}  // namespace

std::string mujoco_version() {
    return version_text(mjVERSION_HEADER);
}

std::string mujoco_package() {
    return "libmujoco" + mujoco_version();
}

Mujoco::Mujoco(const std::string& file) try {
    const Library library(file);
    decltype(&::mj_version) version = nullptr;
    library.take(version, "mj_version");
    if (version() != mjVERSION_HEADER) {  // its structs are not ours
        throw NotInstalled(fmt::format("{} is MuJoCo {}", file, version_text(version())));
    }
    library.take(mj_camlight, "mj_camlight");
    library.take(mj_comPos, "mj_comPos");
    library.take(mj_contactForce, "mj_contactForce");
    library.take(mj_defaultVFS, "mj_defaultVFS");
    library.take(mj_deleteData, "mj_deleteData");
    library.take(mj_deleteModel, "mj_deleteModel");
    library.take(mj_deleteVFS, "mj_deleteVFS");
    library.take(mj_findFileVFS, "mj_findFileVFS");
    library.take(mj_kinematics, "mj_kinematics");
    library.take(mj_loadXML, "mj_loadXML");
    library.take(mj_makeData, "mj_makeData");
    library.take(mj_makeEmptyFileVFS, "mj_makeEmptyFileVFS");
    library.take(mj_name2id, "mj_name2id");
    library.take(mj_ray, "mj_ray");
    library.take(mj_resetData, "mj_resetData");
    library.take(mj_step1, "mj_step1");
    library.take(mj_step2, "mj_step2");
    library.take(mj_tendon, "mj_tendon");
    library.take(mju_rotVecMatT, "mju_rotVecMatT");
    library.take(mju_warningText, "mju_warningText");
    library.take(mjv_defaultCamera, "mjv_defaultCamera");
    library.take(mjv_defaultOption, "mjv_defaultOption");
    library.take(mjv_defaultScene, "mjv_defaultScene");
    library.take(mjv_freeScene, "mjv_freeScene");
    library.take(mjv_makeScene, "mjv_makeScene");
    library.take(mjv_updateScene, "mjv_updateScene");
    library.take(mjr_defaultContext, "mjr_defaultContext");
    library.take(mjr_freeContext, "mjr_freeContext");
    library.take(mjr_makeContext, "mjr_makeContext");
    library.take(mjr_readPixels, "mjr_readPixels");
    library.take(mjr_render, "mjr_render");
    library.take(mjr_setBuffer, "mjr_setBuffer");
    library.take(mju_user_error, "mju_user_error");
    library.take(mju_user_warning, "mju_user_warning");
} catch (const NotInstalled& problem) {
    give_up(problem.what());
}

const Mujoco& mujoco() {
    static const Mujoco loaded(file_of_mujoco());
    return loaded;
}

}  // namespace limpet::loaded
