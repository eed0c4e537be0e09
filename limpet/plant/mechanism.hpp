// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "limpet/core/cup_bearer.hpp"
#include "limpet/core/lanes.hpp"
#include "limpet/plant/spatial.hpp"
#include "limpet/vehicle/airframe.hpp"

// The vehicle as bodies: a base that is free in space, a carriage that slides on it along x, and a
// cup on two hinges at the carriage's front, pitch about the base's y, then yaw about the cup's own
// z. Every vehicle with our cup is of this shape. Written on a scalar type T.
//
// Source: Featherstone, "Rigid Body Dynamics Algorithms", 2008, chapters 2, 3 and 7; checked
// against MuJoCo's to 1e-10 (tests/plant).
namespace limpet::plant {

inline constexpr int kJoints = 3;  ///< slider, cup_pitch, cup_yaw
inline constexpr int kFreedoms = 6 + kJoints;

template <class T>
struct RigidBody {
    T mass_kg{};
    Vec3<T> centre_m = Vec3<T>::Zero();
    Mat3<T> inertia_kg_m2 = Mat3<T>::Zero();  ///< about its own centre
};

/// Immutable numbers of the bodies.
template <class T>
struct MechanismNumbers {
    bool has_cup = true;
    T mass_kg{};  ///< of all
    SpatialInertia<T> base;
    RigidBody<T> carriage;  ///< in B with the slider at its outer stop
    RigidBody<T> cup;       ///< centre from the joint; joint centred
    Vec3<T> joint_B_m = Vec3<T>::Zero();
    T lip_m{};  ///< ahead of the joint
    std::array<vehicle::JointLawOf<T>, kJoints> joints{};
};

struct MechanismModel {
    MechanismNumbers<double> numbers;
    Vector6 lip_mobility_1_s = Vector6::Zero();  ///< as CupBearer's: joint straight, slider out
};
[[nodiscard]] MechanismModel make_mechanism(const vehicle::Airframe& airframe);

template <class T>
struct MechanismState {
    Vec3<T> p_WB_m = Vec3<T>::Zero();
    Eigen::Quaternion<T> q_WB = Eigen::Quaternion<T>::Identity();
    Vec3<T> v_WB_W_m_s = Vec3<T>::Zero();
    Vec3<T> w_WB_B_rad_s = Vec3<T>::Zero();
    std::array<T, kJoints> joint{};       ///< [m, rad, rad]
    std::array<T, kJoints> joint_rate{};  ///< [m/s, rad/s, rad/s]
};

/// Bodies on which forces act.
template <class T>
struct MechanismForces {
    Spatial<T> base, carriage, cup;  ///< about B's origin, in B
};

/// Where everything is at one state, how it resists, and what it needs to go on as it does. All
/// falls: accelerations are those besides gravity's, so that no body carries its own weight.
template <class T>
struct Mechanism {
    Mat3<T> R_WB = Mat3<T>::Identity();
    Vec3<T> gravity_B_m_s2 = Vec3<T>::Zero();
    Mat3<T> R_BC = Mat3<T>::Identity();
    Eigen::Quaternion<T> q_BC = Eigen::Quaternion<T>::Identity();
    Vec3<T> joint_B_m = Vec3<T>::Zero();
    Vec3<T> lip_B_m = Vec3<T>::Zero();
    Vec3<T> lip_arm_B_m = Vec3<T>::Zero();  ///< from the joint
    Vec3<T> cup_w_B_rad_s = Vec3<T>::Zero();
    TurnAboutY<T> pitch_axis;
    Spatial<T> yaw_axis;
    /// Of lip and cup in W while no speed changes, in B: [m/s^2], [rad/s^2].
    Vec3<T> lip_drift_m_s2 = Vec3<T>::Zero();
    Vec3<T> cup_drift_rad_s2 = Vec3<T>::Zero();
    SpatialInertia<T> carriage, cup;
    MechanismForces<T> force;  ///< what the speeds require
};

/// A symmetric matrix in axes that are turned about one of them: R M R' with R about z (axis 2) or
/// about y (axis 1).
template <int axis, class T>
[[gnu::always_inline]] inline Mat3<T> turned_about(const T& cosine, const T& sine,
                                                   const Mat3<T>& M) {
    constexpr int i = (axis + 1) % 3, k = (axis + 2) % 3;  // i turns towards k
    const T cross = sine * cosine * (M(i, i) - M(k, k)) + (cosine * cosine - sine * sine) * M(i, k);
    const T sum = M(i, i) + M(k, k);
    Mat3<T> turned;
    turned(axis, axis) = M(axis, axis);
    turned(i, i) =
        cosine * cosine * M(i, i) + sine * sine * M(k, k) - 2.0 * sine * cosine * M(i, k);
    turned(k, k) = sum - turned(i, i);
    turned(i, k) = turned(k, i) = cross;
    turned(axis, i) = turned(i, axis) = cosine * M(axis, i) - sine * M(axis, k);
    turned(axis, k) = turned(k, axis) = sine * M(axis, i) + cosine * M(axis, k);
    return turned;
}

/// What a body needs to turn on about B's origin, at rest there, with w.
template <class T>
[[gnu::always_inline]] inline Spatial<T> spinning(const SpatialInertia<T>& body, const Vec3<T>& w) {
    const Vec3<T> h = body.mass_moment();
    return Spatial<T>::of(body.turned(w).cross(w), w.squaredNorm() * h - w.dot(h) * w);
}

/// The mechanism at a state.
/// @param at  is filled
template <class T>
void place_mechanism(const MechanismNumbers<T>& model, const MechanismState<T>& state,
                     Mechanism<T>& at) {
    at.R_WB = state.q_WB.toRotationMatrix();
    at.gravity_B_m_s2 = kGravity_m_s2 * at.R_WB.row(2).transpose();
    const Vec3<T>& w = state.w_WB_B_rad_s;
    at.force.base = spinning(model.base, w);
    if (!model.has_cup) {
        return;
    }

    T s_p, c_p, s_y, c_y;  // of half the angles
    sine_cosine<T>(0.5 * state.joint[1], s_p, c_p);
    sine_cosine<T>(0.5 * state.joint[2], s_y, c_y);
    at.q_BC = {c_p * c_y, s_p * s_y, s_p * c_y, c_p * s_y};
    const T sin_p = 2.0 * s_p * c_p, cos_p = 1.0 - 2.0 * s_p * s_p;
    const T sin_y = 2.0 * s_y * c_y, cos_y = 1.0 - 2.0 * s_y * s_y;
    at.R_BC << cos_p * cos_y, -cos_p * sin_y, sin_p,  //
        sin_y, cos_y, T(0.0),                         //
        -sin_p * cos_y, sin_p * sin_y, cos_p;
    const Vec3<T> yaw_axis = at.R_BC.col(2);
    const Vec3<T> slid(state.joint[0], T(0.0), T(0.0));
    at.joint_B_m = model.joint_B_m + slid;
    at.lip_arm_B_m = model.lip_m * at.R_BC.col(0);
    at.lip_B_m = at.joint_B_m + at.lip_arm_B_m;
    at.pitch_axis = {at.joint_B_m.x(), at.joint_B_m.z()};
    at.yaw_axis = Spatial<T>::of(yaw_axis, at.joint_B_m.cross(yaw_axis));

    const T &carriage_kg = model.carriage.mass_kg, &cup_kg = model.cup.mass_kg;
    at.carriage = SpatialInertia<T>::of_body(carriage_kg, model.carriage.centre_m + slid,
                                             model.carriage.inertia_kg_m2);
    const Vec3<T> cup_arm = at.R_BC * model.cup.centre_m;
    at.cup = SpatialInertia<T>::of_body(
        cup_kg, at.joint_B_m + cup_arm,
        turned_about<1, T>(cos_p, sin_p,
                           turned_about<2, T>(cos_y, sin_y, model.cup.inertia_kg_m2)));

    // The carriage slides on what turns; the cup turns on the hinges besides.
    const T twice = 2.0 * state.joint_rate[0];
    const Vec3<T> coriolis(T(0.0), twice * w.z(), -twice * w.y());
    at.force.carriage = spinning(at.carriage, w);
    at.force.carriage +=
        Spatial<T>::of(coriolis.cross(at.carriage.mass_moment()), -carriage_kg * coriolis);

    const Vec3<T> pitching(T(0.0), state.joint_rate[1], T(0.0));
    const Vec3<T> yawing = state.joint_rate[2] * yaw_axis;
    const Vec3<T> held = w + pitching;
    at.cup_w_B_rad_s = held + yawing;
    at.cup_drift_rad_s2 = w.cross(pitching) + held.cross(yawing);
    const Vec3<T>& wc = at.cup_w_B_rad_s;
    const T wc_squared = wc.squaredNorm();
    const auto swung = [&](const Vec3<T>& arm) -> Vec3<T> {
        return at.cup_drift_rad_s2.cross(arm) + wc.dot(arm) * wc - wc_squared * arm;
    };
    const Vec3<T> cup_origin =
        coriolis + w.dot(at.joint_B_m) * w - w.squaredNorm() * at.joint_B_m - swung(at.joint_B_m);
    at.lip_drift_m_s2 = cup_origin + swung(at.lip_B_m);
    const Vec3<T> h = at.cup.mass_moment();
    at.force.cup = spinning(at.cup, wc);
    at.force.cup += Spatial<T>::of(cup_origin.cross(h) - at.cup.turned(at.cup_drift_rad_s2),
                                   h.cross(at.cup_drift_rad_s2) - cup_kg * cup_origin);
}

}  // namespace limpet::plant
