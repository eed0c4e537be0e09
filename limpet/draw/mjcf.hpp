// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "limpet/loaded/mujoco.hpp"

namespace limpet::draw {

struct DeleteModel {
    void operator()(mjModel* model) const { loaded::mujoco().mj_deleteModel(model); }
};
using MujocoModel = std::unique_ptr<mjModel, DeleteModel>;

/// The model.xml of a recording, compiled: what a picture needs of it (picture_model.hpp).
/// @throws InputError as picture_model, or with MuJoCo's words
[[nodiscard]] MujocoModel compile_mjcf(const std::string& mjcf);

}  // namespace limpet::draw
