// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "limpet/core/errors.hpp"
#include "limpet/record/message_definitions.hpp"

namespace limpet::record {
namespace {

/// @throws InternalError for a time before 0: a sample that never came is not recorded
std::int64_t nanoseconds(double time_s) {
    require(time_s >= 0.0 && time_s < 1e9, "recorded times are 0 or later, and finite");
    return std::llround(time_s * 1e9);
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& path, const RecordingInfo& info)
    : writer_(path), range_sensor_(info.range_sensor) {
    mcap::StringMap about = info.numbers;
    about["scenario"] = info.scenario;
    if (info.seed) {
        about["seed"] = std::to_string(*info.seed);
    }
    about["version"] = info.version;
    writer_.add_metadata({"limpet", about});
    for (const mcap::Attachment& attachment : info.attachments) {
        writer_.add_attachment(attachment);
    }
    add_channels(info.columns);
}

void Recorder::add_channels(const std::vector<ColumnChannel>& columns) {
    std::map<std::string_view, std::uint16_t> schemas;
    for (std::size_t i = 0; i < kTopics.size(); ++i) {
        const auto& [name, type] = kTopics[i];
        if (schemas.count(type) == 0) {
            schemas[type] = writer_.add_schema(type, "ros2msg", ros2msg_schema(type));
        }
        channels_[i] = add_channel(name, schemas[type]);
    }
    for (const ColumnChannel& own : columns) {
        const std::string schema = column_schema(own.columns);
        columns_.push_back(
            {.channel = add_channel(own.topic, writer_.add_schema(own.type, "ros2msg", schema))});
    }
}

std::uint16_t Recorder::add_channel(std::string_view topic, std::uint16_t schema) {
    // The profile "ros2" wants the key; empty means the player's default.
    return writer_.add_channel(schema, topic, "cdr", {{"offered_qos_profiles", ""}});
}

void Recorder::write_columns(Columns& to, double time_s, std::span<const double> numbers) {
    const std::int64_t t = nanoseconds(time_s);
    write(to.channel, t, messages::columns(buffer_, t, numbers));
    to.last_s = time_s;
}

void Recorder::write(Topic topic, std::int64_t time_ns, messages::Encoded message) {
    write(channels_[static_cast<std::size_t>(topic)], time_ns, message);
}

void Recorder::write(std::uint16_t channel, std::int64_t time_ns, messages::Encoded message) {
    writer_.write(channel, static_cast<std::uint64_t>(time_ns), message);
    last_time_ns_ = std::max(last_time_ns_, time_ns);
}

void Recorder::imu(const Sample<ImuReading>& sample) {
    const std::int64_t t = nanoseconds(sample.time_s);
    write(Topic::imu, t, messages::imu(buffer_, t, sample.value));
}

void Recorder::range_left(const Sample<RangeReading>& sample) {
    const std::int64_t t = nanoseconds(sample.time_s);
    write(Topic::range_left, t,
          messages::range(buffer_, t, "lidar_left", range_sensor_, sample.value));
}

void Recorder::range_right(const Sample<RangeReading>& sample) {
    const std::int64_t t = nanoseconds(sample.time_s);
    write(Topic::range_right, t,
          messages::range(buffer_, t, "lidar_right", range_sensor_, sample.value));
}

void Recorder::force(const Sample<ForceReading>& sample) {
    const std::int64_t t = nanoseconds(sample.time_s);
    const Wrench along_slider{.force_N = {sample.value.axial_N, 0.0, 0.0}};
    write(Topic::force, t, messages::wrench(buffer_, t, "carriage", along_slider));
}

void Recorder::cup_pressure(const Sample<PressureReading>& sample) {
    const std::int64_t t = nanoseconds(sample.time_s);
    write(Topic::cup_pressure, t, messages::pressure(buffer_, t, "cup", sample.value.pressure_Pa));
}

void Recorder::motion_capture(const Sample<PoseReading>& sample) {
    const std::int64_t t = nanoseconds(sample.time_s);
    write(Topic::motion_capture, t,
          messages::pose(buffer_, t, sample.value.p_WB_m, sample.value.q_WB));
}

void Recorder::barometer(const Sample<BarometerReading>& sample) {
    const std::int64_t t = nanoseconds(sample.time_s);
    write(Topic::barometer, t,
          messages::pressure(buffer_, t, "base_link", sample.value.pressure_Pa));
}

void Recorder::battery(const Sample<BatteryReading>& sample) {
    const std::int64_t t = nanoseconds(sample.time_s);
    write(Topic::battery, t, messages::battery(buffer_, t, sample.value));
}

void Recorder::new_readings(const Readings& readings, Readings& last) {
    const auto when_new = [&](const auto& sample, auto& before, auto record) {
        if (sample.newer_than(before)) {
            (this->*record)(sample);
            before.time_s = sample.time_s;
        }
    };
    when_new(readings.imu, last.imu, &Recorder::imu);
    when_new(readings.lidar_left, last.lidar_left, &Recorder::range_left);
    when_new(readings.lidar_right, last.lidar_right, &Recorder::range_right);
    when_new(readings.force, last.force, &Recorder::force);
    when_new(readings.cup_pressure, last.cup_pressure, &Recorder::cup_pressure);
    when_new(readings.motion_capture, last.motion_capture, &Recorder::motion_capture);
    when_new(readings.barometer, last.barometer, &Recorder::barometer);
    when_new(readings.battery, last.battery, &Recorder::battery);
}

void Recorder::truth(const Truth& truth) {
    const std::int64_t t = nanoseconds(truth.time_s);
    const Kinematics& base = truth.base;
    write(Topic::truth_pose, t, messages::pose(buffer_, t, base.p_WF_m, base.q_WF));
    write(Topic::truth_twist, t,
          messages::twist(buffer_, t, base.q_WF, base.v_WF_W_m_s, base.w_WF_F_rad_s));
    write(Topic::truth_vehicle, t, messages::vehicle_truth(buffer_, t, truth));
    write(Topic::cup, t, messages::cup_state(buffer_, t, truth.cup_status));
    write(Topic::truth_cup_wrench, t,
          messages::wrench(buffer_, t, "cup", truth.cup_status.wrench_C));
}

void Recorder::estimate(const Estimate& estimate) {
    const std::int64_t t = nanoseconds(estimate.time_s);
    write(Topic::estimate_pose, t, messages::pose(buffer_, t, estimate.p_WB_m, estimate.q_WB));
    write(Topic::estimate_twist, t,
          messages::twist(buffer_, t, estimate.q_WB, estimate.v_WB_m_s, estimate.w_WB_B_rad_s));
}

void Recorder::setpoint(double time_s, const Setpoint& setpoint) {
    const std::int64_t t = nanoseconds(time_s);
    write(Topic::setpoint, t, messages::setpoint(buffer_, t, setpoint));
}

void Recorder::guidance(double time_s, std::string_view state, int attempt) {
    const std::int64_t t = nanoseconds(time_s);
    write(Topic::guidance, t, messages::guidance_state(buffer_, t, state, attempt));
}

void Recorder::rotor_command(double time_s, const RotorCommand& command) {
    const std::int64_t t = nanoseconds(time_s);
    write(Topic::rotor_command, t, messages::rotor_command(buffer_, t, command));
}

void Recorder::event(const Event& event) {
    const std::int64_t t = nanoseconds(event.time_s);
    write(Topic::events, t, messages::event(buffer_, t, event));
}

void Recorder::finish(const std::string& summary_json) {
    writer_.add_attachment({.name = "summary.json",
                            .media_type = "application/json",
                            .text = summary_json,
                            .log_time_ns = static_cast<std::uint64_t>(last_time_ns_)});
    writer_.close();
}

}  // namespace limpet::record
