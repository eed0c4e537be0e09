// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/advance.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/machines.hpp"
#include "limpet/simulation/collision.hpp"
#include "limpet/simulation/rig.hpp"

namespace limpet::simulation {
namespace {

/// What the cup bears at one step of the plant.
void see_contact(ContactPeaks& peaks, const SliderStatus& slider, const CupStatus& cup) {
    if (cup.phase == CupPhase::free) {
        return;
    }
    raise(peaks.slider_press_N, -slider.force_N);
    raise(peaks.lip_press_N, -cup.pull_N);
    if (!suction::is_sealed(cup.phase)) {
        return;
    }
    raise(peaks.pull_N, cup.pull_N);
    raise(peaks.shear_N, cup.shear_N);
    raise(peaks.peel_N_m, cup.peel_N_m);
    if (cup.phase != CupPhase::sealing) {  // a seal that begins has nothing to spare yet
        lower(peaks.margin_N, std::min({cup.pull_margin_N, cup.shear_margin_N, cup.peel_margin_N}));
    }
}

/// The cup between wall and mechanism: its wrench goes to the plant, its events to the report.
void apply_cup(const FlightModel& model, FlightState& state, plant::Plant& plant, double time_s,
               const plant::StepMode& mode, TickReport& report, ExternalCup* external) {
    const Kinematics& cup = state.truth.cup;
    const CupPhase before = state.cup.status.phase;
    const suction::Surface& surface = surface_under_cup(model, state.cup);
    const faults::Acting& acting = state.faults.now;
    const suction::CupInput input{
        .time_s = time_s,
        .press_N = -state.truth.slider.force_N,
        .bearer = plant.bear_cup(mode),
        .pump_on = state.guidance.setpoint.pump_on && state.battery.voltage_V > 0.0,
        .valve_open = (state.guidance.setpoint.valve_open || acting.valve_stuck_open) &&
                      !acting.valve_stuck_shut,
        .pump_draws = acting.pump_draws,
        .hole_mm2 = acting.hole_mm2};
    const suction::CupOutput output =
        external != nullptr ? external->step(model.cup, state.cup, surface, cup, input, mode.step_s)
                            : suction::step(model.cup, state.cup, surface, cup, input, mode.step_s);
    if (state.cup.status.phase != CupPhase::free) {
        plant.apply(plant::Body::cup, output.wrench_W, cup.p_WF_m);
    }
    ContactPeaks& peaks = report.contact;
    if (before == CupPhase::free && state.cup.status.phase != CupPhase::free &&
        std::isnan(peaks.touch_s)) {
        peaks.touch_s = time_s;
        peaks.touch_speed_m_s =
            tangent_frame(model.cup.wall, cup.p_WF_m).into_W().dot(cup.v_WF_W_m_s);
    }
    if (output.event) {
        report.events.add(*output.event);
    }
    if (state.cup.status.phase != before) {
        state.fine_until =
            state.tick + static_cast<Tick>(model.simulation.touch_transient_s / kTick_s);
    }
}

/// The air on the base: rotors in the wind, and what the wall does to their wake.
struct AirLoad {
    Wrench wrench_W;
    double thrust_N = 0.0;
};

/// At the beginning of a stride, as all forces are.
[[gnu::noinline]] vehicle::SwellMotion swell_now(const FlightModel& model,
                                                 const FlightState& state) {
    return swell_motion(model.swell, seconds(state.tick));
}

/// The rotors next to ground or ceiling, seldom.
[[gnu::noinline]] Wrench near_wrench_B(const FlightModel& model,
                                       const RotorList<double>& speeds_rad_s,
                                       const Kinematics& base, const Vector3& wind_W_m_s) {
    return vehicle::rotor_wrench_B(
        lifting_by(model.airframe, thrust_gains(model.nearness, model.airframe, base)),
        speeds_rad_s, base, wind_W_m_s);
}

/// The air as W sees it at the vehicle.
Vector3 air_W_m_s(const FlightModel& model, const FlightState& state) {
    Vector3 wind_W_m_s = vehicle::wind_W_m_s(model.wind, state.wind) + state.faults.now.gust_W_m_s;
    if (model.swell.moves) {
        wind_W_m_s -= swell_now(model, state).v_EW_W_m_s;
    }
    return wind_W_m_s;
}

AirLoad load_of_air(const FlightModel& model, const FlightState& state) {
    const vehicle::AirframeNumbers& airframe = model.airframe;
    const Kinematics& base = state.truth.base;
    const Matrix3 R_WB = base.q_WF.toRotationMatrix();
    const faults::Acting& acting = state.faults.now;
    const Vector3 wind_W_m_s = air_W_m_s(model, state);
    const Wrench rotors_B =
        model.nearness.acts()
            ? near_wrench_B(model, state.rotors.speed_rad_s, base, wind_W_m_s)
            : vehicle::rotor_wrench_B(airframe, state.rotors.speed_rad_s, base, wind_W_m_s);
    AirLoad air{
        .wrench_W = {.force_N = R_WB * rotors_B.force_N, .moment_N_m = R_WB * rotors_B.moment_N_m},
        .thrust_N = -rotors_B.force_N.z()};
    if (acting.payload_to_right_kg_m != 0.0 || acting.payload_ahead_kg_m != 0.0) {
        const Vector3 shift_B_kg_m(acting.payload_ahead_kg_m, acting.payload_to_right_kg_m, 0.0);
        air.wrench_W.moment_N_m += (R_WB * shift_B_kg_m).cross(kGravity_m_s2 * Vector3::UnitZ());
    }
    if (vehicle::acts(model.wall_air) && model.has_wall &&
        before_wall_m(model.cup.wall, base.p_WF_m) - model.hubs_reach_m < model.wall_air.reach_m) {
        const Wrench wall_W = vehicle::wall_air_wrench_W(
            model.wall_air, state.wall_air, airframe, state.rotors, air.thrust_N, base.q_WF,
            closest_hub_m(model, base), tangent_frame(model.cup.wall, base.p_WF_m).into_W());
        air.wrench_W.force_N += wall_W.force_N;
        air.wrench_W.moment_N_m += wall_W.moment_N_m;
    }
    return air;
}

/// On a hull that accelerates every part stays behind.
void apply_swell(const FlightModel& model, const FlightState& state, plant::Plant& plant) {
    const Vector3 a_EW_W_m_s2 = swell_now(model, state).a_EW_W_m_s2;
    const auto stay_behind = [&](plant::Body body, const vehicle::SwellModel::Part& part) {
        const Kinematics at = plant.kinematics(body);
        plant.apply(body, {.force_N = -part.mass_kg * a_EW_W_m_s2},
                    at.p_WF_m + at.q_WF * part.centre_m);
    };
    stay_behind(plant::Body::base, model.swell.base);
    if (model.airframe.has_cup) {
        stay_behind(plant::Body::carriage, model.swell.carriage);
        stay_behind(plant::Body::cup, model.swell.cup);
    }
}

/// What hangs on the vehicle's cable goes a step along, and pulls.
void apply_payload(const FlightModel& model, FlightState& state, plant::Plant& plant,
                   double step_s) {
    PayloadStatus& payload = state.truth.payload;
    payload.parted = payload.parted || state.faults.now.cable_breaks;
    vehicle::PayloadPull pull{.wind_W_m_s = air_W_m_s(model, state)};
    if (model.swell.moves) {
        pull.field_W_m_s2 -= swell_now(model, state).a_EW_W_m_s2;
    }
    const Kinematics& base = state.truth.base;
    plant.apply(plant::Body::base, vehicle::step(model.payload, payload, base, pull, step_s),
                base.p_WF_m);
}

/// What pushes besides air and cup; seldom.
[[gnu::noinline]] void apply_more(const FlightModel& model, FlightState& state, plant::Plant& plant,
                                  double step_s) {
    if (model.swell.moves) {
        apply_swell(model, state, plant);
    }
    if (model.payload.hangs) {
        apply_payload(model, state, plant, step_s);
    }
    if (model.mount != vehicle::Mount::free) {
        plant.apply(plant::Body::base, mount_wrench_W(model, state), state.truth.base.p_WF_m);
    }
}

}  // namespace

void see_motion(const FlightModel& model, Truth& truth, const plant::Plant& plant) {
    truth.base = plant.kinematics(plant::Body::base);
    if (model.airframe.has_cup) {
        truth.cup = plant.kinematics(plant::Body::cup);
    }
}

void see_gap(const FlightModel& model, Truth& truth) {
    truth.cup_status.gap_m = tangent_frame(model.cup.wall, truth.cup.p_WF_m).gap_m;
}

LIMPET_FOR_MACHINES [[gnu::flatten]] void advance(const FlightModel& model, FlightState& state,
                                                  plant::Plant& plant, const Stride& stride,
                                                  TickReport& report, ExternalCup* external_cup) {
    const bool has_cup = model.airframe.has_cup;
    const plant::StepMode mode{.step_s = stride.step_s(),
                               .contacts = stride.contacts,
                               .legs_lost = state.faults.now.legs_lost};
    const AirLoad air = load_of_air(model, state);
    for (int k = 0; k < stride.steps; ++k) {
        const double time_s = seconds(state.tick) + k * mode.step_s;
        if (k > 0) {
            see_motion(model, state.truth, plant);
        }
        plant.apply(plant::Body::base, air.wrench_W, state.truth.base.p_WF_m);
        if (model.pushed_by_more) {
            apply_more(model, state, plant, mode.step_s);
        }
        if (has_cup) {
            apply_cup(model, state, plant, time_s, mode, report, external_cup);
        }
        plant.step(mode);
        if (has_cup) {
            const plant::SliderMotion slider = plant.slider();
            state.truth.slider = {.position_m = slider.position_m,
                                  .velocity_m_s = slider.velocity_m_s,
                                  .force_N = -slider.force_N};
            see_contact(report.contact, state.truth.slider, state.cup.status);
        }
    }
    report.physics_steps += stride.steps;
    state.truth.thrust_N = air.thrust_N;
}

}  // namespace limpet::simulation
