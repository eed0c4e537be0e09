// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/rigs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/models/links.hpp"
#include "limpet/models/model_writer.hpp"
#include "limpet/plant/engines.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::paper {
namespace {

struct Wall {
    const char* surface;
    const char* scenario;
};
constexpr std::array<Wall, 4> kWalls = {{{"porous concrete", "perch_concrete"},
                                         {"cinder block", "perch_cinder_block"},
                                         {"turbine blade", "perch_turbine_blade"},
                                         {"metal", "perch_metal"}}};

/// A thrown, tumbling rigid vehicle against gravity and the conservation of spin and energy.
double free_body_error(const plant::Engine& engine) {
    vehicle::Airframe airframe = scenario::load_scenario("perch_concrete").airframe;
    airframe.has_cup = false;  // eqs. (1), (2) are those of one body
    models::Scene scene;
    scene.wall.present = false;
    scene.ground_z_W_m = 100.0;
    const std::unique_ptr<plant::Plant> made = engine.make(airframe, scene)->make();
    plant::Plant& plant = *made;
    const Vector3 v0(1.0, -0.5, -2.0), w0(3.0, 2.0, -1.0);
    plant.set_pose(Vector3::Zero(), Quaternion::Identity(), v0, w0);
    const Matrix3 inertia = airframe.inertia_kg_m2.asDiagonal();
    const auto spin = [&] {
        const Kinematics base = plant.kinematics(plant::Body::base);
        return Vector3(base.q_WF * (inertia * base.w_WF_F_rad_s));
    };
    const Vector3 spin_before = spin();
    constexpr double kStep_s = 1e-4, kTime_s = 1.0;
    for (int k = 0; k < static_cast<int>(std::lround(kTime_s / kStep_s)); ++k) {
        plant.step({.step_s = kStep_s, .contacts = false});
    }
    const Kinematics end = plant.kinematics(plant::Body::base);
    const Vector3 fallen =
        v0 * kTime_s + 0.5 * kTime_s * kTime_s * Vector3(0.0, 0.0, kGravity_m_s2);
    const double energy = 0.5 * w0.dot(inertia * w0);
    const double energy_end = 0.5 * end.w_WF_F_rad_s.dot(inertia * end.w_WF_F_rad_s);
    return std::max({(end.p_WF_m - fallen).norm() / fallen.norm(),
                     (spin() - spin_before).norm() / spin_before.norm(),
                     std::abs(energy_end - energy) / energy});
}

/// Moves a sealed cup until it lets go.
CupStatus last_hold(const scenario::Scenario& scenario, double pressure_Pa, const Vector3& v_T_m_s,
                    const Vector3& w_C_rad_s) {
    constexpr double kStep_s = 1e-3, kLongest_s = 60.0;
    const suction::CupModel model{.parameters = scenario.cup, .wall = scenario.wall.geometry};
    suction::CupState state;
    state.status.phase = CupPhase::attached;
    state.touches = 1;
    Kinematics cup{.p_WF_m = model.wall.p_WT_m,
                   .q_WF = Quaternion(model.wall.R_WT),
                   .v_WF_W_m_s = model.wall.R_WT * v_T_m_s,
                   .w_WF_F_rad_s = w_C_rad_s};
    for (int k = 0; k < static_cast<int>(std::lround(kLongest_s / kStep_s)); ++k) {
        state.mean_pressure_Pa = pressure_Pa;
        const CupStatus before = state.status;
        const suction::CupOutput output =
            step(model, state, scenario.wall.surface, cup,
                 {.time_s = k * kStep_s, .press_N = 0.0, .pump_on = true}, kStep_s);
        if (output.event && output.event->name == EventName::contact_lost) {
            return before;
        }
        cup.p_WF_m += kStep_s * cup.v_WF_W_m_s;
        cup.q_WF =
            (cup.q_WF * quaternion_from_rotation_vector(kStep_s * cup.w_WF_F_rad_s)).normalized();
    }
    throw InternalError("a cup that nothing breaks off");
}

BreakOff break_off(const char* surface, const scenario::Scenario& scenario, double pressure_Pa) {
    const Vector3 still = Vector3::Zero(), away_m_s(-2e-3, 0.0, 0.0), down_m_s(0.0, 0.0, 2e-3),
                  tilt_rad_s(0.0, 0.02, 0.0);
    BreakOff load{.surface = surface,
                  .pressure_Pa = pressure_Pa,
                  .pull_N = last_hold(scenario, pressure_Pa, away_m_s, still).pull_N,
                  .shear_N = last_hold(scenario, pressure_Pa, down_m_s, still).shear_N,
                  .peel_N_m = last_hold(scenario, pressure_Pa, still, tilt_rad_s).peel_N_m};
    load.pull_in_weights = load.pull_N / (scenario.airframe.mass_kg * kGravity_m_s2);
    return load;
}

EnergyUse energy_of(const std::string& what, double energy_Wh, double time_s,
                    const vehicle::Airframe& airframe) {
    constexpr double kCell_V = 3.7;  // nominal
    const double battery_Wh = airframe.battery.cells * airframe.battery.capacity_Ah * kCell_V;
    const double power_W = energy_Wh * 3600.0 / time_s;
    return {.what = what, .power_W = power_W, .endurance_h = battery_Wh / power_W};
}

/// With a value turned, where it is assumed.
scenario::Scenario scenario_with(const char* name, std::vector<std::string> overrides,
                                 const std::optional<Turn>& turn) {
    const scenario::Scenario as_it_is = scenario::load_scenario(name, {.overrides = overrides});
    const auto set = turn ? override_of(*turn, as_it_is) : std::nullopt;
    if (!set) {
        return as_it_is;
    }
    overrides.push_back(*set);
    return scenario::load_scenario(name, {.overrides = overrides});
}

/// From pump off to detached, in a whole flight with all the time in the world.
double release_s(const Wall& wall, bool valve, std::vector<std::string> overrides,
                 const std::optional<Turn>& turn) {
    for (const char* key :
         {"guidance.rest_s=1", "guidance.release_limit_s=600", "guidance.stuck_s=60"}) {
        overrides.emplace_back(key);
    }
    overrides.emplace_back(valve ? "suction.valve_fitted=1" : "suction.valve_fitted=0");
    return simulation::fly(
               simulation::build_model(scenario_with(wall.scenario, std::move(overrides), turn)))
        .metrics.release_s;
}

EnergyUse hovering(const std::optional<Turn>& turn) {
    const scenario::Scenario hover = scenario_with("hover", {"vehicle=perching_uav"}, turn);
    const simulation::FlightResult hovered = simulation::fly(simulation::build_model(hover));
    return energy_of("hovering", hovered.metrics.energy_flying_Wh, hovered.performance.simulated_s,
                     hover.airframe);
}

EnergyUse perched(const Wall& wall, const std::optional<Turn>& turn) {
    constexpr double kRest_s = 60.0;
    const scenario::Scenario scenario =
        scenario_with(wall.scenario, {"mission=perch", "guidance.rest_s=60"}, turn);
    const simulation::FlightResult rested = simulation::fly(simulation::build_model(scenario));
    EnergyUse use = energy_of(std::string("perched on ") + wall.surface,
                              rested.metrics.energy_perched_Wh, kRest_s, scenario.airframe);
    use.getting_there_Wh = rested.metrics.energy_flying_Wh;
    return use;
}

}  // namespace

void measure_vehicle(Evidence& evidence) {
    const scenario::Scenario scenario = scenario::load_scenario("perch_concrete");
    const vehicle::Airframe& airframe = scenario.airframe;
    evidence.set("vehicle.mass_kg", airframe.mass_kg);
    evidence.set("vehicle.wheelbase_m",
                 (airframe.rotors[0].p_B_m - airframe.rotors[1].p_B_m).norm());
    constexpr double kInch_m = 0.0254;
    evidence.set("vehicle.propeller_diameter_in", 2.0 * airframe.rotor.radius_m / kInch_m);
    evidence.set("vehicle.battery_cells", airframe.battery.cells);
    evidence.set("vehicle.battery_capacity_Ah", airframe.battery.capacity_Ah);
    evidence.set("vehicle.pump_x_m", airframe.pump_B_m.x());
    evidence.set("vehicle.lidar_rate_Hz", scenario.sensors.lidar_rate_Hz);
    evidence.set("vehicle.lidar_x_m", airframe.lidar_x_m);
    const std::vector<models::Link> links = models::make_links(airframe);
    evidence.set(
        "vehicle.cup_joint_freedoms",
        static_cast<double>(std::count_if(links.begin(), links.end(), [](const models::Link& l) {
            return l.joint && l.joint->kind == models::Joint::Kind::revolute;
        })));
    evidence.set("vehicle.pitch_on_legs_deg", degrees(vehicle::pitch_on_legs_rad(airframe)));
    evidence.set("free_body.relative_error", std::max(free_body_error(plant::kReducedEngine),
                                                      free_body_error(plant::kMujocoEngine)));
    evidence.set(
        "estimator.motion_capture_only",
        scenario.autopilot.EKF2_EV_CTRL > 0 && scenario.autopilot.EKF2_GPS_CTRL == 0 ? 1.0 : 0.0);
}

std::vector<BreakOff> break_off_loads() {
    std::vector<BreakOff> loads;
    for (const Wall& wall : kWalls) {
        const scenario::Scenario scenario = scenario::load_scenario(wall.scenario);
        for (const double pressure_Pa :
             {scenario.wall.surface.vacuum_pressure_Pa, scenario.guidance.land_pressure_Pa}) {
            loads.push_back(break_off(wall.surface, scenario, pressure_Pa));
        }
    }
    return loads;
}

std::vector<EnergyUse> energy_use(Evidence& evidence) {
    std::vector<EnergyUse> uses = {hovering({})};
    for (const Wall& wall : kWalls) {
        uses.push_back(perched(wall, {}));
    }
    evidence.set("energy.perched_share", uses[1].power_W / uses[0].power_W);
    return uses;
}

double turned_perched_share(const Turn& turn) {
    return perched(kWalls[0], turn).power_W / hovering(turn).power_W;
}

std::vector<scenario::Scenario> rig_scenarios() {
    return {scenario_with("hover", {"vehicle=perching_uav"}, {}),
            scenario_with(kWalls.front().scenario, {}, {}),
            scenario_with(kWalls.back().scenario, {}, {})};
}

ReleaseTime turned_release_time(const Turn& turn) {
    const Wall& metal = kWalls.back();
    return {.surface = metal.surface,
            .without_valve_s = release_s(metal, false, {}, turn),
            .with_valve_s = release_s(metal, true, {}, turn)};
}

std::vector<ReleaseTime> release_times(int jobs) {
    std::vector<ReleaseTime> times(kWalls.size());
    for_each_index(2 * kWalls.size(), jobs, [&](std::size_t i) {
        const Wall& wall = kWalls[i / 2];
        const bool valve = i % 2 == 1;
        times[i / 2].surface = wall.surface;
        (valve ? times[i / 2].with_valve_s : times[i / 2].without_valve_s) =
            release_s(wall, valve, {}, {});
    });
    return times;
}

double valve_spread_ratio(int flights, int jobs, const std::optional<Turn>& turn) {
    const std::size_t each = kWalls.size() * static_cast<std::size_t>(flights);
    std::array<std::vector<double>, 2> times{std::vector<double>(each), std::vector<double>(each)};
    for_each_index(2 * each, jobs, [&](std::size_t i) {
        const bool valve = i >= each;
        const std::size_t of = i % each;
        const Wall& wall = kWalls[of % kWalls.size()];
        const std::size_t k = of / kWalls.size();
        const suction::Surface surface = scenario::load_scenario(wall.scenario).wall.surface;
        // Evenly from one end of the tolerance to the other.
        const double within =
            flights < 2 ? 0.0 : 2.0 * static_cast<double>(k) / (flights - 1) - 1.0;
        const double tau_2_s =
            surface.unsealing_time_constant_s + within * surface.unsealing_time_tolerance_s;
        times[valve ? 1 : 0][of] =
            release_s(wall, valve,
                      {fmt::format("seed={}", k + 1),
                       fmt::format("wall.surface.unsealing_time_constant_s={:.6f}", tau_2_s)},
                      turn);
    });
    const auto spread_s = [](std::vector<double>& of) {
        std::sort(of.begin(), of.end());
        const auto at = [&](double share) {
            return of[static_cast<std::size_t>(share * static_cast<double>(of.size() - 1))];
        };
        return at(0.95) - at(0.05);
    };
    return spread_s(times[1]) / spread_s(times[0]);
}

}  // namespace limpet::paper
