// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"
#include "limpet/core/parameters.hpp"

namespace limpet::guidance {

/// How to perch and how to take off. Distances to the wall are those of the LiDARs unless stated
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
    double patience_s = 4.0;  ///< standing there in gusts: after so long larger errors are accepted
    double patience_back_s = 2.0;  ///< likewise on the way back in wind, when nothing follows
    double lean_error_s2 = 0.05;   ///< error of the position per acceleration leaned against
    double near_share = 0.5;       ///< of pre_distance_m: nearer counts as at the wall
    // dock
    double dock_speed_m_s = 1.1;
    double dock_acceleration_m_s2 = 1.5;
    double dock_ramp_s = 0.2;          ///< of that acceleration
    double drag_1_s = 0.56;            ///< rotor drag per speed and mass, fed forward
    double line_gain_1_s = 0.95;       ///< keeps the line across the docking direction
    double impact_force_N = 8.0;       ///< pressed harder than this: the wall is hit
    double grip_force_share = 0.5;     ///< of it: more than this, either way, and the cup holds
    double caught_speed_share = 0.25;  ///< of dock_speed_m_s: slower, the wall has stopped it
    double approach_limit_s = 15.0;
    // hold
    double hold_s = 0.5;
    double hold_depth_m = 0.10;         ///< position set-point inside the wall
    double aside_limit_m = 0.03;        ///< farther aside it is brought back while it presses
    double land_pressure_Pa = 88000.0;  ///< P_land
    // land
    double perched_pitch_deg = 66.5;  ///< where the legs stand on the wall
    double pitch_over_travel_deg = 1.1;
    double land_pitch_s = 5.0;
    double land_thrust_s = 1.0;
    double rest_rate_deg_s = 3.0;  ///< slower than this counts as resting
    double land_limit_s = 15.0;
    double rest_s = 7.0;             ///< on the wall, motors off
    double still_s = 3.0;            ///< the attitude must have stood before take-off
    double still_limit_s = 30.0;     ///< and is no longer waited for
    double moved_limit_deg = 0.3;    ///< an attitude that turned by more has moved
    double turned_limit_deg = 25.0;  ///< heading off the wall's by more: no take-off
    // take-off
    double spin_up_s = 1.0;
    double level_pitch_s = 6.0;
    double level_limit_deg = 2.0;
    double level_rate_deg_s = 5.0;
    double level_limit_s = 15.0;
    double patience_level_s = 1.5;  ///< in wind: after so long larger errors are accepted
    double detach_pressure_Pa = 98000.0;
    double release_limit_s = 16.0;  ///< then the release is given up
    double oscillation_limit_deg = 10.0;
    bool altitude_hold = false;        ///< thrust keeps the height while level on the cup
    double altitude_gain_1_s = 1.0;    ///< climb rate commanded per error of height
    double climb_rate_gain_1_s = 4.0;  ///< acceleration commanded per error of that rate
    double hang_pitch_deg = 20.0;      ///< pitched farther, a cup that holds feels a force
    double reseal_limit_s = 3.0;
    // wind
    double lean_limit_deg = 25.0;     ///< leans farther against the wind: no docking run
    double lean_across_share = 0.66;  ///< of that across the docking direction
    double wind_filter_s = 1.0;       ///< time constant of the wind as it is learnt before the wall
    double calm_lean_deg = 1.5;       ///< leans less: counts as calm
    double side_gain_1_s = 3.0;       ///< on the cup: speed commanded per error of the side
    double sway_gain_1_s = 8.0;       ///< acceleration commanded per error of that speed
    double side_integral_1_s3 = 10.0;  ///< and per error of the side, a second
    double side_limit_m_s2 = 3.0;      ///< of that integral
    double roll_limit = 0.6;           ///< largest sideways share of the thrust on the cup
    double roll_fade_deg = 10.0;       ///< so far from perched_pitch_deg it begins to roll less
    // retreat
    double retreat_speed_m_s = 0.6;
    double retreat_acceleration_m_s2 = 1.0;
    double retreat_limit_s = 12.0;
    double brake_gain_1_s = 2.0;           ///< without a position: acceleration per speed
    double brake_acceleration_m_s2 = 4.0;  ///< at most
    // faults
    int attempts = 3;
    double sensor_limit_s = 0.25;    ///< a reading older than this is lost
    double wait_limit_s = 20.0;      ///< for pre-position and alignment
    double slip_limit_m = 0.12;      ///< the joint this far from where it gripped: came off
    double debounce_s = 0.1;         ///< a weak vacuum counts when it lasts
    double stuck_s = 1.0;            ///< a pressure that does not move for so long after pump off
    double stuck_pressure_Pa = 1.0;  ///< by less than this
    double battery_reserve = 0.15;   ///< no new attempt below this charge
};

[[nodiscard]] const ParameterTable<PerchingParameters>& perching_table();

}  // namespace limpet::guidance
