// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/oscillation.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/plant/reduced_plant.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/advance.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::paper {
namespace {

constexpr double kWatch_s = 20.0;
constexpr double kSample_s = 0.01;
constexpr double kTooFar_deg = 15.0;  ///< beyond, nothing is linear any more

/// Nothing random: a kick alone is to be seen.
void silence(scenario::Scenario& scenario) {
    for (const BoundParameter& row : sensor_rows(scenario.sensors)) {
        const auto has = [name = std::string_view(row.name)](const char* part) {
            return name.find(part) != name.npos;
        };
        if ((has("_noise") || has("_bias") || has("_walk") || has("_dropout")) &&
            row.minimum <= 0.0 && !has("_tau")) {
            row.value.set(0.0);
        }
    }
    scenario.environment = {};
}

/// Turns the vehicle about its cup's joint with a speed, the cup itself staying as it is.
void turn_about_joint(plant::ReducedPlant& plant, const vehicle::Airframe& airframe,
                      double pitch_rate_rad_s) {
    // Speeds: place (down), angular velocity (about y), slider, cup_pitch, cup_yaw.
    constexpr std::size_t kDown = 2, kPitch = 4, kCupPitch = 7;
    std::array<double, 2 * plant::kFreedoms> step{};
    double* const speeds = step.data() + plant::kFreedoms;
    speeds[kDown] = pitch_rate_rad_s * airframe.cup.joint_x_m;
    speeds[kPitch] = pitch_rate_rad_s;
    speeds[kCupPitch] = -pitch_rate_rad_s;
    plant.displace(step);
}

double pitch_deg(const simulation::Flight& flight) {
    return degrees(euler_from_quaternion(flight.state().truth.base.q_WF).pitch_rad);
}

bool waits(const simulation::Flight& flight) {
    return !flight.ended() && flight.state().guidance.state == guidance::PerchingState::releasing;
}

struct Extreme {
    double time_s;
    double value;
};

/// Highest and lowest points in turn, each farther than `floor` from the one before.
std::vector<Extreme> extremes(const std::vector<double>& time_s, const std::vector<double>& values,
                              double floor) {
    std::vector<Extreme> found;
    Extreme high{time_s.front(), values.front()};
    Extreme low = high;
    int direction = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Extreme now{time_s[i], values[i]};
        high = now.value > high.value ? now : high;
        low = now.value < low.value ? now : low;
        if (direction >= 0 && high.value - now.value > floor) {
            found.push_back(high);
            low = now;
            direction = -1;
        } else if (direction <= 0 && now.value - low.value > floor) {
            found.push_back(low);
            high = now;
            direction = 1;
        }
    }
    return found;
}

}  // namespace

Overrides joined(Overrides first, const Overrides& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

KickedSwing measure_swing(std::vector<double> time_s, std::vector<double> pitch_deg,
                          double floor_deg) {
    constexpr std::size_t kFewest = 4;
    KickedSwing swing{.growth_1_s = kNaN,
                      .frequency_Hz = kNaN,
                      .time_s = std::move(time_s),
                      .pitch_deg = std::move(pitch_deg)};
    std::vector<Extreme> turns = extremes(swing.time_s, swing.pitch_deg, floor_deg);
    if (!turns.empty()) {
        turns.erase(turns.begin());  // where the trace began, not a turn
    }
    if (turns.size() < kFewest) {
        return swing;
    }
    double n = 0.0, sum_t = 0.0, sum_y = 0.0, sum_tt = 0.0, sum_ty = 0.0;
    for (std::size_t i = 1; i < turns.size(); ++i) {
        const double t = 0.5 * (turns[i].time_s + turns[i - 1].time_s);
        const double y = std::log(std::abs(turns[i].value - turns[i - 1].value));
        n += 1.0;
        sum_t += t;
        sum_y += y;
        sum_tt += t * t;
        sum_ty += t * y;
    }
    swing.growth_1_s = (n * sum_ty - sum_t * sum_y) / (n * sum_tt - sum_t * sum_t);
    swing.frequency_Hz = 0.5 * n / (turns.back().time_s - turns.front().time_s);
    return swing;
}

std::optional<KickedSwing> kicked_swing(const std::string& scenario, const Overrides& overrides,
                                        double kick_deg) {
    // A vehicle that leans before the wall, by its swing, is taken to fly in wind, and holds its
    // altitude on the cup, which damps: not the loop that is linearised.
    const Overrides patient = {"guidance.rest_s=0.5", "guidance.release_limit_s=600",
                               "guidance.oscillation_limit_deg=60", "guidance.stuck_s=60",
                               "guidance.calm_lean_deg=60"};
    scenario::Scenario quiet =
        scenario::load_scenario(scenario, {.overrides = joined(patient, overrides)});
    silence(quiet);
    quiet.engine = &plant::kReducedEngine;  // whose bodies can be pushed
    const auto model = simulation::build_model(quiet);
    constexpr double kLeast_Hz = 0.3;  // where the loop hardly swings at all
    const auto modes = stability::LevelOnCup(model).modes();
    const auto mode = modes ? pitch_mode(*modes) : std::nullopt;
    if (!mode) {
        return std::nullopt;
    }
    const double frequency_Hz = std::max(kLeast_Hz, mode->frequency_Hz);
    simulation::Flight twin(model);
    while (!waits(twin)) {
        if (twin.ended()) {
            return std::nullopt;
        }
        twin.tick();
    }
    simulation::Flight kicked(model);
    simulation::Snapshot snapshot = twin.save();
    plant::ReducedPlant plant(model->plant);
    plant.restore(snapshot.plant);
    turn_about_joint(plant, quiet.airframe, radians(kick_deg) * 2.0 * kPi * frequency_Hz);
    snapshot.plant = plant.save();
    simulation::see_motion(*model, snapshot.state.truth, plant);
    kicked.restore(snapshot);

    std::vector<double> time_s, difference_deg;
    const double start_s = seconds(snapshot.state.tick);
    while (waits(twin) && waits(kicked)) {
        const double since_s = seconds(kicked.state().tick) - start_s;
        if (since_s > kWatch_s || std::abs(pitch_deg(kicked)) > kTooFar_deg) {
            break;
        }
        if (since_s >= kSample_s * static_cast<double>(time_s.size())) {
            time_s.push_back(since_s);
            difference_deg.push_back(pitch_deg(kicked) - pitch_deg(twin));
        }
        twin.tick();
        kicked.tick();
    }
    return measure_swing(std::move(time_s), std::move(difference_deg));
}

stability::Axis motor_lags(std::vector<double> lag_s) {
    return {{"vehicle.rotor.time_constant_up_s", "vehicle.rotor.time_constant_down_s"},
            std::move(lag_s)};
}

stability::Axis pivots(std::vector<double> pivot_m) {
    return {{"vehicle.cup.joint_x_m"}, std::move(pivot_m)};
}

void fill(stability::StabilityMap& map, int jobs) {
    map.growth_1_s.assign(map.size(), 0.0);
    for_each_index(map.size(), jobs, [&](std::size_t i) {
        map.growth_1_s[i] = required(swing_at(map, i), kSwings).growth_1_s;
    });
}

double SwingMissions::quantile(double share) const {
    return pitch_deg.empty() ? kNaN : statistics::quantile(pitch_deg, share);
}

double SwingMissions::median_swing_deg() const {
    return swing_deg.empty() ? kNaN : statistics::quantile(swing_deg, 0.5);
}

SwingMissions swing_missions(const std::string& scenario, const Overrides& overrides,
                             std::uint32_t runs, int jobs) {
    const auto model =
        simulation::build_model(scenario::load_scenario(scenario, {.overrides = overrides}));
    std::vector<simulation::FlightResult> results(runs);
    for_each_index(runs, jobs, [&](std::size_t run) {
        results[run] = simulation::fly(model, {}, {}, static_cast<std::uint32_t>(run));
    });
    SwingMissions missions;
    missions.runs = runs;
    for (const simulation::FlightResult& result : results) {
        missions.attached += std::isfinite(result.metrics.perched_pitch_deg) ? 1U : 0U;
        missions.crashed += result.outcome == Outcome::crashed ? 1U : 0U;
        if (std::isfinite(result.metrics.pitch_oscillation_max_deg)) {
            missions.pitch_deg.push_back(result.metrics.pitch_oscillation_max_deg);
            missions.swing_deg.push_back(result.metrics.pitch_swing_deg);
        }
    }
    std::sort(missions.pitch_deg.begin(), missions.pitch_deg.end());
    std::sort(missions.swing_deg.begin(), missions.swing_deg.end());
    return missions;
}

double hover_tilt_deg(const std::string& scenario) {
    constexpr double kSettle_s = 5.0;
    simulation::Flight flight(simulation::build_model(
        scenario::load_scenario(scenario, {.overrides = {"mission=hover"}})));
    double worst_rad = 0.0;
    while (!flight.ended()) {
        flight.tick();
        if (seconds(flight.state().tick) > kSettle_s) {
            const Vector3 z_B_W = flight.state().truth.base.q_WF * Vector3::UnitZ();
            worst_rad = std::max(worst_rad, std::acos(std::min(1.0, z_B_W.z())));
        }
    }
    require(flight.state().ending->outcome == Outcome::released, "a hover that ends as commanded");
    return degrees(worst_rad);
}

}  // namespace limpet::paper
