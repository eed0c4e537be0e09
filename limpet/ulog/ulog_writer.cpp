// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/write_file.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/ulog/ulog.hpp"

namespace limpet::ulog {
namespace {

using namespace record;  // of whose columns a log is made

/// Columns of a table by name; NaN where there is none, or no table.
class Rows {
public:
    /// @param other  a topic with the same vehicle's twist; null: there is none
    explicit Rows(const Table* table, const Table* other = nullptr)
        : table_(table), other_(other) {}
    [[nodiscard]] std::size_t count() const {
        return table_ == nullptr ? 0 : table_->time_s.size();
    }
    [[nodiscard]] double time_s(std::size_t row) const { return table_->time_s[row]; }
    [[nodiscard]] double at(const std::string& column, std::size_t row) const {
        const Column* found = table_->find(column);
        return found == nullptr ? kNaN : found->values[row];
    }
    [[nodiscard]] Vector3 xyz(const std::string& path, std::size_t row) const {
        return {at(path + ".x", row), at(path + ".y", row), at(path + ".z", row)};
    }
    /// Of a pose in "map", turned to ours.
    [[nodiscard]] Quaternion q_WB(std::size_t row) const {
        const std::string q = "pose.orientation.";
        return ros::enu_flu_from_ned_frd(
            {at(q + "w", row), at(q + "x", row), at(q + "y", row), at(q + "z", row)});
    }
    [[nodiscard]] Vector3 p_W_m(std::size_t row) const {
        return ros::enu_from_ned(xyz("pose.position", row));
    }

    /// By the twist of the same instant, of which both are recorded; NaN where there is none.
    [[nodiscard]] Vector3 v_W_m_s(std::size_t row) const {
        const std::vector<double> none;
        const std::vector<double>& times = other_ == nullptr ? none : other_->time_s;
        const auto found = std::lower_bound(times.begin(), times.end(), time_s(row));
        if (found == times.end() || *found != time_s(row)) {
            return Vector3::Constant(kNaN);
        }
        const auto at = static_cast<std::size_t>(found - times.begin());
        return q_WB(row) * ros::flu_from_frd(Rows(other_).xyz("twist.linear", at));
    }

private:
    const Table* table_;
    const Table* other_;
};

std::string bytes_of(const auto& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// A message's fields behind its time stamp, one row of a table.
class Fields {
public:
    void real(double value) { bytes_ += bytes_of(static_cast<float>(value)); }
    void reals(const Vector3& v) {
        real(v.x());
        real(v.y());
        real(v.z());
    }
    void reals(const Quaternion& q) {  // w first
        real(q.w());
        reals(Vector3(q.vec()));
    }
    void byte(double value) {
        bytes_ += static_cast<char>(static_cast<std::uint8_t>(std::isfinite(value) ? value : 0.0));
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// Where a topic of PX4's comes from. Fields of a float come before those of a byte: nothing is
/// padded.
struct Px4Topic {
    std::string_view name;
    std::string_view fields;  ///< as in a format message, without the time stamp
    std::string_view from;    ///< topic of the recording
    std::function<void(Fields& fields, const Rows& rows, std::size_t row)> fill;
    std::uint8_t instance = 0;
    /// What is recorded at an instant has acted since the one before (simulation/flight_log.cpp); a
    /// PX4 log has it when it was sent.
    bool acted_since = false;
    std::string_view other = {};  ///< topic of the recording with what else a row needs
};

void fill_attitude(Fields& fields, const Rows& rows, std::size_t row) {
    fields.reals(rows.q_WB(row));
}
void fill_position(Fields& fields, const Rows& rows, std::size_t row) {
    const Vector3 v_W_m_s = rows.v_W_m_s(row);
    const double moves = v_W_m_s.allFinite() ? 1.0 : 0.0;
    fields.reals(rows.p_W_m(row));
    fields.reals(v_W_m_s);
    fields.real(euler_from_quaternion(rows.q_WB(row)).yaw_rad);
    for (const double valid : {1.0, 1.0, moves, moves}) {
        fields.byte(valid);
    }
}
void fill_range(Fields& fields, const Rows& rows, std::size_t row) {
    fields.real(rows.at("range", row));
    fields.real(rows.at("min_range", row));
    fields.real(rows.at("max_range", row));
}
void fill_rates(Fields& fields, const Rows& rows, std::size_t row) {
    fields.reals(ros::flu_from_frd(rows.xyz("twist.angular", row)));
}

const std::vector<Px4Topic>& px4_topics() {
    constexpr std::string_view kPosition =
        "float x;float y;float z;float vx;float vy;float vz;float heading;bool xy_valid;"
        "bool z_valid;bool v_xy_valid;bool v_z_valid;";
    constexpr std::string_view kRange =
        "float current_distance;float min_distance;float max_distance;";
    static const std::vector<Px4Topic> all = {
        {"vehicle_attitude", "float[4] q;", "/estimate/pose", fill_attitude},
        {"vehicle_local_position", kPosition, "/estimate/pose", fill_position, 0, false,
         "/estimate/twist"},
        {"vehicle_angular_velocity", "float[3] xyz;", "/estimate/twist", fill_rates},
        {"vehicle_attitude_groundtruth", "float[4] q;", "/truth/pose", fill_attitude},
        {"vehicle_local_position_groundtruth", kPosition, "/truth/pose", fill_position, 0, false,
         "/truth/twist"},
        {"vehicle_angular_velocity_groundtruth", "float[3] xyz;", "/truth/twist", fill_rates},
        {"sensor_combined", "float[3] gyro_rad;float[3] accelerometer_m_s2;", "/sensors/imu",
         [](Fields& fields, const Rows& rows, std::size_t row) {
             fields.reals(ros::flu_from_frd(rows.xyz("angular_velocity", row)));
             fields.reals(ros::flu_from_frd(rows.xyz("linear_acceleration", row)));
         }},
        {"distance_sensor", kRange, "/sensors/range_left", fill_range, 0},
        {"distance_sensor", kRange, "/sensors/range_right", fill_range, 1},
        {"battery_status", "float voltage_v;float current_a;float remaining;", "/sensors/battery",
         [](Fields& fields, const Rows& rows, std::size_t row) {
             fields.real(rows.at("voltage", row));
             fields.real(-rows.at("current", row));
             fields.real(rows.at("percentage", row));
         }},
        {"vehicle_local_position_setpoint",
         "float x;float y;float z;float vx;float vy;float vz;float[3] acceleration;float yaw;",
         "/setpoint",
         [](Fields& fields, const Rows& rows, std::size_t row) {
             for (const char* column :
                  {"position_north_m", "position_east_m", "position_down_m", "velocity_north_m_s",
                   "velocity_east_m_s", "velocity_down_m_s", "acceleration_north_m_s2",
                   "acceleration_east_m_s2", "acceleration_down_m_s2", "yaw_rad"}) {
                 fields.real(rows.at(column, row));
             }
         }},
        {"vehicle_attitude_setpoint", "float[4] q_d;float[3] thrust_body;", "/setpoint",
         [](Fields& fields, const Rows& rows, std::size_t row) {
             fields.reals(quaternion_from_euler(
                 {rows.at("roll_rad", row), rows.at("pitch_rad", row), rows.at("yaw_rad", row)}));
             fields.reals(Vector3(0.0, 0.0, -rows.at("thrust", row)));
         }},
        {"vehicle_status", "uint8_t arming_state;uint8_t nav_state;", "/setpoint",
         [](Fields& fields, const Rows& rows, std::size_t row) {
             constexpr double kDisarmed = 1, kArmed = 2, kOffboard = 14;
             fields.byte(rows.at("armed", row) > 0.0 ? kArmed : kDisarmed);
             fields.byte(kOffboard);
         }},
        {"actuator_motors", "float[12] control;", "/rotor_command",
         [](Fields& fields, const Rows& rows, std::size_t row) {
             for (int motor = 0; motor < 12; ++motor) {
                 fields.real(rows.at(fmt::format("command[{}]", motor), row));
             }
         },
         0, true},
        {"limpet_cup",
         "float pressure_pa;float pull_n;float shear_n;float peel_n_m;float gap_m;uint8_t phase;"
         "bool pump_running;bool valve_open;",
         "/cup",
         [](Fields& fields, const Rows& rows, std::size_t row) {
             for (const char* column : {"pressure_Pa", "pull_N", "shear_N", "peel_N_m", "gap_m"}) {
                 fields.real(rows.at(column, row));
             }
             for (const char* column : {"phase", "pump_running", "valve_open"}) {
                 fields.byte(rows.at(column, row));
             }
         }},
    };
    return all;
}

/// Size, type, content.
std::string message(char type, const std::string& content) {
    constexpr std::size_t kMost = 65535;
    require(content.size() <= kMost, "a ULog message has at most 65535 bytes");
    return bytes_of(static_cast<std::uint16_t>(content.size())) + type + content;
}

std::string information(const std::string& name, const std::string& value) {
    const std::string key = fmt::format("char[{}] {}", value.size(), name);
    return message('I', bytes_of(static_cast<std::uint8_t>(key.size())) + key + value);
}

std::uint64_t microseconds(double time_s) {
    return static_cast<std::uint64_t>(std::llround(1e6 * time_s));
}

using Timed = std::pair<std::uint64_t, std::string>;  ///< [us], a whole message

std::string definitions(const Recording& recording) {
    std::string text = message('B', std::string(40, '\0'));  // no flag is set
    text += information("sys_name", "Limpet");
    const auto about = recording.metadata.find("limpet");
    if (about != recording.metadata.end()) {
        for (const auto& [key, name] :
             {std::pair("version", "ver_sw"), std::pair("scenario", "limpet_scenario")}) {
            const auto found = about->second.find(key);
            if (found != about->second.end() && !found->second.empty()) {
                text += information(name, found->second);
            }
        }
    }
    std::string_view last;
    for (const Px4Topic& topic : px4_topics()) {
        if (topic.name != std::exchange(last, topic.name)) {
            text += message('F', fmt::format("{}:uint64_t timestamp;{}", topic.name, topic.fields));
        }
    }
    return text;
}

void gather(const Px4Topic& topic, std::uint16_t id, const Rows& rows, std::vector<Timed>& data) {
    const double period_s = rows.count() > 1 ? rows.time_s(1) - rows.time_s(0) : 0.0;
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const double said_s = rows.time_s(row) - (topic.acted_since ? period_s : 0.0);
        if (said_s < 0.0) {
            continue;  // before the flight
        }
        const std::uint64_t time_us = microseconds(said_s);
        Fields fields;
        topic.fill(fields, rows, row);
        data.emplace_back(time_us, message('D', bytes_of(id) + bytes_of(time_us) + fields.bytes()));
    }
}

void gather_events(const Recording& recording, std::vector<Timed>& data) {
    constexpr char kInformation = '6';
    for (const RecordedEvent& event : recording.events) {
        const std::uint64_t time_us = microseconds(event.time_s);
        data.emplace_back(time_us, message('L', kInformation + bytes_of(time_us) +
                                                    fmt::format("[{}] {}: {}", event.station,
                                                                event.name, event.reason)));
    }
}

}  // namespace

void write_ulog(const Recording& recording, const std::filesystem::path& file) {
    std::string log("ULog\x01\x12\x35\x01", 8);
    log += bytes_of(std::uint64_t{0});
    log += definitions(recording);
    std::vector<Timed> data;
    std::uint16_t id = 0;
    for (const Px4Topic& topic : px4_topics()) {
        const Rows rows(find_by(recording.tables, &Table::topic, topic.from),
                        find_by(recording.tables, &Table::topic, topic.other));
        if (rows.count() > 0) {
            log += message('A', std::string(1, static_cast<char>(topic.instance)) + bytes_of(id) +
                                    std::string(topic.name));
            gather(topic, id++, rows, data);
        }
    }
    if (data.empty()) {
        throw InputError(recording.path.string() + ": nothing in it has a place in a PX4 log");
    }
    gather_events(recording, data);
    // by time, and what has one time in the order in which it was gathered
    std::vector<const Timed*> in_time;
    in_time.reserve(data.size());
    for (const Timed& one : data) {
        in_time.push_back(&one);
    }
    std::sort(in_time.begin(), in_time.end(), [](const Timed* a, const Timed* b) {
        return a->first != b->first ? a->first < b->first : a < b;
    });
    for (const Timed* one : in_time) {
        log += one->second;
    }
    if (!write_file(file, log)) {
        throw InputError("cannot write " + file.string());
    }
}

}  // namespace limpet::ulog
