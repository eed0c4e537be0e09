// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// Pose of B from cameras in the laboratory, stamped at the exposure and late by the network. A
/// sample that drops out never arrives.
struct MotionCaptureSensor {
    using Reading = PoseReading;
    struct Parameters {
        int mocap_rate_Hz = 120;
        double mocap_latency_s = 0.02;
        double mocap_position_noise_m = 0.0005;
        double mocap_attitude_noise_deg = 0.1;
        double mocap_dropout_probability = 0.0;
    };
    using State = BiasedSensor;
    static constexpr std::array kStreams = {Stream::motion_capture};
    static constexpr std::array kReadings = {&Readings::motion_capture};
    static constexpr bool kOnCup = false;
    static constexpr auto kRate_Hz = &Parameters::mocap_rate_Hz;
    static constexpr auto kLatency_s = &Parameters::mocap_latency_s;
    // clang-format off
    [[nodiscard]] static const ParameterTable<Parameters>& table() {
        using P = Parameters;
        static const ParameterTable<P> table = {
            {"mocap_rate_Hz", "Hz", 0.0, 240.0, &P::mocap_rate_Hz, "samples a second, whole; 0: not fitted", "OptiTrack 120-240 Hz, facts.md section 2"},
            {"mocap_latency_s", "s", 0.0, 0.25, &P::mocap_latency_s, "from exposure to arrival", "assumed: 4 ms camera, 10-40 ms WiFi and ROS"},
            {"mocap_position_noise_m", "m", 0.0, 1.0, &P::mocap_position_noise_m, "white noise, each axis", "OptiTrack 0.12-0.74 mm, arXiv 2502.21189"},
            {"mocap_attitude_noise_deg", "deg", 0.0, 45.0, &P::mocap_attitude_noise_deg, "white noise, each axis of B", "assumed: 0.5 mm over 0.3 m of markers"},
            {"mocap_dropout_probability", "-", 0.0, 1.0, &P::mocap_dropout_probability, "share of samples that never arrive", "assumed: none in a clear volume"},
        };
        return table;
    }
    // clang-format on

    [[nodiscard]] static std::optional<Reading> measure(const Parameters& p, State& state,
                                                        const SensorView& view) {
        const bool lost = state.random.uniform() < p.mocap_dropout_probability;
        const Vector3 shift_m = p.mocap_position_noise_m * state.random.normal3();
        const Vector3 turn_rad = radians(p.mocap_attitude_noise_deg) * state.random.normal3();
        if (lost) {
            return std::nullopt;
        }
        const Kinematics& base = view.truth.base;
        return Reading{.p_WB_m = base.p_WF_m + shift_m,
                       .q_WB = base.q_WF * quaternion_from_rotation_vector(turn_rad)};
    }
};

}  // namespace limpet::sensors
