// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/core/signals/setpoint.hpp"

namespace limpet {

/// What an autopilot may know of the vehicle that it flies.
struct AutopilotVehicle {
    double mass_kg = 1.0;
    Vector3 inertia_kg_m2 = Vector3::Ones();  ///< diagonal, about B
    double hover_thrust = 0.5;                ///< collective that carries the weight, 0..1
    RotorList<Vector3> rotor_p_B_m;           ///< hubs
};

/// What it is given, at the rate of the IMU.
struct AutopilotInput {
    const AutopilotVehicle& vehicle;
    const Estimate& estimate;
    /// Armed, and something other than idle: the rest needs no control.
    const Setpoint& setpoint;
    double time_s = 0.0;
    double dt_s = 0.0;  ///< since the last call; 0 at the first, at most 0.02
};

/// What it asks of the rotors.
struct AutopilotOutput {
    double thrust = 0.0;               ///< collective, 0..1 of the motor command
    Vector3 torque = Vector3::Zero();  ///< about x, y, z of B, normalised, -1..1
    /// In place of thrust and torque, 0..1 each, as many as the vehicle has: taken as they are.
    /// Otherwise rotors are mixed of them by the vehicle's geometry; where they saturate, yaw
    /// yields first.
    std::optional<RotorList<double>> rotors = {};
};

/// An autopilot in the loop. It has no state of its own: what it remembers are numbers of the
/// flight, so that a flight can be saved, branched and resumed with the same bits, and many flights
/// share one autopilot. One behind a wire is another thing (ExternalAutopilot).
class Autopilot {
public:
    virtual ~Autopilot() = default;

    /// How many numbers it remembers.
    [[nodiscard]] virtual std::size_t memory_size() const { return 0; }
    /// Before the first call.
    /// @param memory  zeros
    virtual void start(const Estimate& /*initial*/, std::span<double> /*memory*/) const {}
    /// @param built_in  what the built-in estimator makes of the readings
    /// @return what guidance and control shall believe
    [[nodiscard]] virtual Estimate estimate(const Readings& /*readings*/, const Estimate& built_in,
                                            std::span<double> /*memory*/) const {
        return built_in;
    }
    /// One step of control. Allocates nothing, reads no clock.
    [[nodiscard]] virtual AutopilotOutput control(const AutopilotInput& input,
                                                  std::span<double> memory) const = 0;
};

}  // namespace limpet
