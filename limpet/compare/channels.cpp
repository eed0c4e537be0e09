// SPDX-License-Identifier: Apache-2.0
#include "limpet/compare/channels.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <tuple>
#include <utility>

#include "limpet/core/find_by.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/record/story.hpp"
#include "limpet/record/topics.hpp"
#include "limpet/record/units.hpp"

namespace limpet::compare {
namespace {

constexpr double kDeg = 180.0 / kPi;
constexpr double kTurn_deg = 360.0;
/// Samples further apart than so many usual steps have a gap between them. A reading that comes
/// late by one step is none.
constexpr double kGapSteps = 3.5;

/// Where a channel comes from and what its numbers are multiplied by.
struct ChannelSource {
    std::string_view name;
    std::string_view group;
    std::string_view title;
    std::string_view unit;
    std::string_view topic;
    std::string_view column;
    double scale = 1.0;
    ChannelKind kind = ChannelKind::number;
    std::string_view names = {};  ///< of a state's values from 0 on, with blanks between
};

constexpr auto kAngle = ChannelKind::angle;
constexpr auto kState = ChannelKind::state;

/// ROS's "map" is east-north-up, its "base_link" forward-left-up: y and z of ours change.
constexpr ChannelSource kChannelSources[] = {
    {"cup_pressure_hPa", "cup", "pressure in the cup", "hPa", "/cup", "pressure_Pa",
     hectopascals(1.0)},
    {"cup_pressure_measured_hPa", "cup", "pressure in the cup, measured", "hPa",
     "/sensors/cup_pressure", "fluid_pressure", hectopascals(1.0)},
    {"cup_pull_N", "cup", "pull on the cup", "N", "/cup", "pull_N"},
    {"cup_shear_N", "cup", "shear on the cup", "N", "/cup", "shear_N"},
    {"cup_peel_N_m", "cup", "peel on the cup", "N m", "/cup", "peel_N_m"},
    {"cup_phase", "cup", "phase of the cup", "", "/cup", "phase", 1.0, kState,
     "free touching sealing attached unsealing"},
    {"pump_running", "cup", "pump", "", "/cup", "pump_running", 1.0, kState, "off running"},
    {"valve_open", "cup", "valve", "", "/cup", "valve_open", 1.0, kState, "closed open"},
    {"slider_force_N", "force", "force through the slider", "N", "/truth/vehicle",
     "slider_force_N"},
    {"slider_force_measured_N", "force", "force through the slider, measured", "N",
     "/sensors/force", "wrench.force.x"},
    {"slider_mm", "force", "slider", "mm", "/truth/vehicle", "slider_position_m", 1e3},
    {"legs_force_north_N", "force", "force of the wall on the legs, north", "N", "/truth/vehicle",
     "legs_force_north_N"},
    {"legs_force_down_N", "force", "force of the wall on the legs, down", "N", "/truth/vehicle",
     "legs_force_down_N"},
    {"pitch_deg", "attitude", "pitch", "deg", "/truth/vehicle", "pitch_rad", kDeg, kAngle},
    {"roll_deg", "attitude", "roll", "deg", "/truth/vehicle", "roll_rad", kDeg, kAngle},
    {"yaw_deg", "attitude", "yaw", "deg", "/truth/vehicle", "yaw_rad", kDeg, kAngle},
    {"cup_pitch_deg", "attitude", "cup on its joint, pitch", "deg", "/truth/vehicle",
     "cup_pitch_rad", kDeg, kAngle},
    {"cup_yaw_deg", "attitude", "cup on its joint, yaw", "deg", "/truth/vehicle", "cup_yaw_rad",
     kDeg, kAngle},
    {"rate_pitch_deg_s", "rates", "pitch rate", "deg/s", "/truth/vehicle", "rate_right_rad_s",
     kDeg},
    {"rate_roll_deg_s", "rates", "roll rate", "deg/s", "/truth/vehicle", "rate_forward_rad_s",
     kDeg},
    {"rate_yaw_deg_s", "rates", "yaw rate", "deg/s", "/truth/vehicle", "rate_down_rad_s", kDeg},
    {"north_m", "position", "north", "m", "/truth/pose", "pose.position.y"},
    {"east_m", "position", "east", "m", "/truth/pose", "pose.position.x"},
    {"down_m", "position", "down", "m", "/truth/pose", "pose.position.z", -1.0},
    {"estimated_north_m", "position", "north, estimated", "m", "/estimate/pose", "pose.position.y"},
    {"estimated_east_m", "position", "east, estimated", "m", "/estimate/pose", "pose.position.x"},
    {"estimated_down_m", "position", "down, estimated", "m", "/estimate/pose", "pose.position.z",
     -1.0},
    {"velocity_north_m_s", "speed", "speed north", "m/s", "/truth/vehicle", "velocity_north_m_s"},
    {"velocity_east_m_s", "speed", "speed east", "m/s", "/truth/vehicle", "velocity_east_m_s"},
    {"velocity_down_m_s", "speed", "speed down", "m/s", "/truth/vehicle", "velocity_down_m_s"},
    {"estimated_speed_forward_m_s", "speed", "speed forward, estimated", "m/s", "/estimate/twist",
     "twist.linear.x"},
    {"estimated_speed_right_m_s", "speed", "speed to the right, estimated", "m/s",
     "/estimate/twist", "twist.linear.y", -1.0},
    {"estimated_speed_down_m_s", "speed", "speed down the body, estimated", "m/s",
     "/estimate/twist", "twist.linear.z", -1.0},
    {"lidar_left_m", "distance", "LiDAR, left", "m", "/sensors/range_left", "range"},
    {"lidar_right_m", "distance", "LiDAR, right", "m", "/sensors/range_right", "range"},
    {"thrust_N", "rotors", "total thrust", "N", "/truth/vehicle", "thrust_N"},
    {"rotor_0_rad_s", "rotors", "rotor 0", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[0]"},
    {"rotor_1_rad_s", "rotors", "rotor 1", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[1]"},
    {"rotor_2_rad_s", "rotors", "rotor 2", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[2]"},
    {"rotor_3_rad_s", "rotors", "rotor 3", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[3]"},
    {"rotor_4_rad_s", "rotors", "rotor 4", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[4]"},
    {"rotor_5_rad_s", "rotors", "rotor 5", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[5]"},
    {"rotor_6_rad_s", "rotors", "rotor 6", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[6]"},
    {"rotor_7_rad_s", "rotors", "rotor 7", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[7]"},
    {"rotor_8_rad_s", "rotors", "rotor 8", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[8]"},
    {"rotor_9_rad_s", "rotors", "rotor 9", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[9]"},
    {"rotor_10_rad_s", "rotors", "rotor 10", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[10]"},
    {"rotor_11_rad_s", "rotors", "rotor 11", "rad/s", "/truth/vehicle", "rotor_speed_rad_s[11]"},
    {"battery_V", "battery", "battery", "V", "/truth/vehicle", "battery_voltage_V"},
    {"battery_A", "battery", "current", "A", "/truth/vehicle", "battery_current_A"},
    {"battery_measured_V", "battery", "battery, measured", "V", "/sensors/battery", "voltage"},
    {"setpoint_north_m", "setpoint", "set-point: north", "m", "/setpoint", "position_north_m"},
    {"setpoint_east_m", "setpoint", "set-point: east", "m", "/setpoint", "position_east_m"},
    {"setpoint_down_m", "setpoint", "set-point: down", "m", "/setpoint", "position_down_m"},
    {"setpoint_speed_north_m_s", "setpoint", "set-point: speed north", "m/s", "/setpoint",
     "velocity_north_m_s"},
    {"setpoint_pitch_deg", "setpoint", "set-point: pitch", "deg", "/setpoint", "pitch_rad", kDeg,
     kAngle},
    {"setpoint_yaw_deg", "setpoint", "set-point: yaw", "deg", "/setpoint", "yaw_rad", kDeg, kAngle},
    {"setpoint_thrust", "setpoint", "set-point: thrust", "share", "/setpoint", "thrust"},
    {"setpoint_mode", "setpoint", "mode", "", "/setpoint", "mode", 1.0, kState,
     "idle position velocity attitude"},
    {"setpoint_armed", "setpoint", "armed", "", "/setpoint", "armed", 1.0, kState,
     "disarmed armed"},
    {"setpoint_pump", "setpoint", "set-point: pump", "", "/setpoint", "pump_on", 1.0, kState,
     "off on"},
    {"setpoint_valve", "setpoint", "set-point: valve", "", "/setpoint", "valve_open", 1.0, kState,
     "closed open"},
};

/// Times ascend, gap_s is known. Recorders write in order; other people's files need not.
void finish(FlightChannel& channel) {
    auto& t = channel.time_s;
    if (!std::is_sorted(t.begin(), t.end())) {
        std::vector<std::size_t> order(t.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&t](std::size_t a, std::size_t b) { return t[a] < t[b]; });
        const FlightChannel before = channel;
        for (std::size_t i = 0; i < order.size(); ++i) {
            t[i] = before.time_s[order[i]];
            channel.values[i] = before.values[order[i]];
        }
    }
    if (t.size() < 2) {
        return;
    }
    std::vector<double> steps(t.size());
    std::adjacent_difference(t.begin(), t.end(), steps.begin());
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(1 + (steps.size() - 1) / 2);
    std::nth_element(steps.begin() + 1, middle, steps.end());
    channel.gap_s = kGapSteps * *middle;
}

void add(std::vector<FlightChannel>& channels, FlightChannel channel) {
    for (double& value : channel.values) {
        value = std::isfinite(value) ? value : kNaN;
    }
    const bool any = std::any_of(channel.values.begin(), channel.values.end(),
                                 [](double value) { return !std::isnan(value); });
    if (any) {
        finish(channel);
        channels.push_back(std::move(channel));
    }
}

FlightChannel channel_of(const record::Table& table, const ChannelSource& source,
                         const std::vector<double>& values) {
    FlightChannel channel{.name = std::string(source.name),
                          .group = std::string(source.group),
                          .title = std::string(source.title),
                          .unit = std::string(source.unit),
                          .kind = source.kind,
                          .time_s = table.time_s,
                          .values = values};
    for (double& value : channel.values) {
        value *= source.scale;
    }
    std::istringstream names{std::string(source.names)};
    for (std::string name; names >> name;) {
        channel.names.emplace(static_cast<double>(channel.names.size()), name);
    }
    return channel;
}

/// The autopilot's attitude as angles.
void add_estimated_attitude(std::vector<FlightChannel>& channels,
                            const record::Recording& recording) {
    const record::Table* table = find_table(recording, "/estimate/pose");
    const auto q = columns_of<4>(table, {"pose.orientation.w", "pose.orientation.x",
                                         "pose.orientation.y", "pose.orientation.z"});
    if (q[0] == nullptr) {
        return;
    }
    std::vector<double> roll(table->time_s.size());
    std::vector<double> pitch = roll;
    std::vector<double> yaw = roll;
    for (std::size_t i = 0; i < roll.size(); ++i) {
        const Quaternion q_ros(q[0]->values[i], q[1]->values[i], q[2]->values[i], q[3]->values[i]);
        const Euler angles = euler_from_quaternion(record::ros::enu_flu_from_ned_frd(q_ros));
        roll[i] = angles.roll_rad;
        pitch[i] = angles.pitch_rad;
        yaw[i] = angles.yaw_rad;
    }
    for (const auto& [name, title, values] :
         {std::tuple{"estimated_pitch_deg", "pitch, estimated", &pitch},
          std::tuple{"estimated_roll_deg", "roll, estimated", &roll},
          std::tuple{"estimated_yaw_deg", "yaw, estimated", &yaw}}) {
        add(channels,
            channel_of(*table, {name, "attitude", title, "deg", {}, {}, kDeg, kAngle}, *values));
    }
}

void add_guidance_state(std::vector<FlightChannel>& channels, const record::Recording& recording,
                        StateNumbers& numbers) {
    const record::Table* table = find_table(recording, "/guidance");
    const record::TextColumn* states = table == nullptr ? nullptr : table->find_text("state");
    if (states == nullptr) {
        return;
    }
    std::vector<double> values;
    for (const std::string& state : states->values) {
        const auto next = static_cast<double>(numbers.size());
        values.push_back(numbers.try_emplace(state, next).first->second);
    }
    FlightChannel channel = channel_of(
        *table, {"guidance_state", "setpoint", "state of guidance", "", {}, {}, 1.0, kState},
        values);
    for (const auto& [state, number] : numbers) {
        channel.names.emplace(number, record::words(state));
    }
    add(channels, std::move(channel));
}

}  // namespace

std::vector<FlightChannel> flight_channels(const record::Recording& recording,
                                           StateNumbers& numbers) {
    std::vector<FlightChannel> channels;
    for (const ChannelSource& source : kChannelSources) {
        const record::Table* table = find_table(recording, source.topic);
        const record::Column* column = table == nullptr ? nullptr : table->find(source.column);
        if (column != nullptr) {
            add(channels, channel_of(*table, source, column->values));
        }
    }
    add_estimated_attitude(channels, recording);
    add_guidance_state(channels, recording, numbers);
    for (const record::Table& table : recording.tables) {
        for (const record::Column& column : table.columns) {
            if (find_named(record::kTopics, table.topic) == nullptr &&
                column.name.find("stamp") == std::string::npos) {
                const std::string name =
                    table.topic + "/" + record::column_name_with_unit(table.type, column.name);
                add(channels, channel_of(table, {name, "others", name, "", {}, {}}, column.values));
            }
        }
    }
    return channels;
}

double difference_of(ChannelKind kind, double reference, double other) {
    switch (kind) {
        case ChannelKind::number: return other - reference;
        case ChannelKind::angle: {
            const double turned = other - reference;
            return turned - kTurn_deg * std::floor((turned + 0.5 * kTurn_deg) / kTurn_deg);
        }
        case ChannelKind::state:
            return std::isnan(reference) || std::isnan(other) ? kNaN
                   : reference == other                       ? 0.0
                                                              : 1.0;
    }
    return kNaN;
}

double value_at(const FlightChannel& channel, double time_s) {
    constexpr double kSame_s = 1e-9;  // recorded times are whole nanoseconds
    const auto& t = channel.time_s;
    const auto after = std::lower_bound(t.begin(), t.end(), time_s - kSame_s);
    if (after == t.end()) {
        return kNaN;
    }
    const auto right = static_cast<std::size_t>(after - t.begin());
    if (t[right] <= time_s + kSame_s) {
        return channel.values[right];
    }
    if (right == 0 || t[right] - t[right - 1] > channel.gap_s) {
        return kNaN;
    }
    const double left_value = channel.values[right - 1];
    if (channel.kind == ChannelKind::state) {
        return left_value;
    }
    const double share = (time_s - t[right - 1]) / (t[right] - t[right - 1]);
    return left_value + share * difference_of(channel.kind, left_value, channel.values[right]);
}

}  // namespace limpet::compare
