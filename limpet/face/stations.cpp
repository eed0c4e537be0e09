// SPDX-License-Identifier: Apache-2.0
#include "limpet/face/stations.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "limpet/core/errors.hpp"
#include "limpet/core/time.hpp"

namespace limpet {
namespace {

bool is_finite(const Setpoint& setpoint) {
    return std::visit(
        [](const auto& motion) {
            using Motion = std::decay_t<decltype(motion)>;
            if constexpr (std::is_same_v<Motion, PositionSetpoint>) {
                return motion.p_W_m.allFinite() && std::isfinite(motion.yaw_rad) &&
                       motion.feedforward_v_W_m_s.allFinite();
            } else if constexpr (std::is_same_v<Motion, VelocitySetpoint>) {
                return motion.v_W_m_s.allFinite() && std::isfinite(motion.yaw_rad) &&
                       motion.feedforward_a_W_m_s2.allFinite();
            } else if constexpr (std::is_same_v<Motion, AttitudeSetpoint>) {
                return motion.q_WB.coeffs().allFinite() && std::isfinite(motion.thrust);
            } else {
                return true;
            }
        },
        setpoint.motion);
}

}  // namespace

GuidanceSeat::GuidanceSeat(std::shared_ptr<const Guidance> guidance, int rate_Hz)
    : memory(guidance->memory_size()), guidance_(std::move(guidance)), rate_Hz_(rate_Hz) {}

void GuidanceSeat::exchange(const Readings& readings, const Estimate& estimate, double time_s,
                            guidance::PerchingMemory& guidance, guidance::EventList& events) {
    if (!due(std::llround(time_s * kTicksPerSecond), rate_Hz_)) {
        return;
    }
    output_ =
        guidance_->update({.readings = readings, .estimate = estimate, .time_s = time_s}, memory);
    if (!is_finite(output_.setpoint)) {
        throw InputError("the user's guidance: a set-point that is not finite");
    }
    guidance.setpoint = output_.setpoint;
    if (output_.event) {
        events.add(make_event(time_s, "guidance", *output_.event, output_.reason));
    }
}

CupSeat::CupSeat(std::shared_ptr<const CupPressure> pressure)
    : memory(pressure->memory_size()), pressure_(std::move(pressure)) {}

suction::CupOutput CupSeat::step(const suction::CupModel& model, suction::CupState& state,
                                 const suction::Surface& surface, const Kinematics& cup,
                                 const suction::CupInput& input, double dt_s) {
    CupPressureInput air{.pressure_Pa = state.mean_pressure_Pa,
                         .radius_m = model.parameters.lip.radius_m,
                         .vacuum_pressure_Pa = surface.vacuum_pressure_Pa,
                         .sealing_time_constant_s = surface.sealing_time_constant_s,
                         .unsealing_time_constant_s = surface.unsealing_time_constant_s,
                         .dt_s = dt_s,
                         .ambient_Pa = model.parameters.ambient_Pa};
    suction::CupOutput output = suction::step(model, state, surface, cup, input, dt_s);
    const CupPhase phase = state.status.phase;
    if (phase == CupPhase::sealing || phase == CupPhase::attached || phase == CupPhase::unsealing) {
        air.pump_running = suction::pump_turns(model.parameters, state, input) && input.pump_draws;
        air.valve_open = input.valve_open;
        air.press_N = -state.status.pull_N;
        air.peel_N_m = state.status.peel_N_m;
        air.hole_mm2 = input.hole_mm2;
        air.leak_growth = state.leak_growth;
        const double next_Pa = pressure_->next_Pa(air, memory);
        if (std::isnan(next_Pa)) {
            throw InputError("the user's cup pressure: next_Pa() is not a number");
        }
        state.mean_pressure_Pa = std::clamp(next_Pa, 0.0, air.ambient_Pa);
        state.status.pressure_Pa = state.mean_pressure_Pa;
        state.status.pump_running = air.pump_running;
        state.pump_resting = false;
    }
    return output;
}

}  // namespace limpet
