// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "limpet/plant/reduced_plant.hpp"

namespace limpet::plant {

/// The bodies of several vehicles, each in a lane of the machine's vectors. What a lane does it
/// does alone, bit for bit as a ReducedPlant; all take their steps together.
class LaneBodies {
public:
    virtual ~LaneBodies() = default;

    [[nodiscard]] virtual int lanes() const = 0;
    /// Another vehicle in a lane.
    /// @param model  lives until the lane is left
    virtual void enter(int lane, const ReducedModel& model) = 0;
    virtual void leave(int lane) = 0;
    [[nodiscard]] virtual PlantState save(int lane) const = 0;
    virtual void restore(int lane, const PlantState& state) = 0;

    virtual void apply(int lane, Body body, const Wrench& wrench_W, const Vector3& p_W_m) = 0;
    virtual void set_mode(int lane, const StepMode& mode) = 0;
    /// The lip's springs until the step is taken or let_go(). What they do is known after answer().
    virtual void hold(int lane, const Matrix3& R_WT,
                      const std::array<StepForce<double>, 6>& springs) = 0;
    virtual void let_go(int lane) = 0;
    [[nodiscard]] virtual bool holds(int lane) const = 0;

    /// Of all lanes: what the springs do in the next step, as far as it is known.
    virtual void answer() = 0;
    [[nodiscard]] virtual CupBearer::Held held(int lane) const = 0;
    /// Of all lanes: a step of each one's mode.
    virtual void step() = 0;

    [[nodiscard]] virtual Kinematics kinematics(int lane, Body body) const = 0;
    [[nodiscard]] virtual SliderMotion slider(int lane) const = 0;
    [[nodiscard]] virtual Vector3 contact_force_W(int lane) const = 0;
    [[nodiscard]] virtual bool is_finite(int lane) const = 0;
};

/// For one kind of machine: with its instructions, as many lanes as its vectors hold numbers.
struct LaneKind {
    std::string_view name;
    int lanes = 0;
    LaneBodies* (*make)(const ReducedModel& model);  ///< all lanes begin with this vehicle
    bool runs_here = false;
};
/// The widest first; the last runs anywhere.
[[nodiscard]] std::span<const LaneKind> lane_kinds();
[[nodiscard]] const LaneKind& widest_lanes();

}  // namespace limpet::plant
