// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "limpet/paper/claims.hpp"
#include "limpet/paper/paper_tables.hpp"

// The paper, line by line. A PaperStatement: id, section, what it says, its number or words, unit,
// name of the evidence, accepted range, note, figure, flight.

namespace limpet {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr Range kYes = {1.0, 1.0};

Quantity words(const char* text) {
    return std::string(text);
}

void add_vehicle(std::vector<PaperStatement>& all) {
    // clang-format off
    all.insert(all.end(), {
        {"equations-1-2", "II-A", "Free rigid-body motion obeys eqs. (1) and (2)",
         words("m x'' = R F, I w' + w x I w = M"), "", "free_body.relative_error", {0.0, 1e-3},
         "Largest relative error of a thrown, tumbling vehicle after one second, against "
         "gravity, conserved angular momentum and energy; the step's own error is of first "
         "order."},
        {"mass", "II-B", "Total mass", 3.2, "kg", "vehicle.mass_kg", {3.199, 3.201}},
        {"wheelbase", "II-B", "Diagonal wheelbase", 0.58, "m", "vehicle.wheelbase_m",
         {0.575, 0.585}, "Distance between opposite motors."},
        {"propeller", "II-B", "Propellers of type 1255: 12 in", 12.0, "in",
         "vehicle.propeller_diameter_in", {11.9, 12.1}},
        {"cells", "II-B", "Battery of 6 cells", 6.0, "cells", "vehicle.battery_cells", {6.0, 6.0}},
        {"capacity", "II-B", "Battery of 4000 mAh", 4.0, "Ah", "vehicle.battery_capacity_Ah",
         {4.0, 4.0}},
        {"joint", "II-B", "The joint of the cup has two degrees of freedom", 2.0, "freedoms",
         "vehicle.cup_joint_freedoms", {2.0, 2.0}, "Hinges between slider and cup."},
        {"slider", "II-B", "The slider extends the contact at the time of impact",
         words("extends the contact"), "times as long", "slider.contact_ratio", {1.5, kAny},
         "First contact of a failed perching over that with a slider of 20 kN/m.", "fig15",
         "failed_perch"},
        {"pump-place", "II-B", "The vacuum pump is at the back, for balance", words("at the back"),
         "m ahead of the centre of mass", "vehicle.pump_x_m", {-1.0, -0.05}},
        {"lidars", "II-B", "Two LiDARs, one on each front arm, parallel to b1",
         words("front arms"), "m ahead of the centre of mass", "vehicle.lidar_x_m", {0.1, 0.3}},
        {"cup-sensors", "II-B", "A pressure sensor in the cup and a force sensor in the mechanism",
         words("both"), "sensors recorded", "perch_concrete.cup_sensors", {2.0, 2.0}, "", "fig11",
         "perch_concrete"},
        {"legs", "II-B", "The legs limit the pitch when perched", words("legs limit the pitch"),
         "deg from where the legs stand", "perch_concrete.pitch_off_legs_deg", {0.0, 1.0},
         "Perched pitch against the angle at which both leg tips and the cup meet the wall.",
         "fig11", "perch_concrete"},
        {"motors", "II-B", "Brushless motors of type 3508-380KV", words("3508-380KV"), "", "", {},
         "Motors are a speed limit and a lag, both assumed (`vehicles/perching_uav.yaml`)."},
        {"cad", "II-B", "The model is made in SolidWorks and exported as URDF, then SDF",
         words("CAD model"), "", "", {},
         "Here one YAML file describes the vehicle; MJCF, SDF and URDF are generated from it."}});
    // clang-format on
}

void add_table_one(std::vector<PaperStatement>& all) {
    constexpr double kShare = 0.02;
    const std::string note =
        "From the simulation's own static thrust stand (eqs. (3), (4)) and cross wind; accepted "
        "within 2 % (assumed).";
    for (const TableOne& column : kTableOne) {
        const auto row = [&](const char* id, const char* what, const char* unit, const char* key,
                             double paper) {
            all.push_back({std::string(column.vehicle) + id,
                           "II-C, Table I",
                           std::string(what) + " of " + column.name,
                           paper,
                           unit,
                           std::string("rotor.") + column.vehicle + key,
                           {(1.0 - kShare) * paper, (1.0 + kShare) * paper},
                           note,
                           "fig-thrust"});
        };
        row("-k-mot", "Motor constant k_mot", "kg m", ".motor_constant_kg_m",
            column.motor_constant_kg_m);
        row("-k-mom", "Moment constant k_mom", "m", ".moment_constant_m", column.moment_constant_m);
        row("-lambda-1", "Drag constant lambda_1", "kg", ".drag_constant_kg",
            column.drag_constant_kg);
    }
}

void add_table_two(std::vector<PaperStatement>& all) {
    constexpr double kVacuum_hPa = 10.0;
    for (const TableTwo& column : kTableTwo) {
        const std::string key = column.scenario;
        const auto row = [&](const char* id, const char* what, const char* unit, const char* value,
                             double paper, double tolerance, const char* note) {
            all.push_back({id + key.substr(key.find('_')),
                           "II-D, Table II",
                           std::string(what) + " on " + column.name,
                           paper,
                           unit,
                           key + value,
                           {paper - tolerance, paper + tolerance},
                           note,
                           "fig2",
                           key});
        };
        row("vacuum", "Steady pressure P_vac", "hPa", ".vacuum_hPa", column.vacuum_hPa, kVacuum_hPa,
            "Accepted within 10 hPa: the paper gives no tolerance (assumed).");
        const char* own = "Accepted within the paper's own tolerance.";
        row("tau-1", "Sealing time constant tau_1", "s", ".tau_1_s", column.tau_1_s,
            column.tau_1_tolerance_s, own);
        row("tau-2", "Unsealing time constant tau_2", "s", ".tau_2_s", column.tau_2_s,
            column.tau_2_tolerance_s, own);
    }
}

void add_cup(std::vector<PaperStatement>& all) {
    // clang-format off
    all.insert(all.end(), {
        {"equations-5-6", "II-D", "Eqs. (5) and (6) approximate the measured pressure",
         words("can be approximated"), "hPa rms", "press.worst_residual_hPa", {0.0, 10.0},
         "Largest residual of the four fits; what is left is ripple and noise.", "fig2",
         "press_concrete"},
        {"slowest", "II-D, Fig. 2", "The pressure falls slowest on porous concrete",
         words("slowest on concrete"), "hPa/s less than the next", "press.slowest_margin_hPa_s",
         {0.0, kAny},
         "By the initial rate (P_atm - P_vac) / tau_1. By tau_1 alone the paper contradicts "
         "itself, see the next row.", "fig2", "press_concrete"},
        {"slowest-by-tau", "Table II",
         "The paper contradicts itself: by its own tau_1 the cinder block is slower than concrete",
         kTableTwo[1].tau_1_s - kTableTwo[0].tau_1_s, "s", "press.tau_1_cinder_less_concrete_s",
         {1e-4, 0.08},
         "Table II: 0.35 s against 0.33 s; the difference is within the tolerances of 0.03 s.",
         "fig2", "press_cinder_block"},
        {"weakest", "II-D, Fig. 2", "The vacuum reached is worst on concrete",
         words("lowest vacuum"), "hPa above the next", "press.weakest_margin_hPa", {0.0, kAny}, "",
         "fig2", "press_concrete"},
        {"needs-force", "II-D",
         "On rough and porous surfaces the cup must be pressed with enough force",
         words("enough force"), "of the failed trials pressed too little",
         "fig3.failed_for_force_share", {0.5, 1.0},
         "Trials whose press stayed below what their spot asks for; thresholds are assumed.",
         "fig3"},
        {"trials", "II-D, Fig. 3", "253 experiments with a pendulum of 5 m", 253.0, "trials",
         "fig3.runs", {253.0, 253.0}, "With --quick a share of them.", "fig3"},
        {"too-slow", "II-D, Fig. 3", "Below 0.4 m/s the impact does not apply enough force", 0.0,
         "share that attach", "fig3.success_below_0_4", {0.0, 0.05},
         "The thresholds' median is chosen so (facts.md section 4); their spread and that of the "
         "misalignment are assumed.",
         "fig3"},
        {"best-speed", "II-D, Fig. 3", "Best results between 1 and 1.2 m/s", words("best"),
         "more of the trials than the best three slower speeds", "fig3.best_margin", {0.0, 1.0},
         "Share that attaches at 1.0, 1.1 and 1.2 m/s less that of the best three neighbouring "
         "speeds below 1 m/s. Nothing faster was flown, as in the paper.",
         "fig3"},
        {"randomness", "II-D", "Roughness and misalignment make the success random",
         words("some of the randomness"), "speeds with mixed outcomes, less than without spread",
         "fig3.mixed_speeds_less", {1.0, kAny},
         "The same speeds flown with one threshold for all and no misalignment.", "fig3"},
        {"dangerous", "II-D", "Over 1.2 m/s the manoeuvre is deemed too dangerous",
         words("too dangerous"), "", "", {}, "A judgement, not a measurement."}});
    // clang-format on
}

void add_architecture(std::vector<PaperStatement>& all) {
    // clang-format off
    all.insert(all.end(), {
        {"px4", "II-E, Fig. 4", "A Pixhawk with PX4 and a Raspberry Pi fly the vehicle",
         words("PX4 on a Pixhawk"), "", "", {},
         "Here a built-in autopilot with PX4's cascade and parameter names."},
        {"mocap", "II-E", "Motion capture feeds position and orientation to the state estimator",
         words("OptiTrack to the EKF"), "yes/no", "estimator.motion_capture_only", kYes,
         "No other position is used in these flights.", "fig11", "perch_concrete"},
        {"offboard", "II-E", "Flown in offboard mode from a ROS script", words("offboard, ROS"), "",
         "", {}, "Guidance speaks to the autopilot by the same kinds of set-points, without ROS."},
        {"gazebo", "III-A, Fig. 5", "Gazebo 11, ROS and PX4 hardware in the loop",
         words("Gazebo 11, ROS, PX4"), "", "", {},
         "Here MuJoCo and one program; the loop has the same stations."},
        {"joint-made", "III-B, Fig. 6",
         "The joint is made when the impact force is above the sealing threshold",
         words("above the threshold"), "N between press and threshold",
         "perch_concrete.seal_margin_N", {0.0, kAny},
         "Largest press of the flight less the threshold drawn for its touch.", "fig11",
         "perch_concrete"},
        {"joint-waits", "III-B, Fig. 6",
         "and the contact lasts until the pressure is below the attachment threshold",
         words("for the time required"), "s from touch to 880 hPa",
         "perch_concrete.time_to_land_pressure_s", {0.137, 0.165},
         "Eq. (5) from 1013 to 880 hPa with tau_1 0.33 +- 0.03 s.", "fig11", "perch_concrete"},
        {"joint-not-made", "III-B, Fig. 6", "No joint without a sealing impact",
         words("called under certain conditions"), "hPa, lowest of the failed attempt",
         "failed_perch.first_lowest_pressure_hPa", {880.0, 1020.0}, "", "fig15", "failed_perch"}});
    // clang-format on
}

void add_method(std::vector<PaperStatement>& all) {
    // clang-format off
    all.insert(all.end(), {
        {"equation-7", "IV", "Eq. (7) gives the angle to the wall from two LiDARs",
         words("alpha = atan((d1 - d2) / l)"), "deg of error",
         "perch_concrete.wall_angle_error_deg", {0.0, 1.0},
         "Angle by the LiDARs against the true one when the approach begins.", "fig11",
         "perch_concrete"},
        {"lidar-rate", "IV", "The LiDARs run at a much higher rate than a depth camera",
         words("much higher"), "Hz", "vehicle.lidar_rate_Hz", {60.0, 1000.0},
         "Twice the 30 Hz of usual depth cameras or more (assumed)."},
        {"pilot", "IV", "The pilot verifies that the surface is flat and large enough",
         words("looks at the surface"), "", "", {}, "No pilot here; the wall is flat."},
        {"within-2-deg", "IV", "Perpendicular within 2 deg before it approaches", Range{0.0, 2.0},
         "deg", "perch_concrete.alignment_at_approach_deg", {0.0, 2.0}, "", "fig11",
         "perch_concrete"},
        {"constant-speed", "IV", "It flies to the wall at a preset constant speed",
         words("constant speed"), "m/s of change in the last 0.2 s",
         "perch_concrete.approach_speed_change_m_s", {0.0, 0.03}, "", "fig11", "perch_concrete"},
        {"hold", "IV", "After the impact it holds its position for 0.5 s", 0.5, "s",
         "perch_concrete.hold_s", {0.48, 0.53}, "Guidance runs at 50 Hz.", "fig11",
         "perch_concrete"},
        {"p-land", "IV", "The manoeuvre is successful below P_land = 880 hPa", Range{0.0, 880.0},
         "hPa", "perch_concrete.pressure_at_landing_hPa", {0.0, 880.0}, "", "fig11",
         "perch_concrete"},
        {"gradual", "IV, V-A", "Then it decreases its thrust gradually", words("gradually"),
         "s until it is perched", "perch_concrete.landing_s", {2.0, 60.0}, "", "fig11",
         "perch_concrete"},
        {"goes-back", "IV", "Otherwise it goes back to where it was before the attempt", 1.5, "m",
         "failed_perch.retreated_to_m", {1.45, 1.55}, "", "fig15", "failed_perch"},
        {"retries", "IV", "and will retry", words("will retry"), "s until the next approach",
         "failed_perch.second_attempt_after_s", {0.0, 30.0}, "", "fig15", "failed_perch"},
        {"lowers-pitch", "IV, Fig. 7", "Take-off: it lowers its pitch to 0 deg", 0.0, "deg",
         "perch_concrete.pump_off_pitch_deg", {0.0, 2.0}, "Pitch when the pump is turned off.",
         "fig12", "perch_concrete"},
        {"pump-off", "IV, Fig. 7", "Once horizontal and stabilised the pump is turned off",
         words("once horizontal"), "s after level", "perch_concrete.pump_off_after_level_s",
         {0.0, 0.1}, "", "fig12", "perch_concrete"},
        {"detaches", "IV, Fig. 7", "It detaches when the pressure is over the safe threshold",
         words("over the safe threshold"), "hPa", "perch_concrete.pressure_released_hPa",
         {880.0, 1014.0}, "The paper gives no number; 980 hPa is assumed (facts.md section 3).",
         "fig12", "perch_concrete"},
        {"moves-back", "IV, Fig. 7", "and moves back to the pre-perching location", 1.5, "m",
         "perch_concrete.back_at_m", {1.45, 1.55}, "", "fig12", "perch_concrete"}});
    // clang-format on
}

void add_concrete(std::vector<PaperStatement>& all) {
    // clang-format off
    all.insert(all.end(), {
        {"whole", "V, Figs. 9, 10", "Autonomous perching and take-off were achieved in simulation",
         words("achieved"), "yes/no", "perch_concrete.is_released", kYes, "", "fig9",
         "perch_concrete"},
        {"experiment", "V, Figs. 9 to 15", "and in experimental tests", words("achieved"), "", "",
         {}, "No real vehicle here."},
        {"accurate", "V, VI", "Comparisons show that the simulation is accurate",
         words("accurate"), "", "", {},
         "The paper prints curves, not data; its numbers in the text are the other rows."},
        {"d-pre", "V-A", "Positioned at 1.5 m from the wall", 1.5, "m",
         "perch_concrete.distance_before_approach_m", {1.43, 1.57},
         "As its LiDARs say when the approach begins.", "fig11", "perch_concrete"},
        {"fig11-start", "V-A, Fig. 11", "The simulated vehicle accelerates at 0.5 s", 0.5, "s",
         "fig11.approach_at_s", {0.49, 0.51}, "The figure's window begins so.", "fig11",
         "perch_concrete"},
        {"fig11-experiment", "V-A, Fig. 11",
         "The experiment accelerates at 2 s and closer to the wall, its approach is shorter",
         words("2 s"), "", "", {}, "Of the real flight alone."},
        {"spike-later", "V-A, Fig. 11", "The force spike comes a few seconds later",
         words("a few seconds"), "s after the approach began", "perch_concrete.spike_after_s",
         {1.0, 4.0}, "", "fig11", "perch_concrete"},
        {"spike", "V-A, Fig. 11", "Negative force spike at the impact", words("negative spike"), "N",
         "perch_concrete.spike_N", {-100.0, -20.0}, "", "fig11", "perch_concrete"},
        {"dips", "V-C, Figs. 11, 13", "immediately followed by a downward pitch", words("downward"),
         "deg", "perch_concrete.pitch_drop_deg", {-20.0, -0.5}, "Lowest pitch of the next 0.5 s.",
         "fig11", "perch_concrete"},
        {"impact-speed", "V-A, II-D", "It reaches the desired impact speed", Range{1.0, 1.2},
         "m/s", "perch_concrete.impact_speed_m_s", {1.0, 1.2}, "", "fig11", "perch_concrete"},
        {"attaches", "V-A, Fig. 11", "The pressure drops below 880 hPa", Range{0.0, 0.5},
         "s after the touch", "perch_concrete.time_to_land_pressure_s", {0.0, 0.5},
         "It has the 0.5 s of the hold for it.", "fig11", "perch_concrete"},
        {"pitches-up", "V-A, Fig. 11", "Then it increases its pitch to land on the wall",
         words("increases its pitch"), "deg", "perch_concrete.landing_pitch_rise_deg",
         {30.0, 90.0}, "", "fig11", "perch_concrete"},
        {"force-rises", "V-A, Fig. 11", "The force on the cup increases as lift drops",
         words("increases"), "N", "perch_concrete.landing_force_rise_N", {5.0, 100.0}, "", "fig11",
         "perch_concrete"},
        {"stabilises", "V-A, Fig. 11", "Thrust decreases until the pitch stabilises",
         words("stabilizes"), "deg of change at rest", "perch_concrete.perched_pitch_spread_deg",
         {0.0, 0.5}, "Over the last 5 s of the rest, motors off.", "fig11", "perch_concrete"},
        {"shut-down", "V-A, Fig. 11", "and the motors can be shut down", words("shut down"),
         "N of thrust left when perched", "perch_concrete.thrust_when_perched_N", {0.0, 3.0},
         "A tenth of the weight.", "fig11", "perch_concrete"},
        {"take-off-pressure", "V-A, Fig. 12",
         "Take-off begins with the pressure below the threshold", Range{0.0, 880.0}, "hPa",
         "perch_concrete.take_off_pressure_hPa", {0.0, 880.0}, "", "fig12", "perch_concrete"},
        {"throttle-up", "V-A, Fig. 12", "The motors turn on and the throttle increases",
         words("increases"), "N of thrust", "perch_concrete.take_off_thrust_rise_N", {10.0, 60.0},
         "", "fig12", "perch_concrete"},
        {"pitch-falls", "V-A, Fig. 12", "The pitch progressively decreases",
         words("progressively"), "of the fall is ever regained",
         "perch_concrete.take_off_pitch_setback", {0.0, 0.05}, "", "fig12", "perch_concrete"},
        {"force-falls", "V-A, Fig. 12", "which reduces the force on the mechanism",
         words("reduces"), "N", "perch_concrete.take_off_force_fall_N", {5.0, 100.0}, "", "fig12",
         "perch_concrete"},
        {"one-second", "V-A, Fig. 12", "On concrete the pressure builds up in about one second",
         1.0, "s from pump off to detached", "perch_concrete.release_s", {0.8, 1.4},
         "About one second: 0.8 to 1.4 s (facts.md section 7).", "fig12", "perch_concrete"},
        {"stays-level", "V-A, Fig. 12", "In simulation the pitch remains stable meanwhile",
         words("remains stable"), "deg at most", "perch_concrete.pitch_oscillation_max_deg",
         {0.0, 1.0}, "Stable: within 1 deg.", "fig12", "perch_concrete"},
        {"real-swings", "V-A, Fig. 12", "The pitch of the real vehicle oscillates meanwhile",
         words("oscillates"), "times the swing with Gazebo's motors", "swing.concrete_ratio",
         {1.5, kAny},
         "Median over missions of half the span of the pitch while waiting on concrete, slow motors "
         "and unsteady air at the wall over Gazebo's motors in still air. A candidate.",
         "fig12-slow", "slow_concrete"}});
    // clang-format on
}

void add_metal(std::vector<PaperStatement>& all) {
    // clang-format off
    all.insert(all.end(), {
        {"metal-perches", "V-B, Fig. 13", "The same manoeuvre perches on metal", words("perches"),
         "deg of pitch at rest", "perch_metal.perched_pitch_deg", {60.0, 75.0}, "", "fig13",
         "perch_metal"},
        {"metal-vacuum", "V-B, Fig. 13", "On metal the pressure drops as low as 275 hPa", 275.0,
         "hPa", "perch_metal.pressure_lowest_hPa", {265.0, 285.0}, "Accepted within 10 hPa.",
         "fig13", "perch_metal"},
        {"concrete-ripple", "V-B, Fig. 11", "The pump's fluctuations are visible on concrete",
         words("visible"), "hPa peak to peak", "perch_concrete.rest_ripple_hPa", {4.0, 100.0},
         "Visible: above the sensor's noise. Amplitude assumed.", "fig11", "perch_concrete"},
        {"pump-rests", "V-B, Fig. 13", "On metal the pump can turn off", words("can turn off"),
         "of the rest the pump runs", "perch_metal.rest_pump_share", {0.0, 0.95},
         "It comes and goes: it stops near its best vacuum and starts 20 hPa above (assumed).",
         "fig13", "perch_metal"},
        {"metal-ripple", "V-B, Fig. 13",
         "Pressure fluctuations from the pump are no longer visible on metal, the vacuum is kept",
         Range{0.0, 4.0}, "hPa peak to peak", "perch_metal.rest_ripple_hPa", {0.0, 4.0},
         "By its own tau_2 of 16 s a cup at 275 hPa gains 46 hPa a second once the pump rests, "
         "so that a pump that turns off shows as a saw-tooth. Not visible: below the sensor's "
         "noise.", "fig13", "perch_metal"},
        {"still-there", "V-B, Fig. 14", "On metal the pressure increases very slowly",
         words("very slowly"), "hPa after 16 s", "perch_metal.pressure_at_release_end_hPa",
         {730.0, 755.0}, "Eq. (6) with Table II gives 742 hPa.", "fig14", "perch_metal"},
        {"waits-long", "V-B, Fig. 14", "The vehicle waits for 16 s", 16.0, "s",
         "perch_metal.waited_s", {15.9, 16.1}, "The paper gave up because of the swing, ours by "
         "this limit.", "fig14", "perch_metal"},
        {"interrupted", "V-B, Fig. 14", "The detachment is interrupted", words("interrupted"),
         "yes/no", "perch_metal.is_release_aborted", kYes, "It lands on the wall again.", "fig14",
         "perch_metal"},
        {"five-degrees", "V-B, Fig. 14",
         "The pitch oscillations of the real vehicle exceed 5 deg after 16 s", words("> 5 deg"),
         "deg, median of the missions", "swing.metal_median_deg", {5.0, 45.0},
         "Candidate: motors of 65 ms behind 16 ms, and 0.03 N m of unsteady air at the wall; the "
         "limit of 10 deg lifted.",
         "fig-swing", "slow_metal"},
        {"grow-larger", "V-B, Fig. 14", "On metal they last longer and their amplitudes grow larger",
         words("grow larger"), "times that on concrete", "swing.metal_over_concrete", {2.0, kAny},
         "Medians of the same missions.", "fig-swing", "slow_metal"},
        {"simulation-flat", "V-B, Fig. 14", "The simulation does not predict these oscillations",
         words("does not predict"), "deg, 95th percentile", "swing.gazebo_metal_p95_deg",
         {0.0, 1.0}, "Gazebo's motors, still air: stays within 1 deg.", "fig-swing", "perch_metal"},
        {"aerodynamic", "V-B",
         "Most likely aerodynamic effects that are not well captured cause them",
         words("> 5 deg"), "deg, median of the missions", "swing.gazebo_air_metal_median_deg",
         {5.0, 45.0},
         "Gazebo's motors with the published steady air at a wall and 0.1 N m of unsteady moment, "
         "the most that facts.md section 5 allows: they push the pitch about, but it does not "
         "grow.",
         "fig-swing"},
        {"tuning", "V-B", "Tuning the controller could alleviate the issue", words("could"),
         "1/s, growth with rate P 0.20", "swing.rate_p_growth_1_s", {-10.0, 0.0},
         "Slow motors; with the default gains it grows.", "fig-cures"},
        {"valve", "V-B", "A solenoid valve breaks the vacuum instantly", words("instantly"),
         "s from pump off to detached", "perch_metal_valve.release_s", {0.0, 0.5},
         "Orifice of 2 mm (assumed).", "fig-valve", "perch_metal_valve"},
        {"quicker", "V-B", "The detachment would be quicker and much more predictable",
         words("quicker"), "times quicker on metal", "release.valve_gain_metal", {10.0, kAny},
         "Without a valve it depends on the surface, with it hardly.",
         "fig-valve", "perch_metal_valve"}});
    // clang-format on
}

void add_failure(std::vector<PaperStatement>& all) {
    // clang-format off
    all.insert(all.end(), {
        {"failed-spike", "V-C, Fig. 15", "Failed perching: a peak of force", words("peak"), "N",
         "failed_perch.first_spike_N", {-100.0, -20.0}, "", "fig15", "failed_perch"},
        {"failed-pitch", "V-C, Fig. 15", "immediately followed by a downward pitch",
         words("downward"), "deg", "failed_perch.first_pitch_drop_deg", {-20.0, -0.5}, "", "fig15",
         "failed_perch"},
        {"no-drop", "V-C, Fig. 15", "The pressure does not drop, there is no proper seal",
         Range{880.0, 1020.0}, "hPa", "failed_perch.first_lowest_pressure_hPa", {880.0, 1020.0},
         "", "fig15", "failed_perch"},
        {"after-half", "V-C, Fig. 15", "After 0.5 s the failed attempt is detected", 0.5, "s",
         "failed_perch.first_hold_s", {0.48, 0.53}, "", "fig15", "failed_perch"},
        {"second-attempt", "V-C", "It moves back and tries again", words("a new attempt"),
         "attempts", "failed_perch.attempts", {2.0, 10.0}, "The second one attaches.", "fig15",
         "failed_perch"},
        {"energy", "I", "Turning off the motors significantly reduces the energy consumption",
         words("significantly"), "of the power of hovering", "energy.perched_share", {0.0, 0.2},
         "Perched on concrete with the pump running, avionics included; a fifth counts as "
         "significant (assumed).",
         "fig-energy"}});
    // clang-format on
}

/// Rows that the method makes true, whatever happens around it: its own limits and orders.
constexpr std::array<std::string_view, 7> kByTheMethod = {
    "hold", "p-land", "pump-off", "detaches", "waits-long", "interrupted", "after-half"};

std::string basis_of(const PaperStatement& statement) {
    const auto begins = [&](std::string_view part) {
        return statement.evidence.compare(0, part.size(), part) == 0;
    };
    if (statement.evidence.empty()) {
        return "";
    }
    if (begins("vehicle.") || begins("estimator.")) {
        return "as set";
    }
    if (begins("rotor.") || begins("press")) {
        return "recovered";
    }
    return std::find(kByTheMethod.begin(), kByTheMethod.end(), statement.id) != kByTheMethod.end()
               ? "by the method"
               : "measured";
}

}  // namespace

const std::vector<PaperStatement>& statements() {
    static const std::vector<PaperStatement> all = [] {
        std::vector<PaperStatement> list;
        add_vehicle(list);
        add_table_one(list);
        add_table_two(list);
        add_cup(list);
        add_architecture(list);
        add_method(list);
        add_concrete(list);
        add_metal(list);
        add_failure(list);
        for (PaperStatement& statement : list) {
            statement.basis = basis_of(statement);
        }
        return list;
    }();
    return all;
}

}  // namespace limpet
