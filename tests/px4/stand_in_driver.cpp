// SPDX-License-Identifier: Apache-2.0
#include "stand_in_driver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "../autopilot/flight_rig.hpp"

namespace limpet::px4 {
namespace {

using namespace std::chrono_literals;
using mavlink::decode;
using mavlink::Frame;

constexpr std::uint8_t kSystem = 255;
const Vector3 kField_W_gauss = {0.21597, 0.0, 0.42755};

mavlink::Link listen(wire::Medium medium, wire::Transport** wire = nullptr) {
    auto transport = open_transport({.medium = medium, .port = 0}, wire::Role::listen);
    if (wire != nullptr) {
        *wire = transport.get();
    }
    return {std::move(transport), {.system = kSystem, .component = mavlink::kCompanionComponent}};
}

StandInOptions meeting(StandInOptions options, const mavlink::Link& simulator,
                       const mavlink::Link& companion) {
    options.hil = simulator.transport().address();
    options.onboard.port = 0;
    options.onboard_peer = companion.transport().address();
    return options;
}

}  // namespace

StandInDriver::StandInDriver(const StandInOptions& options,
                             const autopilot::AutopilotParameters& parameters)
    : model(make_autopilot(parameters, autopilot::quad_x())),
      simulator(listen(wire::Medium::tcp, &wire)),
      companion(listen(wire::Medium::udp)),
      stand_in(model, meeting(options, simulator, companion)) {}

void StandInDriver::boot() {
    for (int i = 0; i < 126; ++i) {
        step();
    }
    ASSERT_TRUE(companion.wait_for_peer(10s));
    run(1.1);
}

void StandInDriver::send_sensors() {
    const auto usec = static_cast<std::uint64_t>(std::llround(1e6 * time_s));
    Readings now;
    now.imu = {
        .time_s = time_s,
        .value = {.specific_force_B_m_s2 = q_WB.conjugate() * Vector3(0.0, 0.0, -kGravity_m_s2)}};
    now.magnetometer = {.time_s = time_s,
                        .value = {.field_B_gauss = q_WB.conjugate() * kField_W_gauss}};
    if (steps_ % 2 == 0) {
        mavlink::Odometry pose =
            mavlink::odometry(PoseReading{.p_WB_m = p_WB_m, .q_WB = q_WB}, usec);
        pose.estimator_type = estimator_type;
        if (poses_over_tcp) {
            (void)simulator.send(pose);
        }
        if (poses_over_udp) {
            (void)companion.send(pose);
        }
    }
    if (gps && steps_ % 50 == 0) {
        (void)simulator.send(mavlink::hil_gps({.p_WB_m = p_WB_m}, {}, usec));
    }
    EXPECT_EQ(simulator.send(mavlink::hil_sensor(now, {}, usec)), wire::TransferStatus::done);
}

void StandInDriver::send_set_point() {
    if (beats && steps_ % 250 == 0) {
        mavlink::Heartbeat beat;
        beat.type = heartbeat_type;
        beat.autopilot = 8;
        (void)companion.send(beat);
    }
    if (thrust_ && steps_ % 5 == 0) {
        mavlink::SetAttitudeTarget target =
            mavlink::attitude_target({.q_WB = q_WB, .thrust = *thrust_}, 0);
        target.target_system = target_system;
        (void)companion.send(target);
    }
}

void StandInDriver::hear_simulator_side() {
    while (const auto frame = simulator.receive()) {
        if (const auto controls = decode<mavlink::HilActuatorControls>(*frame)) {
            answers.push_back(*controls);
        } else if (const auto asked = decode<mavlink::CommandLong>(*frame)) {
            said_hello = said_hello || asked->command == 511;
        }
    }
}

void StandInDriver::hear_companion_side() {
    while (const auto frame = companion.receive()) {
        ++heard[frame->id];
        if (const auto beat = decode<mavlink::Heartbeat>(*frame)) {
            heartbeat = *beat;
        } else if (const auto state = decode<mavlink::ExtendedSysState>(*frame)) {
            landed = *state;
        } else if (const auto answer = decode<mavlink::CommandAck>(*frame)) {
            ack = *answer;
        } else if (const auto value = decode<mavlink::ParamValue>(*frame)) {
            parameter = *value;
        } else if (const auto told = decode<mavlink::Odometry>(*frame)) {
            estimate = mavlink::estimate_from(*told);
        } else if (const auto text = decode<mavlink::StatusText>(*frame)) {
            texts.emplace_back(mavlink::text_of(text->text));
        }
    }
}

void StandInDriver::step() {
    while (!simulator.wait_for_peer(0ns)) {
        (void)stand_in.serve(1ms);  // it tries again and again
    }
    ++steps_;
    time_s = kStep_s * static_cast<double>(steps_);
    answers.clear();
    send_set_point();
    send_sensors();
    const std::uint64_t before = stand_in.count().sensors;
    const auto patience = std::chrono::steady_clock::now() + 10s;
    while (stand_in.count().sensors == before && std::chrono::steady_clock::now() < patience) {
        (void)stand_in.serve(0ns);
    }
    EXPECT_EQ(stand_in.count().sensors, before + 1);
    hear_simulator_side();
    hear_companion_side();
}

void StandInDriver::run(double duration_s) {
    const auto steps = std::lround(duration_s / kStep_s);
    for (long i = 0; i < steps; ++i) {
        step();
    }
}

int StandInDriver::command(std::uint16_t command, float param1, float param2, float param3) {
    mavlink::CommandLong message;
    message.target_system = target_system;
    message.target_component = mavlink::kAutopilotComponent;
    message.command = command;
    message.param1 = param1;
    message.param2 = param2;
    message.param3 = param3;
    ack = {};
    ack.result = 255;
    (void)companion.send(message);
    step();
    return ack.result;
}

void StandInDriver::set_parameter(const std::string& name, std::int32_t value) {
    mavlink::ParamSet message;
    message.target_system = 1;
    mavlink::set_text(message.param_id, name);
    std::memcpy(&message.param_value, &value, sizeof(value));
    message.param_type = 6;  // MAV_PARAM_TYPE_INT32
    (void)companion.send(message);
    step();
}

}  // namespace limpet::px4
