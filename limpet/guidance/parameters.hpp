// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"
#include "limpet/core/parameters.hpp"

namespace limpet::guidance {

/// How to perch and how to take off. Distances to the wall are those of the LiDARs unless said
/// otherwise. Sources: the paper, section IV; baseline.md for what the paper does not say.
struct PerchingParameters {
    // the vehicle, as guidance knows it
    double lidar_separation_m = 0.41;  ///< l of eq. (7)
    double lidar_x_m = 0.205;          ///< LiDARs ahead of the centre of mass
    double joint_x_m = 0.46;           ///< cup joint ahead of the centre of mass
    double joint_z_m = 0.0;            ///< and below it
    double hover_thrust = 0.657;       ///< motor command that carries the weight
    double zero_thrust = -1.0 / 7.0;   ///< motor command at which the rotors would stand still
    bool valve_fitted = false;         ///< the cup has a solenoid valve
    // pre-position
    double pre_distance_m = 1.5;
    double pre_tolerance_m = 0.05;
    double pre_speed_m_s = 0.1;  ///< slower than this counts as there
    double align_limit_deg = 2.0;
    double settle_s = 0.5;           ///< how long a condition must hold to count
    double wall_filter_s = 0.3;      ///< low-pass of the wall seen by the LiDARs
    double wall_near_limit_m = 6.0;  ///< no wall nearer than this: not in front of one
    // dock
    double dock_speed_m_s = 1.1;
    double dock_acceleration_m_s2 = 1.5;
    double dock_ramp_s = 0.2;     ///< of that acceleration
    double drag_1_s = 0.56;       ///< rotor drag per speed and mass, fed forward
    double line_gain_1_s = 0.95;  ///< keeps the line across the docking direction
    double impact_force_N = 8.0;  ///< pressed harder than this: the wall is hit
    double approach_limit_s = 15.0;
    // hold
    double hold_s = 0.5;
    double hold_depth_m = 0.10;         ///< position set-point inside the wall
    double land_pressure_Pa = 88000.0;  ///< P_land
    // land
    double perched_pitch_deg = 66.5;  ///< where the legs stand on the wall
    double pitch_over_travel_deg = 1.1;
    double land_pitch_s = 5.0;
    double land_thrust_s = 1.0;
    double rest_rate_deg_s = 3.0;  ///< slower than this counts as resting
    double land_limit_s = 15.0;
    double rest_s = 7.0;  ///< on the wall, motors off
    // take-off
    double spin_up_s = 1.0;
    double level_pitch_s = 6.0;
    double level_limit_deg = 2.0;
    double level_rate_deg_s = 5.0;
    double level_limit_s = 15.0;
    double detach_pressure_Pa = 98000.0;
    double release_limit_s = 16.0;  ///< then the release is given up
    double oscillation_limit_deg = 10.0;
    bool altitude_hold = false;        ///< thrust keeps the height while level on the cup
    double altitude_gain_1_s = 1.0;    ///< climb rate asked per error of height
    double climb_rate_gain_1_s = 4.0;  ///< acceleration asked per error of that rate
    double reseal_limit_s = 3.0;
    // wind
    double lean_limit_deg = 25.0;      ///< leans farther against the wind: no docking run
    double calm_lean_deg = 1.5;        ///< leans less: counts as calm
    double side_gain_1_s = 3.0;        ///< on the cup: speed asked per error of the side
    double sway_gain_1_s = 8.0;        ///< acceleration asked per error of that speed
    double side_integral_1_s3 = 10.0;  ///< and per error of the side, a second
    // retreat
    double retreat_speed_m_s = 0.6;
    double retreat_acceleration_m_s2 = 1.0;
    double retreat_limit_s = 12.0;
    // faults
    int attempts = 3;
    double sensor_limit_s = 0.25;   ///< a reading older than this is lost
    double wait_limit_s = 20.0;     ///< for pre-position and alignment
    double slip_limit_m = 0.12;     ///< the joint this far from where it gripped: came off
    double debounce_s = 0.1;        ///< a weak vacuum counts when it lasts
    double stuck_s = 1.0;           ///< a pressure that does not move for so long after pump off
    double battery_reserve = 0.15;  ///< no new attempt below this charge
};

[[nodiscard]] const ParameterTable<PerchingParameters>& perching_table();

}  // namespace limpet::guidance
