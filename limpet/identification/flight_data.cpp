// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/flight_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/time.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/ulog/ulog.hpp"

namespace limpet::identification {
namespace {

using record::Table;

/// Columns of a table that may not be there.
class Rows {
public:
    Rows(const record::Recording& recording, std::string_view topic)
        : table_(find_by(recording.tables, &Table::topic, topic)) {
        for (std::size_t i = 0; table_ != nullptr && i < table_->columns.size(); ++i) {
            columns_.emplace(table_->columns[i].name, &table_->columns[i]);
        }
    }
    [[nodiscard]] std::size_t count() const {
        return table_ == nullptr ? 0 : table_->time_s.size();
    }
    [[nodiscard]] const std::vector<double>& time_s() const { return table_->time_s; }
    [[nodiscard]] bool has(std::string_view column) const {
        return columns_.find(column) != columns_.end();
    }
    [[nodiscard]] double at(std::string_view column, std::size_t row) const {
        const auto found = columns_.find(column);
        return found == columns_.end() ? kNaN : found->second->values[row];
    }
    [[nodiscard]] Vector3 xyz(const std::string& path, std::size_t row) const {
        return {at(path + ".x", row), at(path + ".y", row), at(path + ".z", row)};
    }
    [[nodiscard]] Vector3 each3(const std::string& path, std::size_t row) const {
        return {at(path + "[0]", row), at(path + "[1]", row), at(path + "[2]", row)};
    }

private:
    const Table* table_;
    std::map<std::string_view, const record::Column*> columns_;  ///< a log may have thousands
};

/// Commands of the motors that there are: PX4 logs twelve and says NaN of those that are not.
void add_commands(const Rows& rows, const char* name, FlightData& data) {
    std::size_t motors = 0;
    for (std::size_t i = 0; i < kMaxRotors && rows.has(fmt::format("{}[{}]", name, i)); ++i) {
        for (std::size_t row = 0; row < rows.count() && motors == i; ++row) {
            motors += std::isfinite(rows.at(fmt::format("{}[{}]", name, i), row)) ? 1 : 0;
        }
    }
    for (std::size_t row = 0; row < rows.count(); ++row) {
        const bool armed = !rows.has("armed") || rows.at("armed", row) > 0.0;
        RotorList<double> command(motors, 0.0);
        for (std::size_t i = 0; i < motors && armed; ++i) {
            const double share = rows.at(fmt::format("{}[{}]", name, i), row);
            command[i] = std::isfinite(share) ? share : 0.0;  // a motor that stands
        }
        data.command.push_back(command);
    }
    data.command_s = rows.count() > 0 ? rows.time_s() : std::vector<double>{};
}

FlightData of_recording(const record::Recording& recording) {
    using record::ros::flu_from_frd;
    FlightData data{.damage = recording.damage, .remarks = recording.remarks, .kind = "recording"};
    if (const auto* text = recording.attachment("scenario.yaml")) {
        data.scenario_yaml = text->text;
    }
    const Rows imu(recording, "/sensors/imu"), twist(recording, "/estimate/twist");
    for (std::size_t row = 0; row < imu.count(); ++row) {
        data.rate_B_rad_s.push_back(flu_from_frd(imu.xyz("angular_velocity", row)));
        data.specific_force_B_m_s2.push_back(flu_from_frd(imu.xyz("linear_acceleration", row)));
    }
    data.imu_s = imu.count() > 0 ? imu.time_s() : std::vector<double>{};
    add_commands(Rows(recording, "/rotor_command"), "command", data);
    // What is recorded at an instant has acted since the one before (simulation/flight_log.cpp).
    const double period_s = data.command_s.size() > 1 ? data.command_s[1] - data.command_s[0] : 0.0;
    for (double& time_s : data.command_s) {
        time_s -= period_s;
    }
    for (std::size_t row = 0; row < twist.count(); ++row) {
        data.velocity_B_m_s.push_back(flu_from_frd(twist.xyz("twist.linear", row)));
    }
    data.velocity_s = twist.count() > 0 ? twist.time_s() : std::vector<double>{};
    const Rows force(recording, "/sensors/force"), pressure(recording, "/sensors/cup_pressure");
    for (std::size_t row = 0; row < force.count(); ++row) {
        data.force_s.push_back(force.time_s()[row]);
        data.force_N.push_back(force.at("wrench.force.x", row));
    }
    for (std::size_t row = 0; row < pressure.count(); ++row) {
        data.pressure.t_s.push_back(pressure.time_s()[row]);
        data.pressure.pressure_Pa.push_back(pressure.at("fluid_pressure", row));
    }
    return data;
}

/// PX4's velocity is the world's: turned into B by the attitude that was logged last.
void add_velocities(const Rows& position, const Rows& attitude, FlightData& data) {
    std::size_t at = 0;
    for (std::size_t row = 0; row < position.count() && attitude.count() > 0; ++row) {
        const double time_s = position.time_s()[row];
        while (at + 1 < attitude.count() && attitude.time_s()[at + 1] <= time_s) {
            ++at;
        }
        const Quaternion q_WB(attitude.at("q[0]", at), attitude.at("q[1]", at),
                              attitude.at("q[2]", at), attitude.at("q[3]", at));
        const Vector3 v_W(position.at("vx", row), position.at("vy", row), position.at("vz", row));
        if (v_W.allFinite()) {
            data.velocity_s.push_back(time_s);
            data.velocity_B_m_s.push_back(q_WB.conjugate() * v_W);
        }
    }
}

/// A parameter of the log; nothing where it has none, or -1, "as all".
std::optional<double> parameter(const record::Recording& log, const std::string& name) {
    const auto all = log.metadata.find(std::string(ulog::kPx4Parameters));
    if (all == log.metadata.end()) {
        return std::nullopt;
    }
    const auto found = all->second.find(name);
    const auto value = found == all->second.end() ? std::nullopt : decimal(found->second);
    return value && *value >= 0.0 ? value : std::nullopt;
}

/// Where an output's scale begins and ends [us].
struct PwmScale {
    double low = 1000.0, high = 2000.0;  ///< PX4's defaults
};

/// @param bank     "MAIN" or "AUX"
/// @param channel  from 1
PwmScale pwm_scale(const record::Recording& log, const std::string& bank, std::size_t channel) {
    PwmScale scale;
    for (const std::string& name : {std::string("PWM_{}"), "PWM_" + bank + "_{}",
                                    "PWM_" + bank + "_{}" + std::to_string(channel)}) {
        scale.low = parameter(log, fmt::format(fmt::runtime(name), "MIN")).value_or(scale.low);
        scale.high = parameter(log, fmt::format(fmt::runtime(name), "MAX")).value_or(scale.high);
    }
    return scale.high > scale.low ? scale : PwmScale{};
}

/// An output over a log, and whether a motor hangs on it: it moves.
struct OutputRange {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
    [[nodiscard]] bool moves() const { return most > least + 0.01 * std::max(1.0, most); }
    [[nodiscard]] bool is_pwm() const {
        constexpr double kLeast_us = 800.0, kMost_us = 2200.0;
        return most >= kLeast_us && most <= kMost_us && (least == 0.0 || least >= kLeast_us);
    }
    [[nodiscard]] bool is_share() const { return least >= 0.0 && most <= 1.0; }
};

/// The outputs up to the last that moves.
std::vector<OutputRange> ranges_of(const Rows& rows) {
    std::vector<OutputRange> ranges;
    for (std::size_t i = 0; i < kMaxRotors && rows.has(fmt::format("output[{}]", i)); ++i) {
        OutputRange range;
        for (std::size_t row = 0; row < rows.count(); ++row) {
            const double value = rows.at(fmt::format("output[{}]", i), row);
            if (std::isfinite(value)) {
                range.least = std::min(range.least, value);
                range.most = std::max(range.most, value);
            }
        }
        ranges.push_back(range);
    }
    while (!ranges.empty() && !ranges.back().moves()) {
        ranges.pop_back();
    }
    return ranges;
}

/// PX4 up to v1.13: what goes to the motors' controllers, in microseconds. As actuator_motors has
/// it since, 0..1 of thrust, before THR_MDL_FAC bends it (mixer_module; thrust = f s^2 + (1 - f)
/// s). Source: docs.px4.io, "Thrust model"; PX4-Autopilot v1.13 src/lib/mixer_module
void add_outputs(const record::Recording& log, FlightData& data) {
    std::string topic = "actuator_outputs", bank = "MAIN";
    std::vector<OutputRange> ranges = ranges_of(Rows(log, topic));
    if (ranges.empty()) {
        topic += ".1";
        bank = "AUX";
        ranges = ranges_of(Rows(log, topic));
    }
    const auto of_motors = [&ranges](bool (OutputRange::*is)() const) {
        return std::all_of(ranges.begin(), ranges.end(), [is](const OutputRange& range) {
            return !range.moves() || (range.*is)();
        });
    };
    const bool share = of_motors(&OutputRange::is_share);
    if (ranges.empty() || (!share && !of_motors(&OutputRange::is_pwm))) {
        if (!ranges.empty()) {
            data.remarks.push_back(topic +
                                   " is neither PWM (800..2200 us) nor 0..1: motor commands are "
                                   "not taken from it");
        }
        return;
    }
    const double bend = std::min(parameter(log, "THR_MDL_FAC").value_or(0.0), 1.0);
    const Rows rows(log, topic);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const PwmScale scale = share ? PwmScale{0.0, 1.0} : pwm_scale(log, bank, i + 1);
        const std::string column = fmt::format("output[{}]", i);
        data.command.resize(rows.count(), RotorList<double>(ranges.size(), 0.0));
        for (std::size_t row = 0; row < rows.count() && ranges[i].moves(); ++row) {
            const double value = rows.at(column, row);
            const double signal = std::isfinite(value)
                                      ? (value - scale.low) / (scale.high - scale.low)
                                      : 0.0;  // a motor that stands
            const double s = std::clamp(signal, 0.0, 1.0);
            data.command[row][i] = bend * s * s + (1.0 - bend) * s;
        }
    }
    data.command_s = rows.time_s();
    data.remarks.push_back(fmt::format(
        "no actuator_motors: commands of {} motors are from {}, {}", ranges.size(), topic,
        share ? "0..1" : "PWM by the log's PWM_*_MIN and MAX, else 1000..2000 us"));
}

FlightData of_px4(const record::Recording& log) {
    FlightData data{.damage = log.damage, .remarks = log.remarks, .kind = "PX4 log"};
    const Rows sensors(log, "sensor_combined");
    for (std::size_t row = 0; row < sensors.count(); ++row) {
        data.rate_B_rad_s.push_back(sensors.each3("gyro_rad", row));
        data.specific_force_B_m_s2.push_back(sensors.each3(
            sensors.has("accelerometer_m_s2[0]") ? "accelerometer_m_s2" : "accelerometer_m_ss",
            row));
    }
    data.imu_s = sensors.count() > 0 ? sensors.time_s() : std::vector<double>{};
    if (const Rows motors(log, "actuator_motors"); motors.count() > 0) {
        add_commands(motors, "control", data);
    } else {
        add_outputs(log, data);
    }
    add_velocities(Rows(log, "vehicle_local_position"), Rows(log, "vehicle_attitude"), data);
    const Rows cup(log, "limpet_cup");
    for (std::size_t row = 0; row < cup.count(); ++row) {
        data.pressure.t_s.push_back(cup.time_s()[row]);
        data.pressure.pressure_Pa.push_back(cup.at("pressure_pa", row));
    }
    return data;
}

// --- a piece of it ---

template <class... Values>
void cut(const FlightSpan& span, std::vector<double>& time_s, std::vector<Values>&... values) {
    const auto first =
        std::lower_bound(time_s.begin(), time_s.end(), span.from_s.value_or(-1e300)) -
        time_s.begin();
    const auto last =
        std::upper_bound(time_s.begin(), time_s.end(), span.to_s.value_or(1e300)) - time_s.begin();
    const auto keep = [&](auto& list) {
        list = {list.begin() + first, list.begin() + std::max(first, last)};
    };
    (keep(values), ...);
    keep(time_s);
}

/// Loggers write what several threads say: a sample may come after one that is later.
record::Recording in_order(record::Recording recording) {
    constexpr double kMostBack_s = 1.0;
    for (Table& table : recording.tables) {
        if (const std::size_t late = put_in_order(table, kMostBack_s); late > 0) {
            recording.remarks.push_back(fmt::format("{}: {} sample{} out of order, put in {}",
                                                    table.topic, late, late == 1 ? "" : "s",
                                                    late == 1 ? "its place" : "their places"));
        }
    }
    return recording;
}

/// Times of a clock count from the first sample of all: fits keep their digits.
void count_from_first_sample(FlightData& data) {
    double first_s = std::numeric_limits<double>::infinity();
    const std::array lists = {&data.imu_s, &data.command_s, &data.velocity_s, &data.force_s,
                              &data.pressure.t_s};
    for (const std::vector<double>* list : lists) {
        first_s = list->empty() ? first_s : std::min(first_s, list->front());
    }
    if (!std::isfinite(first_s)) {
        return;
    }
    data.origin_s = clock_origin_s(first_s);
    for (std::vector<double>* list : lists) {
        for (double& time_s : *list) {
            time_s -= data.origin_s;
        }
    }
}

/// The fits walk from sample to sample: times rise, and not by more than an hour.
void require_in_order(const std::filesystem::path& path, const char* what,
                      const std::vector<double>& time_s) {
    constexpr double kLongestGap_s = 3600.0;
    for (std::size_t k = 1; k < time_s.size(); ++k) {
        const double step_s = time_s[k] - time_s[k - 1];
        if (!(step_s >= 0.0 && step_s <= kLongestGap_s)) {
            throw InputError(fmt::format(
                "{}: {} at {:.3f} s comes after one at {:.3f} s: times must rise, by an hour at "
                "most",
                path.string(), what, time_s[k], time_s[k - 1]));
        }
    }
}

}  // namespace

FlightData read_flight(const std::filesystem::path& path, const FlightSpan& requested) {
    std::string head(8, '\0');
    std::ifstream(path, std::ios::binary).read(head.data(), static_cast<std::streamsize>(8));
    const auto is = [&](std::string_view beginning, std::string_view extension) {
        return head.starts_with(beginning) || path.extension() == extension;
    };
    const bool ulog = is("ULog", ".ulg");
    const bool recorded = record::begins_as_recording(head) || path.extension() == ".mcap";
    FlightData data = recorded ? of_recording(in_order(record::read_recording(path)))
                      : ulog   ? of_px4(in_order(ulog::read_ulog(path)))
                               : read_flight_csv(path);
    require_in_order(path, "a sample of the IMU", data.imu_s);
    require_in_order(path, "a motor command", data.command_s);
    require_in_order(path, "a velocity", data.velocity_s);
    require_in_order(path, "a force", data.force_s);
    require_in_order(path, "a pressure", data.pressure.t_s);
    count_from_first_sample(data);
    FlightSpan span = requested;
    for (std::optional<double>* end_s : {&span.from_s, &span.to_s}) {
        if (*end_s) {
            *end_s = since_origin_s(**end_s, data.origin_s);
        }
    }
    cut(span, data.imu_s, data.rate_B_rad_s, data.specific_force_B_m_s2);
    cut(span, data.command_s, data.command);
    cut(span, data.velocity_s, data.velocity_B_m_s);
    cut(span, data.force_s, data.force_N);
    cut(span, data.pressure.t_s, data.pressure.pressure_Pa);
    return data;
}

}  // namespace limpet::identification
