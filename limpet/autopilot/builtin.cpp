// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/builtin.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "limpet/autopilot/attitude_control.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/machines.hpp"

namespace limpet::autopilot {
namespace {

/// A gap in the calls must not be integrated as a whole. Source: PX4 mc_rate_control.
constexpr double kLongestInterval_s = 0.02;

AttitudeSetpoint attitude_target(const AutopilotModel& model, AutopilotState& state,
                                 const VelocitySetpoint& target, bool hold, double dt_s) {
    return velocity_control(model.parameters, state.position, target, state.estimate.v_WB_m_s, hold,
                            dt_s);
}

AttitudeSetpoint attitude_target(const AutopilotModel& model, AutopilotState& state,
                                 const PositionSetpoint& target, bool hold, double dt_s) {
    return attitude_target(model, state,
                           position_control(model.parameters, target, state.estimate.p_WB_m), hold,
                           dt_s);
}

AttitudeSetpoint attitude_target(const AutopilotModel&, AutopilotState&,
                                 const AttitudeSetpoint& target, bool, double) {
    return {.q_WB = target.q_WB.normalized(), .thrust = std::clamp(target.thrust, 0.0, 1.0)};
}

AttitudeSetpoint attitude_target(const AutopilotModel&, AutopilotState& state, const IdleSetpoint&,
                                 bool, double) {
    return {.q_WB = state.estimate.q_WB, .thrust = 0.0};
}

/// @return since the last call; 0 at the first one
double interval(AutopilotState& state, double time_s) {
    const double dt_s = std::clamp(time_s - state.control_s, 0.0, kLongestInterval_s);
    state.control_s = time_s;
    return dt_s;
}

/// Of a user's autopilot.
void require_flyable(const AutopilotOutput& output, std::size_t rotors) {
    bool finite = output.torque.allFinite() && std::isfinite(output.thrust);
    if (output.rotors) {
        if (output.rotors->size() != rotors) {
            throw InputError("the user's autopilot: commands " +
                             std::to_string(output.rotors->size()) + " rotors of " +
                             std::to_string(rotors));
        }
        finite = finite && std::all_of(output.rotors->begin(), output.rotors->end(),
                                       [](double command) { return std::isfinite(command); });
    }
    if (!finite) {
        throw InputError("the user's autopilot: a command that is not finite");
    }
}

RotorCommand fly_own(const AutopilotModel& model, AutopilotState& state, const Setpoint& setpoint,
                     double time_s, double dt_s) {
    const AutopilotOutput output = model.own->control({.vehicle = model.vehicle,
                                                       .estimate = state.estimate,
                                                       .setpoint = setpoint,
                                                       .time_s = time_s,
                                                       .dt_s = dt_s},
                                                      state.memory);
    require_flyable(output, model.mixer.rotors());
    state.torque = output.torque;
    state.attitude_target.thrust = output.thrust;
    const Allocation allocation = allocate(model.mixer, output.torque, output.thrust);
    state.saturation = allocation.saturation;
    if (output.rotors) {
        return {.command = *output.rotors, .armed = true};
    }
    return {.command = allocation.command, .armed = true};
}

RotorCommand idle(const AutopilotModel& model, bool armed) {
    return {.command = RotorList<double>(model.mixer.rotors()), .armed = armed};
}

/// What was requested attitude_age_steps ago.
Vector3 on_its_way(AutopilotState& state, const Vector3& rate_target_rad_s) {
    std::vector<double>& line = state.memory;
    if (line.empty()) {
        return rate_target_rad_s;
    }
    const Vector3 due(line[0], line[1], line[2]);
    std::copy(line.begin() + 3, line.end(), line.begin());
    std::copy_n(rate_target_rad_s.data(), 3, line.end() - 3);
    return due;
}

void disarm(AutopilotState& state) {
    state.position.integral_m_s2.setZero();
    state.rate.integral.setZero();
    state.saturation = {};
    state.attitude_target = {.q_WB = state.estimate.q_WB, .thrust = 0.0};
    state.rate_target_rad_s.setZero();
    state.torque.setZero();
}

}  // namespace

AutopilotModel make_autopilot(const AutopilotParameters& parameters,
                              const RotorList<RotorGeometry>& rotors) {
    return {.parameters = parameters, .mixer = make_mixer(rotors), .vehicle = {}, .own = {}};
}

AutopilotState start(const AutopilotModel& model, const Estimate& initial) {
    AutopilotState state;
    state.estimator = start_estimator(model.parameters, initial);
    state.estimate = estimate_from(model.parameters, state.estimator);
    state.control_s = initial.time_s;
    start_memory(model, state);
    return state;
}

void start_memory(const AutopilotModel& model, AutopilotState& state) {
    const auto steps = static_cast<std::size_t>(model.parameters.attitude_age_steps);
    state.memory.assign(model.own != nullptr ? model.own->memory_size() : 3 * steps, 0.0);
    if (model.own != nullptr) {
        model.own->start(state.estimate, state.memory);
    }
}

LIMPET_FOR_MACHINES [[gnu::flatten]] void estimate(const AutopilotModel& model,
                                                   AutopilotState& state,
                                                   const Readings& readings) {
    update_estimator(model.parameters, state.estimator, readings);
    state.estimate = estimate_from(model.parameters, state.estimator);
    if (model.own != nullptr) {
        state.estimate = model.own->estimate(readings, state.estimate, state.memory);
    }
}

LIMPET_FOR_MACHINES [[gnu::flatten]] RotorCommand control(const AutopilotModel& model,
                                                          AutopilotState& state,
                                                          const Setpoint& setpoint, double time_s) {
    const double dt_s = interval(state, time_s);
    if (dt_s > 0.0) {
        filter_acceleration(model.parameters, state.position, state.estimate, dt_s);
        filter_rates(model.parameters, state.rate, state.estimate.w_WB_B_rad_s, dt_s);
    }
    if (!setpoint.armed) {
        disarm(state);
        return idle(model, false);
    }
    if (std::holds_alternative<IdleSetpoint>(setpoint.motion)) {
        return idle(model, true);
    }
    if (model.own != nullptr) {
        return fly_own(model, state, setpoint, time_s, dt_s);
    }
    const bool hold = setpoint.hold_integrators;
    state.attitude_target = std::visit(
        [&](const auto& motion) { return attitude_target(model, state, motion, hold, dt_s); },
        setpoint.motion);
    state.rate_target_rad_s = on_its_way(
        state, attitude_control(model.parameters, state.estimate.q_WB, state.attitude_target.q_WB));
    state.torque = rate_control(model.parameters, state.rate, state.rate_target_rad_s,
                                state.saturation, hold, dt_s);
    const Allocation allocation = allocate(model.mixer, state.torque, state.attitude_target.thrust);
    state.saturation = allocation.saturation;
    return {.command = allocation.command, .armed = true};
}

}  // namespace limpet::autopilot
