// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/messages.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <type_traits>

#include "limpet/core/errors.hpp"
#include "limpet/record/ros_frames.hpp"

namespace limpet::record::messages {
namespace {

namespace fastcdr = eprosima::fastcdr;

constexpr std::size_t kMaxText = 256;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Vector3 (*kFlu)(const Vector3&) = &ros::flu_from_frd;
constexpr Vector3 (*kEnu)(const Vector3&) = &ros::enu_from_ned;

/// One message: encapsulation first, then fields in the order of their definition.
class Writer {
public:
    explicit Writer(Buffer& buffer)
        : buffer_(clean(buffer)),
          stream_(buffer.bytes.data(), buffer.bytes.size()),
          cdr_(stream_, fastcdr::Cdr::LITTLE_ENDIANNESS, fastcdr::Cdr::DDS_CDR) {
        cdr_.serialize_encapsulation();
    }

    Writer& stamp(std::int64_t time_ns) {
        constexpr std::int64_t kSecond_ns = 1'000'000'000;
        cdr_ << static_cast<std::int32_t>(time_ns / kSecond_ns)
             << static_cast<std::uint32_t>(time_ns % kSecond_ns);
        return *this;
    }

    Writer& header(std::int64_t time_ns, std::string_view frame) {
        return stamp(time_ns).text(frame);
    }

    Writer& text(std::string_view text) {
        require(text.size() <= kMaxText, "a recorded text has at most 256 characters");
        cdr_ << static_cast<std::uint32_t>(text.size() + 1);
        cdr_.serializeArray(text.data(), text.size());
        cdr_ << '\0';
        return *this;
    }

    Writer& length(std::size_t count) {
        cdr_ << static_cast<std::uint32_t>(count);
        return *this;
    }

    Writer& numbers(std::span<const double> values) {
        cdr_.serializeArray(values.data(), values.size());
        return *this;
    }
    Writer& numbers(std::initializer_list<double> values) {
        return numbers(std::span(values.begin(), values.size()));
    }

    Writer& floats(std::initializer_list<double> values) {
        for (const double value : values) {
            cdr_ << static_cast<float>(value);
        }
        return *this;
    }

    /// uint8 and bool alike.
    Writer& octets(std::initializer_list<int> values) {
        for (const int value : values) {
            cdr_ << static_cast<std::uint8_t>(value);
        }
        return *this;
    }

    Writer& vector(const Vector3& v) { return numbers({v.x(), v.y(), v.z()}); }

    /// ROS puts w last.
    Writer& quaternion(const Quaternion& q) { return numbers({q.x(), q.y(), q.z(), q.w()}); }

    Writer& integer(int value) {
        cdr_ << static_cast<std::int32_t>(value);
        return *this;
    }

    [[nodiscard]] Encoded done() {
        buffer_.used = cdr_.getSerializedDataLength();
        return {reinterpret_cast<const std::uint8_t*>(buffer_.bytes.data()), buffer_.used};
    }

private:
    /// Fast-CDR skips the bytes that align the next value; they must not carry the last message.
    static Buffer& clean(Buffer& buffer) {
        std::fill_n(buffer.bytes.begin(), buffer.used, '\0');
        return buffer;
    }

    Buffer& buffer_;
    fastcdr::FastBuffer stream_;
    fastcdr::Cdr cdr_;
};

/// Mode and numbers of a Setpoint message.
struct Motion {
    int mode = 0;
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
    Motion m{.mode = 1, .p = setpoint.p_W_m, .v = setpoint.feedforward_v_W_m_s};
    m.angles.yaw_rad = setpoint.yaw_rad;
    return m;
}

Motion motion(const VelocitySetpoint& setpoint) {
    Motion m{.mode = 2, .v = setpoint.v_W_m_s, .a = setpoint.feedforward_a_W_m_s2};
    m.angles.yaw_rad = setpoint.yaw_rad;
    return m;
}

Motion motion(const AttitudeSetpoint& setpoint) {
    return {.mode = 3, .angles = euler_from_quaternion(setpoint.q_WB), .thrust = setpoint.thrust};
}

/// Of the joint between body and cup.
struct JointAngles {
    double pitch_rad = 0.0;
    double yaw_rad = 0.0;
};

/// @param q_BC  a turn about y, then about the turned z
JointAngles joint_angles(const Quaternion& q_BC) {
    const Vector3 mouth_B = q_BC * Vector3::UnitX();
    return {.pitch_rad = std::atan2(-mouth_B.z(), mouth_B.x()),
            .yaw_rad = std::asin(std::clamp(mouth_B.y(), -1.0, 1.0))};
}

}  // namespace

Encoded imu(Buffer& buffer, std::int64_t time_ns, const ImuReading& reading) {
    constexpr double kNotMeasured = -1.0;  // first element of a covariance, as the message says
    return Writer(buffer)
        .header(time_ns, "base_link")
        .quaternion(Quaternion::Identity())
        .numbers({kNotMeasured, 0, 0, 0, 0, 0, 0, 0, 0})
        .vector(kFlu(reading.rate_B_rad_s))
        .numbers({0, 0, 0, 0, 0, 0, 0, 0, 0})
        .vector(kFlu(reading.specific_force_B_m_s2))
        .numbers({0, 0, 0, 0, 0, 0, 0, 0, 0})
        .done();
}

Encoded range(Buffer& buffer, std::int64_t time_ns, std::string_view frame,
              const RangeSensor& sensor, const RangeReading& reading) {
    constexpr int kInfrared = 1;
    constexpr double kNothing = std::numeric_limits<double>::infinity();
    return Writer(buffer)
        .header(time_ns, frame)
        .octets({kInfrared})
        .floats({sensor.field_of_view_rad, sensor.minimum_m, sensor.maximum_m,
                 reading.valid ? reading.distance_m : kNothing, 0.0})
        .done();
}

Encoded pressure(Buffer& buffer, std::int64_t time_ns, std::string_view frame, double pressure_Pa) {
    constexpr double kVarianceUnknown = 0.0;
    return Writer(buffer).header(time_ns, frame).numbers({pressure_Pa, kVarianceUnknown}).done();
}

Encoded battery(Buffer& buffer, std::int64_t time_ns, const BatteryReading& reading) {
    constexpr int kDischarging = 2, kHealthUnknown = 0, kLithiumPolymer = 3, kPresent = 1;
    return Writer(buffer)
        .header(time_ns, "base_link")
        .floats({reading.voltage_V, kNaN, -reading.current_A, kNaN, kNaN, kNaN, reading.remaining})
        .octets({kDischarging, kHealthUnknown, kLithiumPolymer, kPresent})
        .length(0)  // cell voltages
        .length(0)  // cell temperatures
        .text("")   // location
        .text("")   // serial number
        .done();
}

Encoded pose(Buffer& buffer, std::int64_t time_ns, const Vector3& p_WB_m, const Quaternion& q_WB) {
    return Writer(buffer)
        .header(time_ns, "map")
        .vector(kEnu(p_WB_m))
        .quaternion(ros::enu_flu_from_ned_frd(q_WB))
        .done();
}

Encoded twist(Buffer& buffer, std::int64_t time_ns, const Quaternion& q_WB,
              const Vector3& v_WB_W_m_s, const Vector3& w_WB_B_rad_s) {
    return Writer(buffer)
        .header(time_ns, "base_link")
        .vector(kFlu(q_WB.conjugate() * v_WB_W_m_s))
        .vector(kFlu(w_WB_B_rad_s))
        .done();
}

Encoded wrench(Buffer& buffer, std::int64_t time_ns, std::string_view frame, const Wrench& wrench) {
    return Writer(buffer)
        .header(time_ns, frame)
        .vector(kFlu(wrench.force_N))
        .vector(kFlu(wrench.moment_N_m))
        .done();
}

Encoded vehicle_truth(Buffer& buffer, std::int64_t time_ns, const Truth& truth) {
    const Euler angles = euler_from_quaternion(truth.base.q_WF);
    const SliderStatus& slider = truth.slider;
    const auto& w = truth.rotor_speed_rad_s;
    const BatteryStatus& power = truth.battery;
    const JointAngles joint = joint_angles(truth.base.q_WF.conjugate() * truth.cup.q_WF);
    return Writer(buffer)
        .stamp(time_ns)
        .numbers({angles.roll_rad, angles.pitch_rad, angles.yaw_rad})
        .vector(truth.base.v_WF_W_m_s)
        .vector(truth.base.w_WF_F_rad_s)
        .numbers({slider.position_m, slider.velocity_m_s, slider.force_N})
        .numbers({joint.pitch_rad, joint.yaw_rad})
        .vector(truth.legs_force_W_N)
        .numbers({w[0], w[1], w[2], w[3], truth.thrust_N})
        .numbers({power.voltage_V, power.current_A, power.energy_used_J, power.remaining})
        .done();
}

Encoded cup_state(Buffer& buffer, std::int64_t time_ns, const CupStatus& status) {
    return Writer(buffer)
        .stamp(time_ns)
        .octets({static_cast<int>(status.phase), status.pump_running, status.valve_open})
        .numbers({status.pressure_Pa, status.pull_N, status.shear_N, status.peel_N_m, status.gap_m,
                  status.pull_margin_N, status.shear_margin_N, status.peel_margin_N,
                  status.seal_threshold_N})
        .done();
}

Encoded setpoint(Buffer& buffer, std::int64_t time_ns, const Setpoint& setpoint) {
    const Motion m = std::visit([](const auto& asked) { return motion(asked); }, setpoint.motion);
    return Writer(buffer)
        .stamp(time_ns)
        .octets({m.mode, setpoint.armed, setpoint.pump_on, setpoint.valve_open,
                 setpoint.hold_integrators})
        .vector(m.p)
        .vector(m.v)
        .vector(m.a)
        .numbers({m.angles.roll_rad, m.angles.pitch_rad, m.angles.yaw_rad, m.thrust})
        .done();
}

Encoded guidance_state(Buffer& buffer, std::int64_t time_ns, std::string_view state, int attempt) {
    return Writer(buffer).stamp(time_ns).text(state).integer(attempt).done();
}

Encoded rotor_command(Buffer& buffer, std::int64_t time_ns, const RotorCommand& command) {
    const auto& c = command.command;
    return Writer(buffer)
        .stamp(time_ns)
        .numbers({c[0], c[1], c[2], c[3]})
        .octets({command.armed})
        .done();
}

Encoded columns(Buffer& buffer, std::int64_t time_ns, std::span<const double> numbers) {
    return Writer(buffer).stamp(time_ns).numbers(numbers).done();
}

Encoded event(Buffer& buffer, std::int64_t time_ns, const Event& event) {
    Writer writer(buffer);
    writer.stamp(time_ns).text(event.station).text(to_string(event.name)).text(event.reason);
    writer.length(event.value_count);
    for (std::size_t i = 0; i < event.value_count; ++i) {
        writer.text(event.values[i].name);
    }
    writer.length(event.value_count);
    for (std::size_t i = 0; i < event.value_count; ++i) {
        writer.numbers({event.values[i].value});
    }
    return writer.done();
}

}  // namespace limpet::record::messages
