// SPDX-License-Identifier: Apache-2.0
#include "limpet/companion/parameters.hpp"

#include "limpet/companion/config.hpp"

namespace limpet::companion {

const ParameterTable<CompanionLimits>& companion_limits_table() {
    using P = CompanionLimits;
    static const ParameterTable<P> table = {
        {"guidance_rate_Hz", "Hz", 10.0, 200.0, &P::guidance_rate_Hz, "guidance and set-points",
         "px4.md \"Offboard\": 20 to 50 Hz; as in the simulation"},
        {"poll_rate_Hz", "Hz", 50.0, 1000.0, &P::poll_rate_Hz, "how often the wires are looked at",
         "assumed: stamps readings to 2 ms"},
        {"pose_rate_Hz", "Hz", 10.0, 200.0, &P::pose_rate_Hz,
         "maximum rate of poses to the autopilot", "px4.md \"Motion capture\": 50 Hz was enough"},
        {"pose_limit_s", "s", 0.05, 5.0, &P::pose_limit_s,
         "a motion-capture pose older than this is stale", "assumed: 0.28 m at docking speed"},
        {"estimate_limit_s", "s", 0.05, 5.0, &P::estimate_limit_s, "the autopilot's pose likewise",
         "assumed: as guidance.sensor_limit_s"},
        {"silence_limit_s", "s", 1.5, 30.0, &P::silence_limit_s,
         "autopilot without a heartbeat: silent", "assumed: three of PX4's, at 1 Hz"},
        {"late_limit_s", "s", 0.05, 0.9, &P::late_limit_s,
         "a tick of guidance later than this hands control back",
         "px4.md \"Offboard\": offboard is lost after 1 s"},
        {"arming_s", "s", 0.5, 10.0, &P::arming_s,
         "after it a heartbeat must show that it is armed", "assumed: two of PX4's, at 1 Hz"},
        {"agreement_m", "m", 0.01, 10.0, &P::agreement_m,
         "motion capture and the autopilot's pose may differ by this before it begins",
         "assumed: wrong axes differ by more"},
        {"agreement_deg", "deg", 1.0, 180.0, &P::agreement_deg, "and by this in attitude",
         "assumed: wrong axes differ by more"},
        {"stand_speed_m_s", "m/s", 0.05, 5.0, &P::stand_speed_m_s,
         "faster than this by its own account, with motors off, it is not ready",
         "assumed: a vehicle that stands is estimated to within 0.05 m/s"},
        {"pose_jump_m", "m", 0.05, 10.0, [](P& p) -> double& { return p.pose_watch.jump_m; },
         "a pose that is so far from where the autopilot's velocity takes it jumped",
         "assumed: ten times what 0.02 s of delay make at docking speed"},
        {"pose_still_m", "m", 0.01, 10.0, [](P& p) -> double& { return p.pose_watch.still_m; },
         "so far a pose may move while motors are off and the gyros are still",
         "assumed: ten times a tracker's noise and drift"},
        {"still_rate_rad_s", "rad/s", 0.005, 1.0,
         [](P& p) -> double& { return p.pose_watch.still_rad_s; },
         "gyros below this for a second are still",
         "assumed: ten times their noise, a fifth of what a hand does"},
        {"wait_limit_s", "s", 1.0, 3600.0, &P::wait_limit_s, "longest wait for the inputs",
         "assumed"},
        {"operator_limit_s", "s", 1.0, 7200.0, &P::operator_limit_s,
         "longest wait for OFFBOARD, armed, in the air", "assumed: a battery's flight"},
        {"rise_m", "m", 0.0, 5.0, &P::rise_m,
         "with asks_for_mode: height above its stand at which the mission begins",
         "assumed: the simulator's stand"},
        {"begin_tolerance_m", "m", 0.01, 2.0, &P::begin_tolerance_m,
         "with asks_for_mode: as near to that", "assumed: as the simulator's bring-up"},
        {"begin_speed_m_s", "m/s", 0.01, 1.0, &P::begin_speed_m_s,
         "with asks_for_mode: slower than this", "assumed: as the simulator's bring-up"},
        {"begin_steady_s", "s", 0.0, 30.0, &P::begin_steady_s, "with asks_for_mode: for so long",
         "assumed: as the simulator's bring-up"},
        {"hand_back_s", "s", 0.5, 30.0, &P::hand_back_s,
         "how long the end is reported and hold requested", "assumed: two heartbeats of PX4"},
        {"mechanism_rate_Hz", "Hz", 1.0, 100.0, &P::mechanism_rate_Hz,
         "rate of commands to pump and valve", "mechanism_line.hpp"},
        {"hover_s", "s", 1.0, 3600.0, &P::hover_s, "of mission hover", "as simulation.hover_s"},
    };
    return table;
}

const ParameterTable<CompanionConfig>& motion_capture_table() {
    using P = CompanionConfig;
    static const ParameterTable<P> table = {
        {"rigid_body", "count", 1.0, 65535.0, &P::rigid_body,
         "streaming id of the vehicle in Motive", "Motive: rigid bodies count from 1"},
        {"x_axis_yaw_deg", "deg", -180.0, 180.0,
         [](P& p) -> double& { return p.axes.x_axis_yaw_deg; },
         "where Motive's x axis points: 0 north, 90 east; north may be chosen",
         "assumed: north is where it points"},
        {"origin_x_m", "m", -1000.0, 1000.0, [](P& p) -> double& { return p.axes.p_WM_m.x(); },
         "Motive's origin north of ours", "assumed: the same"},
        {"origin_y_m", "m", -1000.0, 1000.0, [](P& p) -> double& { return p.axes.p_WM_m.y(); },
         "east of ours", "assumed: the same"},
        {"origin_z_m", "m", -1000.0, 1000.0, [](P& p) -> double& { return p.axes.p_WM_m.z(); },
         "below ours", "assumed: the same"},
        {"nose_yaw_deg", "deg", -180.0, 180.0, [](P& p) -> double& { return p.axes.nose_yaw_deg; },
         "nose, clockwise from the rigid body's x axis",
         "assumed: made with the nose along Motive's x"},
        {"pivot_x_m", "m", -2.0, 2.0, [](P& p) -> double& { return p.axes.p_BP_m.x(); },
         "rigid body's pivot ahead of the centre of mass", "assumed: moved there in Motive"},
        {"pivot_y_m", "m", -2.0, 2.0, [](P& p) -> double& { return p.axes.p_BP_m.y(); },
         "right of it", "assumed: moved there in Motive"},
        {"pivot_z_m", "m", -2.0, 2.0, [](P& p) -> double& { return p.axes.p_BP_m.z(); }, "below it",
         "assumed: moved there in Motive"},
    };
    return table;
}

const ParameterTable<CompanionConfig>& autopilot_wire_table() {
    static const ParameterTable<CompanionConfig> table = {
        {"system", "count", 1.0, 255.0, &CompanionConfig::system, "the autopilot's MAVLink system",
         "PX4: MAV_SYS_ID"},
    };
    return table;
}

const ParameterTable<CompanionConfig>& loop_table() {
    static const ParameterTable<CompanionConfig> table = {
        {"real_time_priority", "-", 0.0, 49.0, &CompanionConfig::real_time_priority,
         "SCHED_FIFO and locked memory for the loop; 0 requests neither",
         "assumed: above all ordinary work, below the kernel's interrupt threads (50)"},
    };
    return table;
}

std::vector<scenario::Section> companion_sections(CompanionConfig& config) {
    return {{"companion.limits", bind(companion_limits_table(), config.limits)},
            {"companion.motion_capture", bind(motion_capture_table(), config)},
            {"companion.autopilot", bind(autopilot_wire_table(), config)},
            {"companion.loop", bind(loop_table(), config)}};
}

}  // namespace limpet::companion
