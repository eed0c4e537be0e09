// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// The wire as others have it, nothing computed here. Source: MAVLink common.xml, by way of the
/// reference's mavlink_messages.txt; PARAM_REQUEST_LIST, NAMED_VALUE_FLOAT, AUTOPILOT_VERSION,
/// SETUP_SIGNING and MISSION_* by way of npm's
/// mavlink-mappings 1.0.21.
namespace limpet::mavlink {

struct TableRow {
    std::uint32_t id;
    std::string_view name;
    std::uint8_t crc_extra;
    std::size_t bytes_without_extensions;
    std::size_t payload_bytes;
    std::string_view offsets;  ///< "name@offset ...", by offset
};

inline constexpr std::array<TableRow, 40> kTable = {{
    {0, "HEARTBEAT", 50, 9, 9,
     "custom_mode@0 type@4 autopilot@5 base_mode@6 system_status@7 mavlink_version@8"},
    {1, "SYS_STATUS", 124, 31, 43,
     "onboard_control_sensors_present@0 onboard_control_sensors_enabled@4 "
     "onboard_control_sensors_health@8 load@12 voltage_battery@14 current_battery@16 "
     "drop_rate_comm@18 errors_comm@20 errors_count1@22 errors_count2@24 errors_count3@26 "
     "errors_count4@28 battery_remaining@30 onboard_control_sensors_present_extended@31 "
     "onboard_control_sensors_enabled_extended@35 onboard_control_sensors_health_extended@39"},
    {2, "SYSTEM_TIME", 137, 12, 12, "time_unix_usec@0 time_boot_ms@8"},
    {4, "PING", 237, 14, 14, "time_usec@0 seq@8 target_system@12 target_component@13"},
    {20, "PARAM_REQUEST_READ", 214, 20, 20,
     "param_index@0 target_system@2 target_component@3 param_id@4"},
    {21, "PARAM_REQUEST_LIST", 159, 2, 2, "target_system@0 target_component@1"},
    {22, "PARAM_VALUE", 220, 25, 25,
     "param_value@0 param_count@4 param_index@6 param_id@8 param_type@24"},
    {23, "PARAM_SET", 168, 23, 23,
     "param_value@0 target_system@4 target_component@5 param_id@6 param_type@22"},
    {30, "ATTITUDE", 39, 28, 28,
     "time_boot_ms@0 roll@4 pitch@8 yaw@12 rollspeed@16 pitchspeed@20 yawspeed@24"},
    {31, "ATTITUDE_QUATERNION", 246, 32, 48,
     "time_boot_ms@0 q1@4 q2@8 q3@12 q4@16 rollspeed@20 pitchspeed@24 yawspeed@28 "
     "repr_offset_q@32"},
    {32, "LOCAL_POSITION_NED", 185, 28, 28, "time_boot_ms@0 x@4 y@8 z@12 vx@16 vy@20 vz@24"},
    {33, "GLOBAL_POSITION_INT", 104, 28, 28,
     "time_boot_ms@0 lat@4 lon@8 alt@12 relative_alt@16 vx@20 vy@22 vz@24 hdg@26"},
    {43, "MISSION_REQUEST_LIST", 132, 2, 3, "target_system@0 target_component@1 mission_type@2"},
    {44, "MISSION_COUNT", 221, 4, 9,
     "count@0 target_system@2 target_component@3 mission_type@4 opaque_id@5"},
    {48, "SET_GPS_GLOBAL_ORIGIN", 41, 13, 21,
     "latitude@0 longitude@4 altitude@8 target_system@12 time_usec@13"},
    {49, "GPS_GLOBAL_ORIGIN", 39, 12, 20, "latitude@0 longitude@4 altitude@8 time_usec@12"},
    {76, "COMMAND_LONG", 152, 33, 33,
     "param1@0 param2@4 param3@8 param4@12 param5@16 param6@20 param7@24 command@28 "
     "target_system@30 target_component@31 confirmation@32"},
    {77, "COMMAND_ACK", 143, 3, 10,
     "command@0 result@2 progress@3 result_param2@4 target_system@8 target_component@9"},
    {82, "SET_ATTITUDE_TARGET", 49, 39, 51,
     "time_boot_ms@0 q@4 body_roll_rate@20 body_pitch_rate@24 body_yaw_rate@28 thrust@32 "
     "target_system@36 target_component@37 type_mask@38 thrust_body@39"},
    {83, "ATTITUDE_TARGET", 22, 37, 37,
     "time_boot_ms@0 q@4 body_roll_rate@20 body_pitch_rate@24 body_yaw_rate@28 thrust@32 "
     "type_mask@36"},
    {84, "SET_POSITION_TARGET_LOCAL_NED", 143, 53, 53,
     "time_boot_ms@0 x@4 y@8 z@12 vx@16 vy@20 vz@24 afx@28 afy@32 afz@36 yaw@40 yaw_rate@44 "
     "type_mask@48 target_system@50 target_component@51 coordinate_frame@52"},
    {85, "POSITION_TARGET_LOCAL_NED", 140, 51, 51,
     "time_boot_ms@0 x@4 y@8 z@12 vx@16 vy@20 vz@24 afx@28 afy@32 afz@36 yaw@40 yaw_rate@44 "
     "type_mask@48 coordinate_frame@50"},
    {93, "HIL_ACTUATOR_CONTROLS", 47, 81, 81, "time_usec@0 flags@8 controls@16 mode@80"},
    {102, "VISION_POSITION_ESTIMATE", 158, 32, 117,
     "usec@0 x@8 y@12 z@16 roll@20 pitch@24 yaw@28 covariance@32 reset_counter@116"},
    {107, "HIL_SENSOR", 108, 64, 65,
     "time_usec@0 xacc@8 yacc@12 zacc@16 xgyro@20 ygyro@24 zgyro@28 xmag@32 ymag@36 zmag@40 "
     "abs_pressure@44 diff_pressure@48 pressure_alt@52 temperature@56 fields_updated@60 id@64"},
    {111, "TIMESYNC", 34, 16, 18, "tc1@0 ts1@8 target_system@16 target_component@17"},
    {113, "HIL_GPS", 124, 36, 39,
     "time_usec@0 lat@8 lon@12 alt@16 eph@20 epv@22 vel@24 vn@26 ve@28 vd@30 cog@32 "
     "fix_type@34 satellites_visible@35 id@36 yaw@37"},
    {115, "HIL_STATE_QUATERNION", 4, 64, 64,
     "time_usec@0 attitude_quaternion@8 rollspeed@24 pitchspeed@28 yawspeed@32 lat@36 lon@40 "
     "alt@44 vx@48 vy@50 vz@52 ind_airspeed@54 true_airspeed@56 xacc@58 yacc@60 zacc@62"},
    {132, "DISTANCE_SENSOR", 85, 14, 39,
     "time_boot_ms@0 min_distance@4 max_distance@6 current_distance@8 type@10 id@11 "
     "orientation@12 covariance@13 horizontal_fov@14 vertical_fov@18 quaternion@22 "
     "signal_quality@38"},
    {138, "ATT_POS_MOCAP", 109, 36, 120, "time_usec@0 q@8 x@24 y@28 z@32 covariance@36"},
    {147, "BATTERY_STATUS", 154, 36, 54,
     "current_consumed@0 energy_consumed@4 temperature@8 voltages@10 current_battery@30 id@32 "
     "battery_function@33 type@34 battery_remaining@35 time_remaining@36 charge_state@40 "
     "voltages_ext@41 mode@49 fault_bitmask@50"},
    {148, "AUTOPILOT_VERSION", 178, 60, 78,
     "capabilities@0 uid@8 flight_sw_version@16 middleware_sw_version@20 os_sw_version@24 "
     "board_version@28 vendor_id@32 product_id@34 flight_custom_version@36 "
     "middleware_custom_version@44 os_custom_version@52 uid2@60"},
    {230, "ESTIMATOR_STATUS", 163, 42, 42,
     "time_usec@0 vel_ratio@8 pos_horiz_ratio@12 pos_vert_ratio@16 mag_ratio@20 hagl_ratio@24 "
     "tas_ratio@28 pos_horiz_accuracy@32 pos_vert_accuracy@36 flags@40"},
    {242, "HOME_POSITION", 104, 52, 60,
     "latitude@0 longitude@4 altitude@8 x@12 y@16 z@20 q@24 approach_x@40 approach_y@44 "
     "approach_z@48 time_usec@52"},
    {245, "EXTENDED_SYS_STATE", 130, 2, 2, "vtol_state@0 landed_state@1"},
    {251, "NAMED_VALUE_FLOAT", 170, 18, 18, "time_boot_ms@0 value@4 name@8"},
    {253, "STATUSTEXT", 83, 51, 54, "severity@0 text@1 id@51 chunk_seq@53"},
    {256, "SETUP_SIGNING", 71, 42, 42,
     "initial_timestamp@0 target_system@8 target_component@9 secret_key@10"},
    {331, "ODOMETRY", 91, 230, 233,
     "time_usec@0 x@8 y@12 z@16 q@20 vx@36 vy@40 vz@44 rollspeed@48 pitchspeed@52 yawspeed@56 "
     "pose_covariance@60 velocity_covariance@144 frame_id@228 child_frame_id@229 "
     "reset_counter@230 estimator_type@231 quality@232"},
    {410, "EVENT", 160, 53, 53,
     "id@0 event_time_boot_ms@4 sequence@8 destination_component@10 destination_system@11 "
     "log_levels@12 arguments@13"},
}};

}  // namespace limpet::mavlink
