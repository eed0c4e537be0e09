// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/mount.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::vehicle {

const ParameterTable<PendulumParameters>& pendulum_table() {
    using P = PendulumParameters;
    static const ParameterTable<P> table = {
        {"impact_speed_m_s", "m/s", 0.02, 3.0, &P::impact_speed_m_s,
         "at the lowest point, where the lip meets the wall", "paper, Fig. 3: 0.2 to 1.2 m/s"},
        {"rope_length_m", "m", 1.0, 50.0, &P::rope_length_m,
         "of the four parallel ropes under load", "paper III.B: 5 m; four parallel ones: assumed"},
        {"rope_stretch_m", "m", 1e-4, 0.05, &P::rope_stretch_m,
         "of the ropes under the vehicle's weight", "assumed: thin steel or Dyneema"},
        {"rope_damping", "-", 0.0, 1.0, &P::rope_damping, "along the ropes, share of the critical",
         "assumed: does not damp the swing"},
        {"yaw_deg", "deg", -30.0, 30.0, &P::yaw_deg, "nose right of the wall's normal",
         "assumed: the paper names misalignment, not how much"},
        {"pitch_deg", "deg", -30.0, 30.0, &P::pitch_deg, "nose up",
         "assumed: the paper names misalignment, not how much"},
        {"hold_s", "s", 0.0, 100.0, &P::hold_s,
         "a trial ends when the cup has held for so long, or has been off the wall",
         "paper IV: decides 0.5 s after the impact"},
    };
    return table;
}

const ParameterTable<PressRigParameters>& press_rig_table() {
    using P = PressRigParameters;
    static const ParameterTable<P> table = {
        {"press_N", "N", 0.1, 500.0, &P::press_N,
         "force through the slider at which the clamp stops and the pump starts",
         "assumed: seals on every surface"},
        {"approach_speed_m_s", "m/s", 1e-3, 0.5, &P::approach_speed_m_s,
         "of the clamp towards the wall", "assumed: no impact"},
        {"start_gap_m", "m", 0.0, 1.0, &P::start_gap_m, "from the lip to the wall at the start",
         "assumed"},
        {"stiffness_N_m", "N/m", 1e3, 2e5, &P::stiffness_N_m, "of the clamp along all axes",
         "assumed: 4 mm at 80 N, stable at 1 ms"},
        {"turn_stiffness_N_m_rad", "N m/rad", 10.0, 2000.0, &P::turn_stiffness_N_m_rad,
         "of the clamp about all axes", "assumed: 0.1 deg at 1 N m, stable at 1 ms"},
        {"damping", "-", 0.0, 2.0, &P::damping, "of the clamp, share of the critical",
         "assumed: no ringing"},
        {"seal_s", "s", 0.0, 3600.0, &P::seal_s, "pump on for so long from the press on",
         "paper, Fig. 2: until the pressure is steady"},
        {"leak_s", "s", 0.0, 3600.0, &P::leak_s, "pump off for so long after that",
         "paper, Fig. 2: tau_2 0.40 s on concrete"},
    };
    return table;
}

Vector3 lip_p_B_m(const AirframeNumbers& airframe) {
    return {airframe.cup.joint_x_m + airframe.cup.lip_offset_m, 0.0, airframe.cup.joint_z_m};
}

double swing_angle_rad(double speed_m_s, double length_m) {
    const double cosine = 1.0 - speed_m_s * speed_m_s / (2.0 * kGravity_m_s2 * length_m);
    require(cosine > 0.0, "the ropes are pulled back by less than a right angle");
    return std::acos(cosine);
}

Pendulum hang(const PendulumParameters& parameters, const Airframe& airframe,
              const Vector3& lowest_p_WB_m, const Quaternion& q_WB) {
    const double share_kg = airframe.mass_kg / static_cast<double>(kRopes);
    Pendulum pendulum;
    pendulum.rest_length_m = parameters.rope_length_m - parameters.rope_stretch_m;
    pendulum.stiffness_N_m = share_kg * kGravity_m_s2 / parameters.rope_stretch_m;
    pendulum.damping_N_s_m =
        2.0 * parameters.rope_damping * std::sqrt(pendulum.stiffness_N_m * share_kg);
    double x_m = 0.0, y_m = 0.0;
    for (const Rotor& rotor : airframe.rotors) {
        x_m = std::max(x_m, std::abs(rotor.p_B_m.x()));
        y_m = std::max(y_m, std::abs(rotor.p_B_m.y()));
    }
    // Level with the centre of mass: a push along the wall's normal needs no moment.
    pendulum.hook_B_m = {{{x_m, y_m, 0.0}, {-x_m, -y_m, 0.0}, {x_m, -y_m, 0.0}, {-x_m, y_m, 0.0}}};
    for (std::size_t i = 0; i < kRopes; ++i) {
        pendulum.anchor_W_m[i] = lowest_p_WB_m + q_WB * pendulum.hook_B_m[i] -
                                 parameters.rope_length_m * Vector3::UnitZ();
    }
    return pendulum;
}

Wrench rope_wrench_W(const Pendulum& pendulum, const Kinematics& base) {
    const Vector3 w_W_rad_s = base.q_WF * base.w_WF_F_rad_s;
    Wrench sum;
    for (std::size_t i = 0; i < kRopes; ++i) {
        const Vector3 arm_W_m = base.q_WF * pendulum.hook_B_m[i];
        const Vector3 rope_W_m = pendulum.anchor_W_m[i] - (base.p_WF_m + arm_W_m);
        const double length_m = rope_W_m.norm();
        const double stretch_m = length_m - pendulum.rest_length_m;
        if (stretch_m <= 0.0) {
            continue;  // slack
        }
        const Vector3 up_W = rope_W_m / length_m;
        const double rate_m_s = -up_W.dot(base.v_WF_W_m_s + w_W_rad_s.cross(arm_W_m));
        const double tension_N =
            pendulum.stiffness_N_m * stretch_m + pendulum.damping_N_s_m * rate_m_s;
        const Vector3 force_W_N = std::max(0.0, tension_N) * up_W;
        sum.force_N += force_W_N;
        sum.moment_N_m += arm_W_m.cross(force_W_N);
    }
    return sum;
}

Clamp clamp(const PressRigParameters& parameters, const Airframe& airframe) {
    const double k_N_m = parameters.stiffness_N_m;
    const double k_turn_N_m = parameters.turn_stiffness_N_m_rad;
    return {.stiffness_N_m = k_N_m,
            .damping_N_s_m = 2.0 * parameters.damping * std::sqrt(k_N_m * airframe.mass_kg),
            .turn_stiffness_N_m_rad = k_turn_N_m,
            .turn_damping_N_m_s_rad =
                2.0 * parameters.damping * (k_turn_N_m * airframe.inertia_kg_m2).cwiseSqrt(),
            .weight_N = airframe.mass_kg * kGravity_m_s2};
}

Wrench clamp_wrench_W(const Clamp& clamp, const Kinematics& held, const Kinematics& base) {
    const Vector3 turn_B_rad = rotation_vector_from_quaternion(base.q_WF.conjugate() * held.q_WF);
    const Vector3 moment_B_N_m = clamp.turn_stiffness_N_m_rad * turn_B_rad -
                                 clamp.turn_damping_N_m_s_rad.cwiseProduct(base.w_WF_F_rad_s);
    return {.force_N = clamp.stiffness_N_m * (held.p_WF_m - base.p_WF_m) +
                       clamp.damping_N_s_m * (held.v_WF_W_m_s - base.v_WF_W_m_s) -
                       clamp.weight_N * Vector3::UnitZ(),
            .moment_N_m = base.q_WF * moment_B_N_m};
}

}  // namespace limpet::vehicle
