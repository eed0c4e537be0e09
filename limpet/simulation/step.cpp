// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/step.hpp"

#include "limpet/core/machines.hpp"
#include "limpet/simulation/advance.hpp"
#include "limpet/simulation/collision.hpp"
#include "limpet/simulation/rig.hpp"

// The loop, drawn in docs/design.md: a line a station, in the order in which data flows.
//
//   plant -> sensors -> autopilot.estimate -> guidance -> autopilot.control -> rotors -> plant
//                                                   └---> pump, valve -> cup ----------> plant

namespace limpet::simulation {
namespace {

void see_truth(const FlightModel& model, FlightState& state, const plant::Plant& plant) {
    Truth& truth = state.truth;
    truth.time_s = seconds(state.tick);
    see_motion(model, truth, plant);
    truth.cup_status = state.cup.status;
    if (model.airframe.has_cup) {
        see_gap(model, truth);
    }
    truth.rotor_speed_rad_s = state.rotors.speed_rad_s;
    truth.battery = vehicle::status(model.airframe.battery, state.battery);
    truth.legs_force_W_N = plant.contact_force_W();
}

/// What the vehicle receives of what its sensors report.
void sense(const FlightModel& model, FlightState& state, const plant::Plant& plant,
           TickReport& report) {
    const auto sample = [&] {
        if (!model.swell.moves) {
            return sensors::sense(model.sensors, state.sensors, state.truth, plant, state.tick);
        }
        const vehicle::SwellMotion swell = swell_motion(model.swell, seconds(state.tick));
        sensors::sense(model.sensors, state.sensors, state.truth, plant, state.tick,
                       {swell.p_EW_W_m, swell.v_EW_W_m_s});
    };
    if (!model.faults.any()) {
        return sample();
    }
    const double time_s = seconds(state.tick);
    if (!state.faults.now.link_lost) {
        state.faults.through = state.guidance.setpoint;
    }
    faults::step(model.faults, state.faults, state.guidance.state, model.airframe.rotors.size(),
                 time_s, report.events);
    // The sensors go on from what they sent, not from what was received of it.
    std::swap(state.sensors.readings, state.faults.sensed);
    sample();
    std::swap(state.sensors.readings, state.faults.sensed);
    faults::hear(model.faults, state.faults, time_s, state.sensors.readings);
}

/// The built-in autopilot lives in the state; one behind a wire only leaves its estimate there.
void estimate(const FlightModel& model, FlightState& state,
              autopilot::ExternalAutopilot* external) {
    if (external != nullptr) {
        state.autopilot.estimate = external->estimate(seconds(state.tick));
    } else {
        autopilot::estimate(model.autopilot, state.autopilot, state.sensors.readings);
    }
    if (model.faults.any()) {
        faults::mislead(model.faults, state.faults, seconds(state.tick), state.autopilot.estimate);
    }
}

void guide(const FlightModel& model, FlightState& state, guidance::EventList& events) {
    const double time_s = seconds(state.tick);
    const double ahead_s = state.faults.now.clock_ahead_s;
    if (ahead_s == 0.0) {
        guidance::update(model.guidance, model.task, state.guidance, state.sensors.readings,
                         state.autopilot.estimate, time_s, events);
        return;
    }
    Readings readings = state.sensors.readings;
    Estimate estimate = state.autopilot.estimate;
    faults::stamp_anew(model.faults, state.faults, readings, estimate);
    guidance::EventList reported;
    guidance::update(model.guidance, model.task, state.guidance, readings, estimate,
                     time_s + ahead_s, reported);
    for (std::size_t i = 0; i < reported.count; ++i) {
        reported.events[i].time_s -= ahead_s;
        events.add(reported.events[i]);
    }
}

RotorCommand control(const FlightModel& model, FlightState& state, const Setpoint& setpoint,
                     autopilot::ExternalAutopilot* external) {
    if (external == nullptr) {
        return autopilot::control(model.autopilot, state.autopilot, setpoint, seconds(state.tick));
    }
    RotorCommand rotors = external->command();
    rotors.command.resize(model.airframe.rotors.size());
    return rotors;
}

}  // namespace

LIMPET_FOR_MACHINES [[gnu::flatten]] void step(const FlightModel& model, FlightState& state,
                                               plant::Plant& plant, TickReport& report,
                                               const Outside& outside) {
    const vehicle::AirframeNumbers& airframe = model.airframe;
    const double time_s = seconds(state.tick);
    const bool controls = due(state.tick, model.control_rate_Hz);
    report.restart();
    guidance::EventList& events = report.events;

    sense(model, state, plant, report);
    const faults::Acting& acting = state.faults.now;
    const Readings& readings = state.sensors.readings;
    if (controls) {
        estimate(model, state, outside.autopilot);
    }
    if (model.mount != vehicle::Mount::free) {
        operate(model, state, events);  // a bench in guidance's place
    } else if (acting.guidance_stalls) {
        // its last word stands
    } else if (outside.guidance != nullptr) {
        outside.guidance->exchange(readings, state.autopilot.estimate, time_s, state.guidance,
                                   events);
        if (outside.autopilot != nullptr) {
            state.guidance.setpoint.armed = state.command.armed;
        }
    } else if (due(state.tick, model.guidance_rate_Hz)) {
        guide(model, state, events);
    }
    const Setpoint& told = acting.link_lost ? state.faults.through : state.guidance.setpoint;
    if (controls && outside.autopilot != nullptr) {
        outside.autopilot->tell(readings, told, time_s);
    }
    const Stride stride =
        outside.wants_every_tick() ? one_tick(model, state) : next_stride(model, state);
    const auto move = [&] {
        for (int tick = 0; tick < stride.ticks; ++tick) {
            vehicle::step(model.wind, state.wind);
            vehicle::step(model.wall_air, state.wall_air);
        }
        advance(model, state, plant, stride, report, outside.cup);
    };
    const bool pump_ran = state.cup.status.pump_running;
    if (stride.pushed_at_its_start()) {  // who is told computes meanwhile
        move();
    }
    if (controls) {
        state.command = control(model, state, told, outside.autopilot);
    }
    vehicle::step(airframe.rotor, model.rotor_lag, state.rotors, state.command,
                  {.battery_share = vehicle::drive_share(airframe, state.battery.voltage_V),
                   .speed_share = acting.rotors_hit ? &acting.speed_share : nullptr},
                  stride.ticks);
    if (acting.charge_at_most < 1.0) {
        vehicle::drain(airframe.battery, state.battery, acting.charge_at_most);
    }
    vehicle::step(airframe.battery, state.battery,
                  vehicle::mechanical_power_W(airframe.rotor, state.rotors), pump_ran,
                  state.command.armed, stride.ticks * kTick_s);
    if (!stride.pushed_at_its_start()) {
        move();
    }
    state.tick += stride.ticks;
    see_truth(model, state, plant);
    if (!state.ending) {
        state.ending = collision(model, state.truth);
    }
}

}  // namespace limpet::simulation
