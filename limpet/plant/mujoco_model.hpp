// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

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
        int slider_position = -1;
        int slider_velocity = -1;
    };

    /// Compiles a model in memory. It must have a body `base` with a free joint, and either all or
    /// none of: bodies `carriage` and `cup`, slide joint `slider`, site `lip` on the cup. Rays hit
    /// the shapes of visibility group 0. The slider's own limits are taken out: the loop applies
    /// its stops by Plant::apply_slider.
    /// @param mjcf  text, without references to files
    /// @throws InputError with MuJoCo's message when the text does not compile or a part is missing
    explicit MujocoModel(const std::string& mjcf);

    /// @throws std::bad_weak_ptr unless a shared_ptr owns the model
    [[nodiscard]] std::unique_ptr<Plant> make() const override;

    [[nodiscard]] const mjModel_& get() const { return *model_; }
    [[nodiscard]] const Places& places() const { return places_; }

private:
    std::unique_ptr<mjModel_, void (*)(mjModel_*)> model_;
    Places places_;
};

}  // namespace limpet::plant
