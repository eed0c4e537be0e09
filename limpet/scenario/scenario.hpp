// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/autopilot/autopilots.hpp"
#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/atmosphere.hpp"
#include "limpet/core/enum_names.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/random.hpp"
#include "limpet/core/wall.hpp"
#include "limpet/faults/fault.hpp"
#include "limpet/guidance/parameters.hpp"
#include "limpet/models/model_writer.hpp"
#include "limpet/plant/engines.hpp"
#include "limpet/scenario/surface.hpp"
#include "limpet/sensors/registry.hpp"
#include "limpet/suction/condition.hpp"
#include "limpet/suction/cup.hpp"
#include "limpet/vehicle/airframe.hpp"
#include "limpet/vehicle/mount.hpp"
#include "limpet/vehicle/nearness.hpp"
#include "limpet/vehicle/swell.hpp"
#include "limpet/vehicle/wall_aerodynamics.hpp"
#include "limpet/vehicle/wind.hpp"

namespace limpet::scenario {

enum class Mission {
    hover,               ///< stay where it starts
    perch,               ///< perch and rest
    perch_and_take_off,  ///< perch, rest, take off, back to the pre-position
};
[[nodiscard]] inline std::string_view to_string(Mission mission) {
    return name_of(mission);
}

/// What the flight is set up with besides the modules' own parameters.
struct SimulationParameters {
    double time_limit_s = 120.0;     ///< then the outcome is timed_out
    double hover_s = 20.0;           ///< of mission hover
    double start_distance_m = 2.2;   ///< from the wall to the centre of mass
    double start_offset_m = 0.10;    ///< sideways, east of a wall to the north
    double start_yaw_deg = 6.0;      ///< off the wall's normal
    double start_height_m = 1.5;     ///< above the ground
    double contact_range_m = 0.25;   ///< legs closer to wall or ground: engine contacts on
    double touch_range_m = 0.02;     ///< lip closer than this and closing: sub-steps on
    double touch_transient_s = 0.3;  ///< sub-steps for so long after a touch or a release
    double step_s = 1e-3;            ///< plant step in free flight and while hanging
    double longest_step_s = 4e-3;    ///< plant step where nothing meets anything and nobody looks
    double touch_step_s = 2.5e-4;    ///< plant step around a touch
    int record_rate_Hz = 100;        ///< of true states; sensors are recorded as they come
    int guidance_rate_Hz = 50;
};
[[nodiscard]] const ParameterTable<SimulationParameters>& simulation_table();

/// The wall: where, which way, of what.
struct WallSetup {
    bool present = false;      ///< `wall: none`, or no such key: there is none
    double heading_deg = 0.0;  ///< direction of travel into the wall, from north, clockwise
    double lean_deg = 0.0;     ///< > 0: the top leans away from the vehicle
    double width_m = 4.0;
    double height_m = 4.0;
    double radius_m = 5.0;                                            ///< of a shape that bends
    double compliance_m_N = 0.0;                                      ///< of a spot; 0: rigid
    const suction::SurfaceCondition* condition = &suction::kAsGiven;  ///< of all of it
    WallGeometry geometry;  ///< made of the above, see lay_out(); and the shape
    Surface surface;
    /// Surface met by the first, second, ... touch; `surface` after those.
    std::vector<Surface> first_touches;
};

[[nodiscard]] const ParameterTable<WallSetup>& wall_table();

/// The air around the vehicle, and the sea below; at sea level, still and without a wall's effect
/// by default.
struct Environment {
    AirParameters air;
    vehicle::WindParameters wind;
    vehicle::WallAirParameters wall_air;
    vehicle::NearnessParameters nearness;
    vehicle::SwellParameters swell;
};

/// Where the vehicle is when the flight begins.
struct Start {
    Vector3 p_WB_m = Vector3::Zero();
    double yaw_rad = 0.0;
    double pitch_rad = 0.0;     ///< 0 unless a pendulum hangs askew
    double ground_z_W_m = 1.5;  ///< W's z of the floor, down positive
};

/// One experiment, checked and immutable; nothing downstream reads YAML.
struct Scenario {
    std::string name;
    std::string description;
    std::filesystem::path path;
    std::uint64_t seed = 1;
    NoiseBlend noise;  ///< in the seed's place; empty: the seed alone
    Mission mission = Mission::perch_and_take_off;
    vehicle::Airframe airframe;
    /// Keys of the vehicle that its file leaves to the paper's: "rotors", "slider.damping_N_s_m",
    /// ...
    std::vector<std::string> inherited;
    WallSetup wall;
    Start start;
    vehicle::Mount mount = vehicle::Mount::free;  ///< on another one the mission does not matter
    vehicle::PendulumParameters pendulum;
    vehicle::PressRigParameters press_rig;
    Environment environment;
    std::vector<faults::Fault> faults;  ///< at most faults::kMostFaults
    suction::CupParameters cup;
    sensors::SensorParameters sensors;
    autopilot::AutopilotParameters autopilot;
    const autopilot::AutopilotKind* autopilot_kind =
        &autopilot::kCascade;  ///< that flies with them
    /// Where its position comes from; sets parameters of `autopilot` that no key sets.
    const autopilot::PositionSource* aiding = &autopilot::kMotionCaptureAiding;
    guidance::PerchingParameters guidance;
    SimulationParameters simulation;
    const plant::Engine* engine = &plant::kReducedEngine;  ///< that moves the bodies
};

/// @return unit vector of travel into the wall, level
[[nodiscard]] Vector3 heading_W(const WallSetup& wall);
/// @return q_WB
[[nodiscard]] Quaternion attitude(const Start& start);
/// Where the vehicle's lip meets the wall on the line of travel, in the attitude of its start.
[[nodiscard]] Vector3 touching_p_WB_m(const Scenario& scenario);

/// Fills `wall.geometry` and `start` from the numbers of `wall`, `simulation` and the mount's. W's
/// origin is where a free vehicle would start without the sideways offset; the wall's is
/// start_distance_m ahead of it along the heading, at the same height. On a mount the vehicle
/// starts on that line: pulled back on its ropes, or start_gap_m before the wall.
void lay_out(Scenario& scenario);

/// @return "[[1, 0.6], [2, 0.8]]", as YAML reads it back to the same bits
[[nodiscard]] std::string noise_text(const NoiseBlend& noise);

/// A scenario as YAML that stands for itself: vehicle and surfaces are spelled out, so that it
/// flies the same when their files have changed. Loading it gives the same numbers, bit by bit.
/// What derive() works out is left out, so that changing the mass of a replay changes its hover
/// thrust.
[[nodiscard]] std::string to_yaml(const Scenario& scenario);

/// Wall and ground as the writers of models take them.
[[nodiscard]] models::Scene scene_of(const Scenario& scenario);

}  // namespace limpet::scenario
