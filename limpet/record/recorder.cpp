// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/recorder.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "limpet/core/frames.hpp"
#include "limpet/record/cdr.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/record/schema.hpp"

namespace limpet::record {
namespace {

using ros::flu_from_frd;

/// An array of any length: how many, then each.
template <class Element>
void put(Cdr& cdr, std::span<const EventValue> values, Element EventValue::*element) {
    cdr << static_cast<std::uint32_t>(values.size());
    for (const EventValue& value : values) {
        put(cdr, value.*element);
    }
}

struct EventValues {
    std::span<const EventValue> all;
};
void put(Cdr& cdr, EventValues values) {
    put(cdr, values.all, &EventValue::name);
    put(cdr, values.all, &EventValue::value);
}

/// Mode and numbers of a Setpoint message.
struct Motion {
    std::uint8_t mode = 0;
    Vector3 p = Vector3::Constant(kNaN);
    Vector3 v = Vector3::Constant(kNaN);
    Vector3 a = Vector3::Constant(kNaN);
    Euler angles{kNaN, kNaN, kNaN};
    double thrust = kNaN;
};

Motion motion(const IdleSetpoint&) {
    return {};
}

Motion motion(const PositionSetpoint& setpoint) {
    return {.mode = 1,
            .p = setpoint.p_W_m,
            .v = setpoint.feedforward_v_W_m_s,
            .angles = {kNaN, kNaN, setpoint.yaw_rad}};
}

Motion motion(const VelocitySetpoint& setpoint) {
    return {.mode = 2,
            .v = setpoint.v_W_m_s,
            .a = setpoint.feedforward_a_W_m_s2,
            .angles = {kNaN, kNaN, setpoint.yaw_rad}};
}

Motion motion(const AttitudeSetpoint& setpoint) {
    return {.mode = 3, .angles = euler_from_quaternion(setpoint.q_WB), .thrust = setpoint.thrust};
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& path, const RecordingInfo& info)
    : writer_(path, info.mirror, {.compress = info.compress}, info.topics),
      range_sensor_(info.range_sensor),
      rotors_(info.rotors) {
    mcap::StringMap about = info.numbers;
    about["scenario"] = info.scenario;
    if (info.seed) {
        about["seed"] = std::to_string(*info.seed);
    }
    about["version"] = info.version;
    writer_.file().add_metadata({"limpet", about});
    for (const mcap::Attachment& attachment : info.attachments) {
        writer_.add_attachment(attachment);
    }
    for (std::size_t i = 0; i < kTopics.size(); ++i) {
        channels_[i] = writer_.add_channel(kTopics[i].name, kTopics[i].type,
                                           ros2msg_schema(kTopics[i].type, info.rotors));
    }
    for (const ColumnChannel& own : info.columns) {
        columns_.push_back(
            {.channel = writer_.add_channel(own.topic, own.type, column_schema(own.columns))});
    }
    if (info.scene) {
        scene_.emplace(writer_, *info.scene);
    }
}

template <class... Fields>
void Recorder::write(Topic topic, double time_s, const Fields&... fields) {
    writer_.write_stamped(channels_[static_cast<std::size_t>(topic)], time_s, fields...);
}

std::span<const double> Recorder::each_rotor(const RotorList<double>& numbers) const {
    return {numbers.data(), rotors_};
}

void Recorder::write_columns(Columns& to, double time_s, std::span<const double> numbers) {
    writer_.write_stamped(to.channel, time_s, numbers);
    to.last_s = time_s;
}

void Recorder::imu(const Sample<ImuReading>& sample) {
    constexpr std::array<double, 9> kNotMeasured = {-1.0};  // a covariance, as the message says
    constexpr std::array<double, 9> kUnknown = {};
    write(Topic::imu, sample.time_s, kBaseFrame, Quaternion::Identity(), kNotMeasured,
          flu_from_frd(sample.value.rate_B_rad_s), kUnknown,
          flu_from_frd(sample.value.specific_force_B_m_s2), kUnknown);
}

void Recorder::range(Topic topic, std::string_view frame, const Sample<RangeReading>& sample) {
    constexpr std::uint8_t kInfrared = 1;
    constexpr float kNothing = std::numeric_limits<float>::infinity();
    constexpr float kVarianceUnknown = 0.0F;
    const auto& [distance_m, valid] = sample.value;
    write(topic, sample.time_s, frame, kInfrared,
          static_cast<float>(range_sensor_.field_of_view_rad),
          static_cast<float>(range_sensor_.minimum_m), static_cast<float>(range_sensor_.maximum_m),
          valid ? static_cast<float>(distance_m) : kNothing, kVarianceUnknown);
}

void Recorder::range_left(const Sample<RangeReading>& sample) {
    range(Topic::range_left, kLidarFrames[0], sample);
}

void Recorder::range_right(const Sample<RangeReading>& sample) {
    range(Topic::range_right, kLidarFrames[1], sample);
}

void Recorder::force(const Sample<ForceReading>& sample) {
    wrench(Topic::force, sample.time_s, kCarriageFrame, {{sample.value.axial_N, 0.0, 0.0}});
}

void Recorder::pressure(Topic topic, double time_s, std::string_view frame, double pressure_Pa) {
    constexpr double kVarianceUnknown = 0.0;
    write(topic, time_s, frame, pressure_Pa, kVarianceUnknown);
}

void Recorder::cup_pressure(const Sample<PressureReading>& sample) {
    pressure(Topic::cup_pressure, sample.time_s, kLipFrame, sample.value.pressure_Pa);
}

void Recorder::motion_capture(const Sample<PoseReading>& sample) {
    pose(Topic::motion_capture, sample.time_s, sample.value.p_WB_m, sample.value.q_WB);
}

void Recorder::barometer(const Sample<BarometerReading>& sample) {
    pressure(Topic::barometer, sample.time_s, kBaseFrame, sample.value.pressure_Pa);
}

void Recorder::magnetometer(const Sample<MagnetometerReading>& sample) {
    constexpr double kTesla_gauss = 1e-4;
    constexpr std::array<double, 9> kUnknown = {};
    write(Topic::magnetometer, sample.time_s, kBaseFrame,
          flu_from_frd(kTesla_gauss * sample.value.field_B_gauss), kUnknown);
}

void Recorder::gps(const Sample<GpsReading>& sample) {
    write(Topic::gps, sample.time_s, sample.value.p_WB_m, sample.value.v_WB_m_s);
}

void Recorder::battery(const Sample<BatteryReading>& sample) {
    constexpr std::uint8_t kDischarging = 2, kHealthUnknown = 0, kLithiumPolymer = 3;
    constexpr bool kPresent = true;
    constexpr std::uint32_t kNoCells = 0;
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    constexpr std::string_view kLocation, kSerialNumber;
    const BatteryReading& reading = sample.value;
    write(Topic::battery, sample.time_s, kBaseFrame, static_cast<float>(reading.voltage_V),
          kUnknown, static_cast<float>(-reading.current_A), kUnknown, kUnknown, kUnknown,
          static_cast<float>(reading.remaining), kDischarging, kHealthUnknown, kLithiumPolymer,
          kPresent, kNoCells, kNoCells, kLocation, kSerialNumber);
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
    when_new(readings.magnetometer, last.magnetometer, &Recorder::magnetometer);
    when_new(readings.gps, last.gps, &Recorder::gps);
    when_new(readings.battery, last.battery, &Recorder::battery);
}

void Recorder::pose(Topic topic, double time_s, const Vector3& p_WB_m, const Quaternion& q_WB) {
    write(topic, time_s, kMapFrame, ros::enu_from_ned(p_WB_m), ros::enu_flu_from_ned_frd(q_WB));
}

void Recorder::twist(Topic topic, double time_s, const Quaternion& q_WB, const Vector3& v_WB_W_m_s,
                     const Vector3& w_WB_B_rad_s) {
    write(topic, time_s, kBaseFrame, flu_from_frd(q_WB.conjugate() * v_WB_W_m_s),
          flu_from_frd(w_WB_B_rad_s));
}

void Recorder::wrench(Topic topic, double time_s, std::string_view frame, const Wrench& wrench) {
    write(topic, time_s, frame, flu_from_frd(wrench.force_N), flu_from_frd(wrench.moment_N_m));
}

void Recorder::truth(const Truth& truth) {
    const double t = truth.time_s;
    const auto& [p_W_m, q_WB, v_W_m_s, w_B_rad_s] = truth.base;
    pose(Topic::truth_pose, t, p_W_m, q_WB);
    twist(Topic::truth_twist, t, q_WB, v_W_m_s, w_B_rad_s);

    const SliderStatus& slider = truth.slider;
    const BatteryStatus& power = truth.battery;
    const CupAngles cup_joint = cup_angles(truth);
    write(Topic::truth_vehicle, t, euler_from_quaternion(q_WB), v_W_m_s, w_B_rad_s,
          slider.position_m, slider.velocity_m_s, slider.force_N, cup_joint.pitch_rad,
          cup_joint.yaw_rad, truth.legs_force_W_N, each_rotor(truth.rotor_speed_rad_s),
          truth.thrust_N, power.voltage_V, power.current_A, power.energy_used_J, power.remaining);

    const CupStatus& cup = truth.cup_status;
    write(Topic::cup, t, static_cast<std::uint8_t>(cup.phase), cup.pump_running, cup.valve_open,
          cup.pressure_Pa, cup.pull_N, cup.shear_N, cup.peel_N_m, cup.gap_m, cup.pull_margin_N,
          cup.shear_margin_N, cup.peel_margin_N, cup.seal_threshold_N);
    wrench(Topic::truth_cup_wrench, t, kLipFrame, cup.wrench_C);
    if (scene_) {
        scene_->move(truth);
    }
}

void Recorder::scene(const Truth& truth, const Readings& readings, const Setpoint& setpoint) {
    if (scene_) {
        scene_->mark(truth, readings, setpoint);
    }
}

void Recorder::estimate(const Estimate& estimate) {
    pose(Topic::estimate_pose, estimate.time_s, estimate.p_WB_m, estimate.q_WB);
    twist(Topic::estimate_twist, estimate.time_s, estimate.q_WB, estimate.v_WB_m_s,
          estimate.w_WB_B_rad_s);
    if (estimate.variance[0] > 0.0) {  // of a PX4's filter none is known
        std::array<Vector3, 5> deviation;
        for (std::size_t i = 0; i < estimate.variance.size(); ++i) {
            deviation[i / 3][static_cast<Eigen::Index>(i % 3)] = std::sqrt(estimate.variance[i]);
        }
        write(Topic::estimate_deviation, estimate.time_s, deviation[0], deviation[1], deviation[2],
              deviation[3], deviation[4]);
    }
}

void Recorder::consistency(const Consistency& consistency) {
    write(Topic::estimate_consistency, consistency.time_s, consistency.nees, consistency.nees_of,
          consistency.nis_of);
}

void Recorder::setpoint(double time_s, const Setpoint& setpoint) {
    const Motion m = std::visit([](const auto& each) { return motion(each); }, setpoint.motion);
    write(Topic::setpoint, time_s, m.mode, setpoint.armed, setpoint.pump_on, setpoint.valve_open,
          setpoint.hold_integrators, m.p, m.v, m.a, m.angles, m.thrust);
}

void Recorder::guidance(double time_s, std::string_view state, int attempt) {
    write(Topic::guidance, time_s, state, attempt);
}

void Recorder::rotor_command(double time_s, const RotorCommand& command) {
    write(Topic::rotor_command, time_s, each_rotor(command.command), command.armed);
}

void Recorder::event(const Event& event) {
    write(Topic::events, event.time_s, event.station, to_string(event.name), event.reason,
          EventValues{std::span(event.values).first(event.value_count)});
}

void Recorder::finish(const std::string& summary_json) {
    writer_.file().add_attachment(
        {.name = "summary.json",
         .media_type = "application/json",
         .text = summary_json,
         .log_time_ns = static_cast<std::uint64_t>(writer_.last_time_ns())});
    writer_.file().close();
}

}  // namespace limpet::record
