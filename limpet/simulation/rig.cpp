// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/rig.hpp"

#include "limpet/core/errors.hpp"
#include "limpet/simulation/observe.hpp"

namespace limpet::simulation {
namespace {

void enter(FlightState& state, guidance::PerchingState next, double time_s) {
    state.guidance.state = next;
    state.guidance.since_s = time_s;
}

void report(const FlightState& state, EventName name, std::string_view reason, double time_s,
            guidance::EventList& events) {
    events.add(make_event(time_s, "rig", name, reason,
                          {{"pitch_deg", pitch_deg(state.truth)},
                           {"force_N", state.truth.slider.force_N},
                           {"pressure_Pa", state.cup.status.pressure_Pa}}));
}

void end(FlightState& state, Outcome outcome, std::string_view reason, double time_s) {
    enter(state, guidance::PerchingState::finished, time_s);
    state.guidance.ending = guidance::Ending{.outcome = outcome, .reason = reason};
}

/// What a failed seal failed at, judged once the press has come and gone.
void watch_touch(const FlightModel& model, FlightState& state) {
    RigState& rig = state.rig;
    const CupPhase phase = state.cup.status.phase;
    if (phase != CupPhase::attached) {
        rig.attached_since_s = -1.0;
    } else if (rig.attached_since_s < 0.0) {
        rig.attached = true;
        rig.attached_since_s = seconds(state.tick);
    }
    if (phase == CupPhase::free) {
        return;
    }
    if (-state.truth.slider.force_N > state.cup.demand.threshold_N) {
        rig.pressed = true;
        rig.straight =
            rig.straight || suction::lip_motion(model.cup.wall, state.truth.cup).tilt_rad() <
                                state.cup.demand.tilt_limit_rad;
    }
    rig.sealed = rig.sealed || phase == CupPhase::sealing || phase == CupPhase::attached;
}

std::string_view why_not(const FlightModel& model, const RigState& rig) {
    if (rig.attached) {
        return "came off after it had attached";
    }
    if (rig.sealed) {
        return "contact too short: came off before the pressure was below the threshold";
    }
    if (!rig.pressed) {
        return "not enough force: pressed less than the spot requires";
    }
    if (!follows(model.cup.parameters.lip, model.cup.wall)) {
        return "the wall is rounder than the lip follows";
    }
    return rig.straight ? "the lip slid or rocked while it was pressed"
                        : "tilted too far while it was pressed";
}

void report_first_touch(FlightState& state, double time_s, guidance::EventList& events) {
    if (!state.rig.touched && state.cup.status.phase != CupPhase::free) {
        state.rig.touched = true;
        report(state, EventName::impact, "the lip meets the wall", time_s, events);
    }
}

void operate_pendulum(const FlightModel& model, FlightState& state, double time_s,
                      guidance::EventList& events) {
    RigState& rig = state.rig;
    const CupPhase phase = state.cup.status.phase;
    if (state.guidance.state == guidance::PerchingState::approaching && rig.touched) {
        enter(state, guidance::PerchingState::holding, time_s);
    }
    if (phase != CupPhase::free) {
        rig.off_since_s = -1.0;
    } else if (rig.touched && rig.off_since_s < 0.0) {
        rig.off_since_s = time_s;
    }
    if (rig.attached_since_s >= 0.0 && time_s - rig.attached_since_s >= model.pendulum_hold_s) {
        report(state, EventName::hold_over, "held", time_s, events);
        end(state, Outcome::perched, "the cup attached and held", time_s);
    } else if (rig.off_since_s >= 0.0 && time_s - rig.off_since_s >= model.pendulum_hold_s) {
        report(state, EventName::hold_over, "off the wall", time_s, events);
        end(state, Outcome::failed_to_seal, why_not(model, rig), time_s);
    }
}

void operate_press_rig(const FlightModel& model, FlightState& state, double time_s,
                       guidance::EventList& events) {
    const vehicle::PressRigParameters& press = model.press_rig;
    const CupStatus& cup = state.cup.status;
    const double age_s = time_s - state.guidance.since_s;
    if (state.guidance.state == guidance::PerchingState::approaching) {
        state.rig.advance_m += press.approach_speed_m_s * kTick_s;
        if (-state.truth.slider.force_N >= press.press_N && cup.phase != CupPhase::free) {
            enter(state, guidance::PerchingState::holding, time_s);
            state.guidance.setpoint.pump_on = true;
        }
    } else if (state.guidance.state == guidance::PerchingState::holding && age_s >= press.seal_s) {
        report(state, EventName::hold_over, "sealed for long enough", time_s, events);
        if (cup.phase != CupPhase::attached) {
            end(state, Outcome::failed_to_seal, why_not(model, state.rig), time_s);
        } else if (press.leak_s <= 0.0) {
            end(state, Outcome::perched, "the cup attached, no leak was requested", time_s);
        } else {
            report(state, EventName::pump_off, "leaks from here", time_s, events);
            enter(state, guidance::PerchingState::releasing, time_s);
            state.guidance.setpoint.pump_on = false;
        }
    } else if (state.guidance.state == guidance::PerchingState::releasing) {
        if (!state.rig.released && cup.pressure_Pa > model.guidance.detach_pressure_Pa) {
            state.rig.released = true;
            report(state, EventName::pressure_released, "pressure above detachment", time_s,
                   events);
        }
        if (age_s >= press.leak_s) {
            end(state, state.rig.released ? Outcome::released : Outcome::perched,
                state.rig.released ? "the seal leaked until it would let go"
                                   : "the seal still holds after the leak",
                time_s);
        }
    }
}

}  // namespace

Wrench mount_wrench_W(const FlightModel& model, const FlightState& state) {
    switch (model.mount) {
        case vehicle::Mount::free: return {};
        case vehicle::Mount::pendulum: return rope_wrench_W(model.pendulum, state.truth.base);
        case vehicle::Mount::press_rig: {
            const bool moves = state.guidance.state == guidance::PerchingState::approaching;
            Kinematics held;
            held.p_WF_m = model.start.p_WB_m + state.rig.advance_m * model.ahead_W;
            held.q_WF = attitude(model.start);
            if (moves) {
                held.v_WF_W_m_s = model.press_rig.approach_speed_m_s * model.ahead_W;
            }
            return clamp_wrench_W(model.clamp, held, state.truth.base);
        }
    }
    throw InternalError("mount out of range");
}

void operate(const FlightModel& model, FlightState& state, guidance::EventList& events) {
    const double time_s = seconds(state.tick);
    if (state.tick == 0) {
        report(state, EventName::approach_started,
               model.mount == vehicle::Mount::pendulum ? "let go" : "the clamp moves", time_s,
               events);
    }
    report_first_touch(state, time_s, events);
    watch_touch(model, state);
    if (model.mount == vehicle::Mount::pendulum) {
        operate_pendulum(model, state, time_s, events);
    } else {
        operate_press_rig(model, state, time_s, events);
    }
}

}  // namespace limpet::simulation
