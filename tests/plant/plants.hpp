// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "limpet/plant/mujoco_plant.hpp"
#include "limpet/vehicle/model_writer.hpp"

/// Vehicles and scenes that the plant's tests share.
namespace limpet::test {

inline Airframe plain_multirotor() {
    Airframe airframe;
    airframe.has_cup = false;
    return airframe;
}

/// Wall of the default size at x = 1.5 m, facing the origin; the floor far below.
inline Scene wall_ahead() {
    Scene scene;
    scene.wall.p_WT_m = {1.5, 0.0, 0.0};
    scene.ground_z_W_m = 10.0;
    scene.visuals = false;
    return scene;
}

inline std::shared_ptr<const MujocoModel> compile(const Airframe& airframe,
                                                  const Scene& scene = wall_ahead()) {
    return std::make_shared<const MujocoModel>(write_mjcf(airframe, scene));
}

}  // namespace limpet::test
