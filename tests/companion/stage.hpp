// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "limpet/mavlink/link.hpp"
#include "limpet/mavlink/mechanism.hpp"
#include "limpet/mavlink/mission_report.hpp"
#include "limpet/mavlink/status_text.hpp"
#include "limpet/mavlink/translate.hpp"
#include "tests/guidance/puppet.hpp"

namespace limpet::companion {

/// What the autopilot's end has heard.
struct HeardByAutopilot {
    int set_points = 0;
    int poses = 0;
    int origins = 0;  ///< given to it
    int heartbeats = 0;
    int holds = 0;      ///< AUTO.LOITER asked for
    int offboards = 0;  ///< OFFBOARD asked for
    int arms = 0;
    int disarms = 0;
    int frames = 0;
    int drops = 0;  ///< no thrust asked for in free flight
};

/// What the sensors' end has heard.
struct HeardBySensors {
    int commands = 0;
    int frames = 0;
    bool over = false;  ///< the companion's last heartbeat
    std::string outcome;
    std::vector<EventName> events;
};

/// The outside of a companion, in this process and over real loopback sockets: an autopilot with
/// PX4's manners as far as a companion sees them, sensors, a mechanism, and a vehicle on strings.
class Stage {
public:
    static constexpr std::uint32_t kOffboard = 6U << 16U;
    static constexpr std::uint32_t kLoiter = (4U << 16U) | (3U << 24U);
    static constexpr std::uint32_t kPosition = 3U << 16U;

    Stage(const wire::TransportAddress& autopilot_address,
          const wire::TransportAddress& sensors_address)
        : autopilot_(open_transport(autopilot_address, wire::Role::connect),
                     {1, mavlink::kAutopilotComponent}),
          sensors_(open_transport(sensors_address, wire::Role::connect),
                   {1, mavlink::kMechanismComponent}) {}

    guidance::Puppet puppet;
    HeardByAutopilot autopilot;
    HeardBySensors sensors;
    std::uint32_t mode = kPosition;
    bool armed = false;
    std::uint8_t landed_state = 1;
    mavlink::MechanismCommand mechanism;
    Setpoint setpoint;

    // what is broken
    bool beats = true;
    bool tells_pose = true;
    bool motion_capture_works = true;
    bool mechanism_answers = true;
    bool obeys_mode = true;
    bool obeys_arming = true;
    std::map<std::string, double> parameters;  ///< that it reports
    bool has_origin = true;                    ///< and tells it when it is asked
    Vector3 motion_capture_off_m = Vector3::Zero();
    double motion_capture_turned_rad = 0.0;
    Vector3 estimate_drift_m_s = Vector3::Zero();  ///< of tracker and estimate, not of the vehicle

    /// Puppet::kDt_s of the world: hears, moves, tells.
    void step() {
        hear();
        puppet.memory.setpoint = followed();
        puppet.step_world();
        drifted_m_ += estimate_drift_m_s * guidance::Puppet::kDt_s;
        tell();
    }

    void sign_autopilot(const mavlink::LinkSigning& signing) { autopilot_.sign(signing); }
    [[nodiscard]] double time_s() const { return puppet.time_s; }

private:
    [[nodiscard]] Setpoint followed() const {
        const bool flies = armed && mode == kOffboard;
        Setpoint now = flies ? setpoint : Setpoint{.motion = standing()};
        now.pump_on = mechanism.pump_on;
        now.valve_open = mechanism.valve_open;
        return now;
    }
    /// Without us: stays where it is, as it is.
    [[nodiscard]] decltype(Setpoint::motion) standing() const {
        if (euler_from_quaternion(puppet.estimate.q_WB).pitch_rad > 0.1) {
            return AttitudeSetpoint{.q_WB = puppet.estimate.q_WB};
        }
        return PositionSetpoint{.p_W_m = puppet.estimate.p_WB_m, .yaw_rad = puppet.yaw_rad};
    }

    void hear() {
        while (const auto frame = autopilot_.receive()) {
            ++autopilot.frames;
            hear_autopilot(*frame);
        }
        while (const auto frame = sensors_.receive()) {
            ++sensors.frames;
            hear_sensors(*frame);
        }
    }

    void hear_autopilot(const mavlink::Frame& frame) {
        if (const auto target = mavlink::decode<mavlink::SetPositionTargetLocalNed>(frame)) {
            ++autopilot.set_points;
            if (const auto position = mavlink::position_set_point(*target)) {
                setpoint.motion = *position;
            } else if (const auto velocity = mavlink::velocity_set_point(*target)) {
                setpoint.motion = *velocity;
            }
        } else if (const auto attitude = mavlink::decode<mavlink::SetAttitudeTarget>(frame)) {
            ++autopilot.set_points;
            if (const auto aim = mavlink::attitude_set_point(*attitude)) {
                setpoint.motion = *aim;
                const bool free = puppet.estimate.p_WB_m.x() < guidance::Puppet::kWall_m - 0.6;
                autopilot.drops += armed && landed_state == 2 && free && aim->thrust <= 0.0;
            }
        } else if (const auto command = mavlink::decode<mavlink::CommandLong>(frame)) {
            obey(*command);
        } else if (mavlink::decode<mavlink::Odometry>(frame)) {
            ++autopilot.poses;
        } else if (mavlink::decode<mavlink::SetGpsGlobalOrigin>(frame)) {
            ++autopilot.origins;
        } else if (const auto asked = mavlink::decode<mavlink::ParamRequestRead>(frame)) {
            const std::string name(mavlink::text_of(asked->param_id));
            if (const auto has = parameters.find(name); has != parameters.end()) {
                mavlink::ParamValue value{.param_value = static_cast<float>(has->second),
                                          .param_type = mavlink::MavParamType::real32};
                value.param_id = asked->param_id;
                (void)autopilot_.send(value);
            }
        } else if (mavlink::decode<mavlink::Heartbeat>(frame)) {
            ++autopilot.heartbeats;
        }
    }

    void obey(const mavlink::CommandLong& command) {
        if (command.command == mavlink::MavCmd::do_set_mode) {
            const bool offboard = command.param2 == 6.0F;
            ++(offboard ? autopilot.offboards : autopilot.holds);
            if (obeys_mode) {
                mode = offboard ? kOffboard : kLoiter;
            }
        } else if (command.command == mavlink::MavCmd::component_arm_disarm) {
            ++(command.param1 > 0.5F ? autopilot.arms : autopilot.disarms);
            if (obeys_arming) {
                armed = command.param1 > 0.5F;
                landed_state = armed ? 2 : landed_state;
            }
        } else if (command.command == mavlink::MavCmd::request_message && has_origin &&
                   command.param1 == static_cast<float>(mavlink::GpsGlobalOrigin::kId)) {
            (void)autopilot_.send(mavlink::GpsGlobalOrigin{});
        }
    }

    void hear_sensors(const mavlink::Frame& frame) {
        if (const auto command = mavlink::decode<mavlink::CommandLong>(frame)) {
            if (const auto asked = mavlink::mechanism_command(*command, {})) {
                ++sensors.commands;
                if (mechanism_answers) {
                    mechanism = *asked;
                    mavlink::CommandAck ack;
                    ack.command = command->command;
                    (void)sensors_.send(ack);
                }
            }
        } else if (const auto piece = mavlink::decode<mavlink::StatusText>(frame)) {
            const std::string text = texts_.hear(*piece).value_or("");
            if (const auto told = mavlink::told_outcome(text)) {
                sensors.outcome = to_string(told->outcome);
            } else if (const auto event = mavlink::told_event(text)) {
                sensors.events.push_back(event->name);
            }
        } else if (const auto beat = mavlink::decode<mavlink::Heartbeat>(frame)) {
            sensors.over = sensors.over || beat->system_status == mavlink::MavState::poweroff;
        }
    }

    void tell() {
        const auto boot_ms = static_cast<std::uint32_t>(std::llround(puppet.time_s * 1e3));
        const auto usec = static_cast<std::uint64_t>(std::llround(puppet.time_s * 1e6));
        if (beats) {
            mavlink::Heartbeat beat;
            beat.type = 2;
            beat.autopilot = 12;
            beat.base_mode =
                armed ? std::uint8_t{mavlink::MavModeFlag::safety_armed} : std::uint8_t{0};
            beat.custom_mode = mode;
            (void)autopilot_.send(beat);
            mavlink::ExtendedSysState state;
            state.landed_state = landed_state;
            (void)autopilot_.send(state);
        }
        if (tells_pose) {
            Estimate estimate = puppet.estimate;
            estimate.p_WB_m += drifted_m_;
            estimate.v_WB_m_s += estimate_drift_m_s;
            (void)autopilot_.send(mavlink::odometry(estimate, usec));
        }
        if (motion_capture_works) {
            (void)sensors_.send(mavlink::odometry(
                PoseReading{.p_WB_m = puppet.estimate.p_WB_m + motion_capture_off_m + drifted_m_,
                            .q_WB = quaternion_from_euler({.yaw_rad = motion_capture_turned_rad}) *
                                    puppet.estimate.q_WB},
                usec));
        }
        tell_readings(boot_ms);
    }

    void tell_readings(std::uint32_t boot_ms) {
        const Readings& readings = puppet.readings;
        if (puppet.lidar_works) {
            (void)sensors_.send(
                mavlink::distance_sensor(readings.lidar_left.value, 0, 0.1, 12.0, boot_ms));
            (void)sensors_.send(
                mavlink::distance_sensor(readings.lidar_right.value, 1, 0.1, 12.0, boot_ms));
        }
        const auto named = [&](std::string_view name, double value) {
            mavlink::NamedValueFloat message;
            message.time_boot_ms = boot_ms;
            mavlink::set_text(message.name, name);
            message.value = static_cast<float>(value);
            (void)sensors_.send(message);
        };
        if (puppet.force_works) {
            named(mavlink::kForceName, readings.force.value.axial_N);
        }
        if (puppet.pressure_works) {
            named(mavlink::kPressureName, readings.cup_pressure.value.pressure_Pa / 100.0);
        }
    }

    mavlink::Link autopilot_;
    mavlink::Link sensors_;
    mavlink::TextJoiner texts_;
    Vector3 drifted_m_ = Vector3::Zero();
};

}  // namespace limpet::companion
