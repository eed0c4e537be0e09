// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>

#include "limpet/plant/mechanism.hpp"
#include "limpet/plant/plant.hpp"

struct mjModel_;

namespace limpet::plant {

/// A vehicle and its surroundings as MuJoCo compiled them. Immutable: any number of plants in any
/// number of threads share one.
class MujocoModel final : public PlantModel, public std::enable_shared_from_this<MujocoModel> {
public:
    /// Where the parts that the plant talks to are. Without a cup only the base is there.
    struct Places {
        int base_body = -1;
        int base_position = -1;  ///< of the free joint in qpos: 3 position, 4 quaternion
        int base_velocity = -1;  ///< of the free joint in qvel: 3 linear in W, 3 angular in B
        bool has_cup = false;
        int carriage_body = -1;
        int cup_body = -1;
        int lip_site = -1;
        std::array<int, kJoints> joint_position{};
        std::array<int, kJoints> joint_velocity{};
    };

    /// Compiles a model in memory. It must have a body `base` with a free joint, and either all or
    /// none of: bodies `carriage` and `cup`, slide joint `slider`, two hinges and site `lip` on the
    /// cup. Rays hit the shapes of visibility group 0. Springs, dampers and limits of these joints
    /// are taken out: the plant applies them.
    /// @param mjcf      text, without references to files
    /// @param airframe  what it was made of
    /// @throws InputError with MuJoCo's message when the text does not compile or a part is missing
    MujocoModel(const std::string& mjcf, const vehicle::Airframe& airframe);

    /// @throws std::bad_weak_ptr unless a shared_ptr owns the model
    [[nodiscard]] std::unique_ptr<Plant> make() const override;

    [[nodiscard]] const mjModel_& get() const { return *model_; }
    [[nodiscard]] const Places& places() const { return places_; }
    [[nodiscard]] const MechanismModel& mechanism() const { return mechanism_; }

private:
    std::unique_ptr<mjModel_, void (*)(mjModel_*)> model_;
    MechanismModel mechanism_;
    Places places_;
};

}  // namespace limpet::plant
