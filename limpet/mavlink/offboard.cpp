// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/offboard.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <string_view>
#include <utility>
#include <variant>

#include "limpet/core/errors.hpp"
#include "limpet/mavlink/numbers.hpp"
#include "limpet/mavlink/parameter_value.hpp"
#include "limpet/mavlink/translate.hpp"

namespace limpet::mavlink {
namespace {

/// Space in a wire is waited for no longer: a jammed one must not make guidance late.
constexpr std::chrono::milliseconds kPatience{5};
constexpr std::string_view kAirframe = "SYS_AUTOSTART";
/// Streams of PX4's onboard link that come five times a second or more and are not read here:
/// GPS_RAW_INT, ATTITUDE, ATTITUDE_QUATERNION, LOCAL_POSITION_NED, GLOBAL_POSITION_INT,
/// SERVO_OUTPUT_RAW, VFR_HUD, ATTITUDE_TARGET, POSITION_TARGET_LOCAL_NED, HIGHRES_IMU, TIMESYNC,
/// ALTITUDE, ESC_INFO, ESC_STATUS. Source: PX4 v1.15.1, mode Onboard
constexpr std::array<std::uint32_t, 14> kNotRead = {24, 30, 31,  32,  33,  36,  74,
                                                    83, 85, 105, 111, 141, 290, 291};
constexpr float kStop = -1.0F;  // an interval: never
constexpr float kCustomMode = MavModeFlag::custom_mode_enabled;

/// Whether it is time again, and then remembers.
bool again(double& last_s, double interval_s, double time_s) {
    constexpr double kRounding_s = 1e-6;
    if (time_s - last_s < interval_s - kRounding_s) {
        return false;
    }
    last_s = time_s;
    return true;
}

/// "barometer, GPS"; empty: all is well. Of those parts that a flight needs.
std::string sensors_text(std::uint32_t sensors) {
    using Bit = MavSysStatusSensor;
    constexpr std::array<std::pair<std::uint32_t, std::string_view>, 7> kParts = {
        {{Bit::sensor_3d_gyro, "gyroscope"},
         {Bit::sensor_3d_accel, "accelerometer"},
         {Bit::sensor_3d_mag, "magnetometer"},
         {Bit::absolute_pressure, "barometer"},
         {Bit::gps, "GPS"},
         {Bit::vision_position, "motion capture"},
         {Bit::battery, "battery"}}};
    std::string text;
    for (const auto& [bit, name] : kParts) {
        if ((sensors & bit) != 0) {
            text += (text.empty() ? "" : ", ") + std::string(name);
        }
    }
    return text;
}

std::string_view command_name(std::uint16_t command) {
    switch (command) {
        case MavCmd::do_set_mode: return "the change of mode";
        case MavCmd::component_arm_disarm: return "arming or disarming";
        case MavCmd::set_message_interval: return "a message's rate";
        default: return "a command";
    }
}

}  // namespace

Offboard::Offboard(OffboardOptions options)
    : options_(std::move(options)), parameters_(options_.expected) {}

void Offboard::hear(const Frame& frame, double time_s) {
    if (frame.system != options_.target_system || frame.component != kAutopilotComponent) {
        return;
    }
    if (const auto beat = decode<Heartbeat>(frame)) {
        if (beat->type == MavType::quadrotor || beat->autopilot != MavAutopilot::invalid) {
            heartbeat_s_ = time_s;
            const bool armed = (beat->base_mode & MavModeFlag::safety_armed) != 0;
            if (armed && !report_.armed) {
                report_.warnings.clear();
            }
            report_.armed = armed;
            was_armed_ = was_armed_ || armed;
            report_.custom_mode = beat->custom_mode;
            report_.offboard = main_mode(beat->custom_mode) == kMainModeOffboard;
            was_engaged_ = was_engaged_ || (report_.offboard && streaming_s_ >= 0.0);
        }
    } else if (const auto odometry = decode<Odometry>(frame)) {
        const auto estimate = estimate_from(*odometry);
        if (estimate && estimate->valid) {  // one that failed by its own account is none
            estimate_ = *estimate;
            estimate_.time_s = time_s;
            estimate_s_ = time_s;
        }
    } else if (const auto system_state = decode<ExtendedSysState>(frame)) {
        report_.landed_state = system_state->landed_state;
    } else if (const auto text = decode<StatusText>(frame)) {
        if (auto whole = texts_.hear(*text)) {
            report_.warnings.add(text->severity, *whole);
            report_.text = std::move(*whole);
            ++report_.texts;
        }
    } else if (const auto version = decode<AutopilotVersion>(frame)) {
        report_.version = *version;
    } else if (const auto status = decode<SysStatus>(frame)) {
        report_.unhealthy =
            status->onboard_control_sensors_enabled & ~status->onboard_control_sensors_health;
    } else if (decode<GpsGlobalOrigin>(frame)) {
        report_.has_origin = true;
    } else if (const auto value = decode<ParamValue>(frame)) {
        if (text_of(value->param_id) == kAirframe && value->param_type == MavParamType::int32) {
            report_.airframe = static_cast<int>(parameter_value(*value));
        }
        parameters_.hear(*value);
    } else if (const auto ack = decode<CommandAck>(frame)) {
        if (addressed_to(self_, *ack)) {  // a ground station's commands are answered too
            hear_command_ack(*ack);
        }
    }
}

void Offboard::hear_command_ack(const CommandAck& ack) {
    if (ack.result == MavResult::accepted || ack.result == MavResult::in_progress) {
        if (report_.refused_command == ack.command) {
            report_.refused_command = 0;
        }
        if (ack.command ==
            MavCmd::component_arm_disarm) {  // sooner than the next heartbeat, which comes at 1 Hz
            report_.armed = asked_armed_;
            was_armed_ = was_armed_ || asked_armed_;
        }
        hold_accepted_ = hold_accepted_ || (handed_back_ && ack.command == MavCmd::do_set_mode);
    } else if (ack.command == MavCmd::request_message) {
        // Every autopilot has what else is requested; one that is busy has not reported it.
        no_origin_ = no_origin_ || ack.result != MavResult::temporarily_rejected;
    } else if (ack.command == MavCmd::set_message_interval) {
        report_.refused_rate = estimate_s_ < 0.0 && (ack.result == MavResult::denied ||
                                                     ack.result == MavResult::unsupported ||
                                                     ack.result == MavResult::failed);
    } else {
        report_.refused_command = ack.command;
        report_.refused_result = ack.result;
    }
}

OffboardState Offboard::state(double time_s) const {
    if (heartbeat_s_ < 0.0 || time_s - heartbeat_s_ > options_.silence_limit_s) {
        return OffboardState::silent;
    }
    if (taken_away()) {
        return OffboardState::taken_away;
    }
    if (estimate_s_ < 0.0 || time_s - estimate_s_ > options_.estimate_limit_s) {
        return OffboardState::unready;
    }
    return report_.offboard ? OffboardState::engaged : OffboardState::streaming;
}

Estimate Offboard::estimate(double time_s) const {
    Estimate estimate = estimate_;
    estimate.valid = estimate_s_ >= 0.0 && time_s - estimate_s_ <= options_.estimate_limit_s;
    return estimate;
}

void Offboard::send_command(Link& link, std::uint16_t command, float param1, float param2,
                            float param3) {
    self_ = link.self();
    (void)link.send(CommandLong{.target_system = options_.target_system,
                                .target_component = kAutopilotComponent,
                                .command = command,
                                .param1 = param1,
                                .param2 = param2,
                                .param3 = param3},
                    kPatience);
}

/// PX4's position controller keeps the wind that it has found, also through a rest: off the wall it
/// would come on top of guidance's. It forgets while it is disarmed and in use; a second is enough.
bool Offboard::forgets(const Setpoint& setpoint, double time_s) {
    constexpr double kForgets_s = 1.0;
    if (report_.armed || setpoint.armed) {
        disarmed_s_ = report_.armed ? -1.0 : disarmed_s_;
        return false;
    }
    disarmed_s_ = disarmed_s_ < 0.0 ? time_s : disarmed_s_;
    return was_armed_ && time_s - disarmed_s_ < kForgets_s;
}

void Offboard::send_set_point(Link& link, const Setpoint& setpoint, double time_s) {
    const auto send = [&](auto message) {
        message.target_system = options_.target_system;
        message.target_component = kAutopilotComponent;
        (void)link.send(message, kPatience);
    };
    const std::uint32_t now_ms = boot_ms(time_s);
    // Disarmed or idle, it is sent what it is: whatever it would do for a position, it must not.
    const AttitudeSetpoint rest{.q_WB = estimate_.q_WB, .thrust = 0.0};
    if (forgets(setpoint, time_s)) {
        send(position_target(
            VelocitySetpoint{.yaw_rad = euler_from_quaternion(estimate_.q_WB).yaw_rad}, now_ms));
    } else if (!setpoint.armed || std::holds_alternative<IdleSetpoint>(setpoint.motion)) {
        send(attitude_target(rest, now_ms));
    } else if (const auto* position = std::get_if<PositionSetpoint>(&setpoint.motion)) {
        send(position_target(*position, now_ms));
    } else if (const auto* velocity = std::get_if<VelocitySetpoint>(&setpoint.motion)) {
        send(position_target(*velocity, now_ms));
    } else {
        send(attitude_target(std::get<AttitudeSetpoint>(setpoint.motion), now_ms));
    }
}

/// What is not yet as it should be is requested, one thing at a time.
void Offboard::request(Link& link, const Setpoint& setpoint, double time_s) {
    const OffboardState now = state(time_s);
    const bool warm = streaming_s_ >= 0.0 && time_s - streaming_s_ >= options_.warm_up_s;
    if (now == OffboardState::streaming && options_.asks_for_mode && warm) {
        if (again(sent_command_s_, options_.retry_s, time_s)) {
            send_command(link, MavCmd::do_set_mode, kCustomMode,
                         static_cast<float>(kMainModeOffboard));
        }
    } else if (now == OffboardState::engaged && setpoint.armed != report_.armed) {
        if (awaits_origin(time_s) || (setpoint.armed && !compared(time_s))) {
            return;  // armed, it would be given none
        }
        if (again(sent_command_s_, options_.retry_s, time_s)) {
            asked_armed_ = setpoint.armed;
            send_command(link, MavCmd::component_arm_disarm, setpoint.armed ? 1.0F : 0.0F,
                         setpoint.armed ? 0.0F : kForce);
        }
    }
}

bool Offboard::awaits_origin(double time_s) const {
    constexpr double kPatience_s = 5.0;  // one that never reports it may have taken it all the same
    if (!options_.sets_origin || was_armed_ || report_.has_origin) {
        return false;
    }
    return first_origin_s_ < 0.0 || time_s - first_origin_s_ < kPatience_s;
}

/// Its own is requested first, and it is given one while it reports none and no pose has gone to
/// it. After poses PX4 v1.16 does without them for a second, and PX4's main since 2026-06-29 keeps
/// the distance to the origin, thousands of kilometres, as a bias of them.
void Offboard::give_origin(Link& link, double time_s) {
    constexpr double kAnswer_s = 1.0;
    constexpr double kAgain_s = 1.5;  // it takes none before its estimator runs
    if (!awaits_origin(time_s)) {
        return;
    }
    if (again(asked_origin_s_, kAnswer_s, time_s)) {
        ++origin_requests_;
        send_command(link, MavCmd::request_message, static_cast<float>(GpsGlobalOrigin::kId));
    }
    if ((no_origin_ || origin_requests_ > 1) && again(sent_origin_s_, kAgain_s, time_s)) {
        first_origin_s_ = first_origin_s_ < 0.0 ? time_s : first_origin_s_;
        SetGpsGlobalOrigin origin{.target_system = options_.target_system};
        put(GeographicOrigin{}, origin.latitude, origin.longitude, origin.altitude);
        (void)link.send(origin, kPatience);
    }
}

/// A few times, for one may be lost, and as long as nothing comes.
void Offboard::request_rate(Link& link) {
    constexpr int kTimes = 3;
    if (options_.estimate_rate_Hz > 0.0 && (rate_requests_ < kTimes || estimate_s_ < 0.0)) {
        ++rate_requests_;
        send_command(link, MavCmd::set_message_interval, static_cast<float>(Odometry::kId),
                     static_cast<float>(1e6 / options_.estimate_rate_Hz));
    }
}

bool Offboard::compared(double time_s) const {
    constexpr int kWorthAWait = 3;
    return options_.expected.empty() ||
           (parameters_.done(time_s) && (report_.version || who_requests_ >= kWorthAWait));
}

/// Once the estimate comes.
void Offboard::stop_others(Link& link) {
    constexpr int kTimes = 2;
    if (options_.estimate_alone && estimate_s_ >= 0.0 && stop_requests_ < kTimes) {
        ++stop_requests_;
        for (const std::uint32_t id : kNotRead) {
            send_command(link, MavCmd::set_message_interval, static_cast<float>(id), kStop);
        }
    }
}

/// For the record: a flight does not wait for it, but for the first requests.
void Offboard::ask_who(Link& link) {
    constexpr int kTimes = 40;  // PX4 answers by a clock of its own, while simulated seconds fly by
    if (who_requests_ >= kTimes || (report_.version && report_.airframe)) {
        return;
    }
    ++who_requests_;
    if (!report_.version) {
        send_command(link, MavCmd::request_message, static_cast<float>(AutopilotVersion::kId));
    }
    if (!report_.airframe) {
        ParamRequestRead request{.target_system = options_.target_system,
                                 .target_component = kAutopilotComponent,
                                 .param_index = -1};
        set_text(request.param_id, kAirframe);
        (void)link.send(request, kPatience);
    }
}

void Offboard::attend(Link& link, double time_s) {
    streaming_s_ = -1.0;
    speak_up(link, time_s);
}

/// What goes whether or not it flies.
void Offboard::speak_up(Link& link, double time_s) {
    if (again(sent_heartbeat_s_, 1.0 / options_.heartbeat_rate_Hz, time_s)) {
        const std::uint8_t type = options_.hears_texts ? MavType::gcs : MavType::onboard_controller;
        (void)link.send(Heartbeat{.type = type,
                                  .autopilot = MavAutopilot::invalid,
                                  .system_status = MavState::active,
                                  .mavlink_version = kMavlinkVersion},
                        kPatience);
    }
    const OffboardState now = state(time_s);
    const bool received = now != OffboardState::silent && now != OffboardState::taken_away;
    if (received) {
        give_origin(link, time_s);
        parameters_.update(link, options_.target_system, time_s);
    }
    if (received && again(sent_request_s_, 1.0, time_s)) {
        request_rate(link);
        stop_others(link);
        ask_who(link);
    }
}

void Offboard::update(Link& link, const Setpoint& setpoint, double time_s) {
    speak_up(link, time_s);
    const OffboardState now = state(time_s);
    const bool there = now != OffboardState::silent && now != OffboardState::unready;
    // One that flies us and has fallen silent may still receive: without set-points it would hold,
    // and pry at a cup that holds. Who may not fly on hands back.
    if (taken_away() || !(there || was_engaged_)) {
        streaming_s_ = -1.0;
        return;
    }
    if (again(sent_set_point_s_, 1.0 / options_.set_point_rate_Hz, time_s)) {
        send_set_point(link, setpoint, time_s);
        streaming_s_ = streaming_s_ < 0.0 ? time_s : streaming_s_;
        was_engaged_ = was_engaged_ || report_.offboard;
    }
    request(link, setpoint, time_s);
}

void Offboard::hand_back(Link& link, double time_s) {
    handed_back_ = true;
    const bool ours = report_.armed && report_.offboard && !hold_accepted_;
    if (ours && again(sent_command_s_, options_.retry_s, time_s)) {
        send_command(link, MavCmd::do_set_mode, kCustomMode, static_cast<float>(kMainModeAuto),
                     static_cast<float>(kSubModeLoiter));
    }
}

std::string Offboard::obstacle(double time_s) const {
    const auto with_reason = [&](std::string text) {
        if (report_.refused_command != 0) {
            text += fmt::format("; it refused {} ({})", command_name(report_.refused_command),
                                report_.refused_result);
        }
        if (const std::string parts = sensors_text(report_.unhealthy); !parts.empty()) {
            text += "; not healthy: " + parts;
        }
        if (const auto& warnings = report_.warnings.texts(); !warnings.empty()) {
            text += fmt::format("; it reported \"{}\"", fmt::join(warnings, "\", \""));
        }
        return text;
    };
    switch (state(time_s)) {
        case OffboardState::silent: return "no heartbeat of the autopilot";
        case OffboardState::unready:
            return with_reason(report_.refused_rate
                                   ? "the autopilot does not send ODOMETRY on request"
                                   : "the autopilot sends no fresh pose");
        case OffboardState::streaming:
            return with_reason(options_.asks_for_mode ? "the autopilot is not in OFFBOARD mode yet"
                                                      : "waits for the mode OFFBOARD");
        case OffboardState::taken_away: return with_reason("another mode was chosen");
        case OffboardState::engaged:
            return report_.armed      ? ""
                   : compared(time_s) ? with_reason("not armed yet")
                                      : "its parameters are being read";
    }
    throw InternalError("offboard state out of range");
}

}  // namespace limpet::mavlink
