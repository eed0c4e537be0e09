// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "limpet/models/model_writer.hpp"
#include "limpet/plant/engines.hpp"
#include "limpet/plant/mujoco_plant.hpp"

/// Vehicles and scenes that the plant's tests share.
namespace limpet::test {

inline vehicle::Airframe plain_multirotor() {
    vehicle::Airframe airframe;
    airframe.has_cup = false;
    return airframe;
}

/// Wall of the default size at x = 1.5 m, facing the origin; the floor far below.
inline models::Scene wall_ahead() {
    models::Scene scene;
    scene.wall.p_WT_m = {1.5, 0.0, 0.0};
    scene.ground_z_W_m = 10.0;
    scene.visuals = false;
    return scene;
}

inline std::shared_ptr<const plant::MujocoModel> compile(
    const vehicle::Airframe& airframe, const models::Scene& scene = wall_ahead()) {
    return std::make_shared<const plant::MujocoModel>(write_mjcf(airframe, scene), airframe);
}

/// What is asked of every engine.
class OfEveryEngine : public testing::TestWithParam<const plant::Engine*> {
protected:
    [[nodiscard]] static std::unique_ptr<plant::Plant> make(
        const vehicle::Airframe& airframe = {}, const models::Scene& scene = wall_ahead()) {
        return GetParam()->make(airframe, scene)->make();
    }
};
inline std::string engine_name(const testing::TestParamInfo<const plant::Engine*>& engine) {
    return std::string(engine.param->name);
}
/// Those that move slider, joint and legs.
inline auto each_engine() {
    return testing::Values(&plant::kReducedEngine, &plant::kMujocoEngine);
}

}  // namespace limpet::test
