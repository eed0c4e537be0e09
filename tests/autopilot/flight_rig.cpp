// SPDX-License-Identifier: Apache-2.0
#include "flight_rig.hpp"

#include <cmath>

#include "defaults.hpp"

namespace limpet::autopilot {
namespace {

constexpr double kLatency_s = 0.02;
constexpr double kMotorConstant = 2.5e-5;
const Vector3 kInertia_kg_m2 = {0.05, 0.10, 0.14};

}  // namespace

RotorList<RotorGeometry> quad_x() {
    constexpr double a = 0.205;
    return {RotorGeometry{.p_B_m = {a, a, -0.04}, .direction = 1.0},
            RotorGeometry{.p_B_m = {-a, -a, -0.04}, .direction = 1.0},
            RotorGeometry{.p_B_m = {a, -a, -0.04}, .direction = -1.0},
            RotorGeometry{.p_B_m = {-a, a, -0.04}, .direction = -1.0}};
}

FlightRig::FlightRig(const AutopilotParameters& parameters, double noise_scale,
                     const Kinematics& initial)
    : model(make_autopilot(parameters, quad_x())),
      truth(initial),
      noise(noise_scale),
      random_(7, 0, Stream::test),
      imu_from_(initial) {
    Estimate known;
    known.p_WB_m = initial.p_WF_m;
    known.q_WB = initial.q_WF;
    autopilot = start(model, known);
    speed_rad_s =
        RotorList<double>(4, std::sqrt(kMass_kg * kGravity_m_s2 / (4.0 * kMotorConstant)));
}

void FlightRig::fly(const Setpoint& setpoint, double duration_s) {
    const auto ticks = static_cast<Tick>(std::lround(duration_s / kTick_s));
    for (Tick i = 0; i < ticks; ++i) {
        ++tick;
        move();
        sense();
        if (due(tick, 250)) {
            estimate(model, autopilot, readings_);
            command = control(model, autopilot, setpoint, seconds(tick));
        }
    }
}

void FlightRig::sense() {
    const double now_s = seconds(tick);
    if (due(tick, 250)) {
        const Vector3 turn_rad =
            rotation_vector_from_quaternion(imu_from_.q_WF.conjugate() * truth.q_WF);
        const Quaternion q_middle =
            imu_from_.q_WF * quaternion_from_rotation_vector(0.5 * turn_rad);
        const Vector3 a_W_m_s2 = (truth.v_WF_W_m_s - imu_from_.v_WF_W_m_s) / kDt_s;
        readings_.imu.time_s = now_s;
        readings_.imu.value.rate_B_rad_s =
            turn_rad / kDt_s + noise * 3.39e-4 / std::sqrt(kDt_s) * random_.normal3();
        readings_.imu.value.specific_force_B_m_s2 =
            q_middle.conjugate() * (a_W_m_s2 - kGravity_W_m_s2) +
            noise * 4e-3 / std::sqrt(kDt_s) * random_.normal3();
        imu_from_ = truth;
    }
    if (due(tick, 120)) {
        on_the_way_.push_back(
            {.time_s = now_s,
             .value = {.p_WB_m = truth.p_WF_m + noise * 5e-4 * random_.normal3(),
                       .q_WB = truth.q_WF * quaternion_from_rotation_vector(noise * radians(0.1) *
                                                                            random_.normal3())}});
    }
    while (!on_the_way_.empty() && on_the_way_.front().time_s <= now_s - kLatency_s) {
        readings_.motion_capture = on_the_way_.front();
        on_the_way_.pop_front();
    }
}

void FlightRig::move() {
    Vector3 moment_N_m = Vector3::Zero();
    double thrust_N = 0.0;
    for (std::size_t i = 0; i < speed_rad_s.size(); ++i) {
        const double target = command.armed ? 700.0 * command.command[i] + 100.0 : 0.0;
        const double tau_s = target > speed_rad_s[i] ? 0.0125 : 0.025;
        speed_rad_s[i] = target + (speed_rad_s[i] - target) * std::exp(-kTick_s / tau_s);
        const RotorGeometry rotor = quad_x()[i];
        const double rotor_N = kMotorConstant * speed_rad_s[i] * speed_rad_s[i];
        thrust_N += rotor_N;
        moment_N_m += rotor.p_B_m.cross(Vector3(0.0, 0.0, -rotor_N));
        moment_N_m.z() += rotor.direction * rotor.moment_constant_m * rotor_N;
    }
    const Vector3& w = truth.w_WF_F_rad_s;
    const Vector3 momentum = kInertia_kg_m2.cwiseProduct(w);
    truth.w_WF_F_rad_s += kTick_s * (moment_N_m - w.cross(momentum)).cwiseQuotient(kInertia_kg_m2);
    const Vector3 a_W_m_s2 =
        kGravity_W_m_s2 + (truth.q_WF * Vector3(0.0, 0.0, -thrust_N) + push_W_N) / kMass_kg;
    truth.v_WF_W_m_s += kTick_s * a_W_m_s2;
    truth.p_WF_m += kTick_s * truth.v_WF_W_m_s;
    truth.q_WF =
        (truth.q_WF * quaternion_from_rotation_vector(kTick_s * truth.w_WF_F_rad_s)).normalized();
}

}  // namespace limpet::autopilot
