// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/bring_up.hpp"

#include <fmt/format.h>

#include <limits>

#include "limpet/core/errors.hpp"
#include "limpet/simulation/advance.hpp"
#include "limpet/simulation/pace.hpp"
#include "limpet/simulation/step.hpp"

namespace limpet::simulation {
namespace {

/// Close enough to the start, and slow enough, to begin.
struct Still {
    double near_m;
    double slow_m_s;
};
/// It stands a little off its set-point in wind. Source: PX4 v1.15.1 in 6 m/s, seen up to
/// 0.18 m
constexpr Still kByMotionCapture{.near_m = 0.3, .slow_m_s = 0.08};
/// What it follows wanders. Source: PX4 v1.15.1 hovering for 110 s, seen up to 0.37 m and 0.34 m/s
constexpr Still kByGps{.near_m = 0.5, .slow_m_s = 0.5};

/// The flight without its mission: hovers at the start for ever, in the mean wind. Gusts and
/// swell begin with the flight, as they do for the built-in autopilot: in them nothing stands
/// still.
FlightModel hovering(const FlightModel& model) {
    FlightModel waiting = model;
    waiting.task = {
        .perch = false, .take_off = false, .hover_s = std::numeric_limits<double>::infinity()};
    waiting.wind.gusts = false;
    waiting.swell = {};
    return waiting;
}

void rest_on_stand(const FlightModel& model, const Vector3& stand_W_m, plant::Plant& plant,
                   Truth& truth) {
    plant.set_pose(stand_W_m, attitude(model.start));
    see_motion(model, truth, plant);
}

/// The start as the autopilot believes it, from where it believes the stand to be: GPS has
/// another origin and is off by metres, motion capture by millimetres.
Vector3 believed_start(const Estimate& on_stand, double stand_below_m) {
    return on_stand.p_WB_m - Vector3(0.0, 0.0, stand_below_m);
}

/// By its own account: all that it can steer by.
bool stands_still(const Estimate& estimate, const Vector3& start_W_m, const Still& still) {
    return estimate.valid && (estimate.p_WB_m - start_W_m).norm() < still.near_m &&
           estimate.v_WB_m_s.norm() < still.slow_m_s;
}

/// A flight's first state with the vehicle, rotors and autopilot as they are.
Snapshot first_state(const FlightModel& model, const FlightState& now, const plant::Plant& plant,
                     std::uint32_t run) {
    FlightState state = start(model, now.truth.base, now.truth.cup, run);
    state.truth.rotor_speed_rad_s = now.truth.rotor_speed_rad_s;
    state.truth.payload = now.truth.payload;
    state.rotors = now.rotors;
    state.command = now.command;
    state.autopilot.estimate = now.autopilot.estimate;
    state.autopilot.estimate.time_s = 0.0;
    state.guidance = start_perching(model.task, state.autopilot.estimate, 0.0);
    state.sensors = sensors::start(model.sensors, state.truth, model.seed, run, model.noise);
    return {.state = state, .plant = plant.save(), .seen = {}};
}

std::string obstacle_of(const autopilot::ExternalAutopilot& autopilot,
                        const ExternalGuidance* guidance, bool on_stand) {
    std::string obstacle = autopilot.obstacle();
    if (obstacle.empty() && guidance != nullptr) {
        obstacle = guidance->obstacle();
        if (obstacle.empty() && on_stand) {
            obstacle = "the vehicle stands: the companion has not taken off";
        }
    }
    return obstacle;
}

[[noreturn]] void give_up(const std::string& why, const std::string& obstacle) {
    throw InputError("no flight: " + why + (obstacle.empty() ? "" : ": " + obstacle));
}

}  // namespace

Snapshot bring_up(const FlightModel& model, const Outside& outside, const BringUp& options) {
    autopilot::ExternalAutopilot& autopilot = *outside.autopilot;
    const FlightModel waiting = hovering(model);
    const Vector3 stand_W_m = model.start.p_WB_m + Vector3(0.0, 0.0, options.stand_below_m);
    const double weight_N = carried_mass_kg(model.airframe) * kGravity_m_s2;

    const std::unique_ptr<plant::Plant> made = model.plant->make();
    plant::Plant& plant = *made;
    FlightState state = start(waiting, plant, options.run);
    state.rotors = vehicle::standing(model.airframe.rotors.size());
    state.command = {.command = RotorList<double>(model.airframe.rotors.size())};
    rest_on_stand(model, stand_W_m, plant, state.truth);
    state.sensors =
        sensors::start(model.sensors, state.truth, model.seed, options.run, model.noise);

    TickReport report;
    Pace pace(options.speed);
    const bool by_gps = model.scenario->autopilot.EKF2_GPS_CTRL > 0;
    const Still limits = by_gps ? kByGps : kByMotionCapture;
    bool on_stand = true;
    Vector3 start_W_m = model.start.p_WB_m;  ///< as the autopilot believes it
    Tick still_since = -1;
    std::string obstacle;
    while (seconds(state.tick) < options.limit_s) {
        step(waiting, state, plant, report, outside);
        on_stand = on_stand && state.truth.thrust_N < weight_N;
        if (on_stand) {
            rest_on_stand(model, stand_W_m, plant, state.truth);
            if (state.autopilot.estimate.valid) {
                start_W_m = believed_start(state.autopilot.estimate, options.stand_below_m);
                state.guidance.line_W_m = state.guidance.entry_p_W_m = start_W_m;
            }
        }
        if (due(state.tick, model.control_rate_Hz)) {
            std::string now = obstacle_of(autopilot, outside.guidance, on_stand);
            if (options.on_obstacle && now != obstacle) {
                options.on_obstacle(now);
            }
            obstacle = std::move(now);
        }
        if (autopilot.failure()) {
            give_up("the autopilot failed before the start", std::string(*autopilot.failure()));
        }
        if (options.stop != nullptr && *options.stop) {
            throw Interrupted("interrupted while the autopilot was brought up");
        }
        if (const auto& ending = state.ending ? state.ending : state.guidance.ending) {
            give_up(fmt::format("{} on the way to the start", ending->reason.view()), obstacle);
        }
        if (outside.guidance != nullptr && !on_stand) {
            return first_state(model, state, plant, options.run);
        }
        const bool still = !on_stand && stands_still(state.autopilot.estimate, start_W_m, limits);
        still_since = !still ? -1 : still_since < 0 ? state.tick : still_since;
        if (still_since >= 0 && seconds(state.tick - still_since) >= options.steady_s) {
            return first_state(model, state, plant, options.run);
        }
        pace.wait_until(seconds(state.tick));
    }
    const Estimate& believed = state.autopilot.estimate;
    give_up(fmt::format("the vehicle does not hover at its start after {} s of simulated time "
                        "({:.2f} m off, {:.2f} m/s; at most {} m, {} m/s for {} s)",
                        options.limit_s, (believed.p_WB_m - start_W_m).norm(),
                        believed.v_WB_m_s.norm(), limits.near_m, limits.slow_m_s, options.steady_s),
            obstacle);
}

}  // namespace limpet::simulation
