// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/flight_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "limpet/core/clock_origin.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/identification/csv_line.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/record/ulog_reader.hpp"

namespace limpet::identification {
namespace {

using record::Table;

/// Columns of a table that may not be there.
class Rows {
public:
    Rows(const record::Recording& recording, std::string_view topic)
        : table_(find_by(recording.tables, &Table::topic, topic)) {}
    [[nodiscard]] std::size_t count() const {
        return table_ == nullptr ? 0 : table_->time_s.size();
    }
    [[nodiscard]] const std::vector<double>& time_s() const { return table_->time_s; }
    [[nodiscard]] bool has(std::string_view column) const {
        return table_ != nullptr && table_->find(column) != nullptr;
    }
    [[nodiscard]] double at(std::string_view column, std::size_t row) const {
        const record::Column* found = table_->find(column);
        return found == nullptr ? kNaN : found->values[row];
    }
    [[nodiscard]] Vector3 xyz(const std::string& path, std::size_t row) const {
        return {at(path + ".x", row), at(path + ".y", row), at(path + ".z", row)};
    }
    [[nodiscard]] Vector3 each3(const std::string& path, std::size_t row) const {
        return {at(path + "[0]", row), at(path + "[1]", row), at(path + "[2]", row)};
    }

private:
    const Table* table_;
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
    FlightData data{.damage = recording.damage, .kind = "recording"};
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

FlightData of_px4(const record::Recording& log) {
    FlightData data{.damage = log.damage, .kind = "PX4 log"};
    const Rows sensors(log, "sensor_combined");
    for (std::size_t row = 0; row < sensors.count(); ++row) {
        data.rate_B_rad_s.push_back(sensors.each3("gyro_rad", row));
        data.specific_force_B_m_s2.push_back(sensors.each3(
            sensors.has("accelerometer_m_s2[0]") ? "accelerometer_m_s2" : "accelerometer_m_ss",
            row));
    }
    data.imu_s = sensors.count() > 0 ? sensors.time_s() : std::vector<double>{};
    add_commands(Rows(log, "actuator_motors"), "control", data);
    add_velocities(Rows(log, "vehicle_local_position"), Rows(log, "vehicle_attitude"), data);
    const Rows cup(log, "limpet_cup");
    for (std::size_t row = 0; row < cup.count(); ++row) {
        data.pressure.t_s.push_back(cup.time_s()[row]);
        data.pressure.pressure_Pa.push_back(cup.at("pressure_pa", row));
    }
    return data;
}

// --- CSV -----------------------------------------------------------------------------------------

/// Where columns are; what is not there is past the end.
struct CsvColumns {
    std::vector<std::string> names;
    char separator = ',';
    [[nodiscard]] std::size_t of(const std::string& name) const {
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                        names.begin());
    }
    [[nodiscard]] bool has(const std::string& name) const { return of(name) < names.size(); }
};

/// A row's cell: nothing where it is empty.
std::optional<double> cell(const CsvLine& line, const CsvColumns& columns,
                           const std::vector<std::string_view>& fields, const std::string& name) {
    const std::size_t at = columns.of(name);
    if (at >= fields.size() || fields[at].empty()) {
        return std::nullopt;
    }
    const auto value = number_in(fields[at], columns.separator);
    if (!value) {
        line.refuse("{} is {}, not a finite number", name, in_quotes(fields[at]));
    }
    return value;
}

/// All three or none.
std::optional<Vector3> three(const CsvLine& line, const CsvColumns& columns,
                             const std::vector<std::string_view>& fields, const char* pattern) {
    Vector3 v;
    int there = 0;
    for (int i = 0; i < 3; ++i) {
        const std::string name = fmt::format(fmt::runtime(pattern), "xyz"[i]);
        if (const auto value = cell(line, columns, fields, name)) {
            v[i] = *value;
            ++there;
        }
    }
    if (there > 0 && there < 3) {
        line.refuse("{} of the three {} are there", there, fmt::format(fmt::runtime(pattern), '*'));
    }
    return there == 3 ? std::optional(v) : std::nullopt;
}

void add_row(const CsvLine& line, const CsvColumns& columns, FlightData& data, double& last_s) {
    const auto fields = csv_fields(line.text, columns.separator);
    if (fields.size() != columns.names.size()) {
        line.refuse("{} fields, the header has {}", fields.size(), columns.names.size());
    }
    const auto time_s = cell(line, columns, fields, "t_s");
    if (!time_s || *time_s <= last_s) {
        line.refuse("t_s must be there and rise");
    }
    last_s = *time_s;
    const auto gyro = three(line, columns, fields, "gyro_{}_rad_s");
    const auto accelerometer = three(line, columns, fields, "accel_{}_m_s2");
    if (gyro) {
        data.imu_s.push_back(last_s);
        data.rate_B_rad_s.push_back(*gyro);
        data.specific_force_B_m_s2.push_back(accelerometer.value_or(Vector3::Constant(kNaN)));
    }
    if (const auto first = cell(line, columns, fields, "command_0")) {
        RotorList<double> command(1, *first);
        for (std::size_t i = 1; i < kMaxRotors; ++i) {
            const auto next = cell(line, columns, fields, fmt::format("command_{}", i));
            if (!next) {
                break;
            }
            command.resize(i + 1, *next);
        }
        data.command_s.push_back(last_s);
        data.command.push_back(command);
    }
    if (const auto velocity = three(line, columns, fields, "velocity_{}_m_s")) {
        data.velocity_s.push_back(last_s);
        data.velocity_B_m_s.push_back(*velocity);
    }
    if (const auto force = cell(line, columns, fields, "force_N")) {
        data.force_s.push_back(last_s);
        data.force_N.push_back(*force);
    }
    if (const auto pressure = cell(line, columns, fields, "pressure_Pa")) {
        data.pressure.t_s.push_back(last_s);
        data.pressure.pressure_Pa.push_back(*pressure);
    }
}

FlightData of_csv(const std::filesystem::path& path) {
    FlightData data{.kind = "CSV"};
    std::istringstream text(read_file(path, {"flight log", 500}));
    CsvColumns columns;
    double last_s = -std::numeric_limits<double>::infinity();
    for_each_csv_line(text, path.string(), [&](const CsvLine& line) {
        if (!columns.names.empty()) {
            add_row(line, columns, data, last_s);
            return;
        }
        columns.separator = separator_of(line.text);
        for (const std::string_view field : csv_fields(line.text, columns.separator)) {
            columns.names.emplace_back(field);
        }
        if (!columns.has("t_s")) {
            line.refuse(
                "no column \"t_s\": is this a log? An MCAP recording, a PX4 log (.ulg) or "
                "CSV with t_s and gyro_x_rad_s, command_0, force_N, pressure_Pa ...");
        }
    });
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

FlightData read_flight(const std::filesystem::path& path, const FlightSpan& asked) {
    std::string head(8, '\0');
    std::ifstream(path, std::ios::binary).read(head.data(), static_cast<std::streamsize>(8));
    const auto is = [&](std::string_view beginning, std::string_view extension) {
        return head.starts_with(beginning) || path.extension() == extension;
    };
    FlightData data = is("\x89MCAP", ".mcap") ? of_recording(record::read_recording(path))
                      : is("ULog", ".ulg")    ? of_px4(record::read_ulog(path))
                                              : of_csv(path);
    require_in_order(path, "a sample of the IMU", data.imu_s);
    require_in_order(path, "a motor command", data.command_s);
    require_in_order(path, "a velocity", data.velocity_s);
    require_in_order(path, "a force", data.force_s);
    require_in_order(path, "a pressure", data.pressure.t_s);
    count_from_first_sample(data);
    FlightSpan span = asked;
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
