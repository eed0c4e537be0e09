// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "limpet/core/frames.hpp"
#include "limpet/core/unrolled.hpp"
#include "limpet/core/within_step.hpp"
#include "limpet/vehicle/airframe.hpp"

// The vehicle as bodies, in closed form: a base that is free in space, a carriage that slides on it
// along x, and a cup on two hinges at the carriage's front, pitch about the base's y, then yaw
// about the cup's own z. Every vehicle with our cup is of this shape. Written on a scalar type T.
//
// Nine speeds: that of B's origin and the angular velocity, both in B, then slider, pitch, yaw.
//   M dv/dt = f,  M the mass matrix, f gravity and what follows from the speeds.
// The first three accelerations are those of B's origin as seen from W, in the axes of B.
// Source: Featherstone, "Rigid Body Dynamics Algorithms", 2008, chapters 3 and 6; checked against
// MuJoCo's to 1e-10 (tests/plant).
namespace limpet::plant {

inline constexpr int kFreedoms = 9;
inline constexpr int kJoints = 3;  ///< slider, cup_pitch, cup_yaw
inline constexpr int kFirstJoint = 6;

template <class T>
using Vec3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Mat3 = Eigen::Matrix<T, 3, 3>;
template <class T>
using Speeds = std::array<T, kFreedoms>;

/// Immutable numbers of the bodies.
struct MechanismModel {
    bool has_cup = true;
    vehicle::BodyInertia base;      ///< in B
    vehicle::BodyInertia carriage;  ///< in B with the slider at its outer stop
    vehicle::BodyInertia cup;       ///< centre from the joint; joint centred
    Matrix3 base_about_B_kg_m2 = Matrix3::Zero();
    Vector3 joint_B_m = Vector3::Zero();
    double lip_m = 0.0;  ///< ahead of the joint
    double mass_kg = 0.0;
    std::array<vehicle::JointLaw, kJoints> joints;
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

/// Six numbers side by side: a row of what six unit wrenches do.
template <class T>
struct Six {
    std::array<T, 6> at{};

    [[gnu::always_inline]] Six& operator+=(const Six& other) {
        for (std::size_t i = 0; i < 6; ++i) {
            at[i] += other.at[i];
        }
        return *this;
    }
    [[gnu::always_inline]] Six& operator-=(const Six& other) {
        for (std::size_t i = 0; i < 6; ++i) {
            at[i] -= other.at[i];
        }
        return *this;
    }
    [[gnu::always_inline]] friend Six operator*(const T& factor, const Six& six) {
        Six scaled;
        for (std::size_t i = 0; i < 6; ++i) {
            scaled.at[i] = factor * six.at[i];
        }
        return scaled;
    }
    void set(const Vec3<T>& first, const Vec3<T>& second) {
        for (int i = 0; i < 3; ++i) {
            at[static_cast<std::size_t>(i)] = first[i];
            at[static_cast<std::size_t>(3 + i)] = second[i];
        }
    }
};

/// A symmetric matrix, of which the lower triangle is kept.
template <class T>
struct SpeedMatrix {
    std::array<T, kFreedoms*(kFreedoms + 1) / 2> lower{};

    static constexpr std::size_t place(int i, int j) {
        return static_cast<std::size_t>(i * (i + 1) / 2 + j);
    }
    /// @param j  <= i
    T& operator()(int i, int j) { return lower[place(i, j)]; }
    const T& operator()(int i, int j) const { return lower[place(i, j)]; }
};

/// Its factors: M = L D L', L below the diagonal, 1 / D on it.
template <class T>
struct SpeedFactors : SpeedMatrix<T> {
    /// x -> L^-1 x, of one or several x: an array of numbers or of rows.
    template <class Rows>
    void forward(Rows& x) const {
        unrolled<kFreedoms>([&](auto i) [[gnu::always_inline]] {
            auto row = x[i.value];
            unrolled<i.value>([&](auto j) [[gnu::always_inline]] {
                row -= (*this)(i.value, j.value) * x[j.value];
            });
            x[i.value] = row;
        });
    }
    /// x -> L'^-1 D^-1 x, after forward(): the solution.
    void backward(Speeds<T>& x) const {
        unrolled<kFreedoms>(
            [&](auto i) [[gnu::always_inline]] { x[i.value] *= (*this)(i.value, i.value); });
        unrolled<kFreedoms>([&](auto k) [[gnu::always_inline]] {
            constexpr int kRow = kFreedoms - 1 - k.value;
            unrolled<kRow>([&](auto j) [[gnu::always_inline]] {
                x[j.value] -= (*this)(kRow, j.value) * x[kRow];
            });
        });
    }
};

template <class T>
void factorise(const SpeedMatrix<T>& matrix, SpeedFactors<T>& factors) {
    unrolled<kFreedoms>([&](auto i) [[gnu::always_inline]] {
        constexpr int kRow = i.value;
        unrolled<kRow>([&](auto j) [[gnu::always_inline]] {
            T sum = matrix(kRow, j.value);
            unrolled<j.value>([&](auto k) [[gnu::always_inline]] {
                sum -=
                    factors(kRow, k.value) * factors(j.value, k.value);  // this row still times D
            });
            factors(kRow, j.value) = sum;
        });
        T pivot = matrix(kRow, kRow);
        unrolled<kRow>([&](auto j) [[gnu::always_inline]] {
            const T scaled = factors(kRow, j.value) * factors(j.value, j.value);
            pivot -= scaled * factors(kRow, j.value);
            factors(kRow, j.value) = scaled;
        });
        factors(kRow, kRow) = 1.0 / pivot;
    });
}

/// Where everything is at one state, how it resists, and what pulls at it.
template <class T>
struct Mechanism {
    Mat3<T> R_WB;
    Mat3<T> R_BC = Mat3<T>::Identity();
    Vec3<T> joint_B_m = Vec3<T>::Zero();
    Vec3<T> lip_B_m = Vec3<T>::Zero();  ///< from B's origin
    Vec3<T> yaw_axis_B = Vec3<T>::UnitZ();
    Vec3<T> lip_arm_B_m = Vec3<T>::Zero();       ///< from the joint
    Vec3<T> cup_w_B_rad_s = Vec3<T>::Zero();     ///< of the cup in W, axes of B
    Vec3<T> lip_drift_B_m_s2 = Vec3<T>::Zero();  ///< the lip's acceleration while no speed changes
    Vec3<T> cup_drift_B_rad_s2 = Vec3<T>::Zero();
    SpeedMatrix<T> mass;
    Speeds<T> force{};

    /// @return J' of a wrench at a point of the base
    [[nodiscard]] Speeds<T> on_base(const Vec3<T>& p_B_m, const Vec3<T>& force_B,
                                    const Vec3<T>& moment_B) const {
        const Vec3<T> turning = moment_B + p_B_m.cross(force_B);
        return {force_B.x(), force_B.y(), force_B.z(), turning.x(), turning.y(), turning.z()};
    }
    /// @return J' of a wrench on the cup about the lip's centre
    [[nodiscard]] Speeds<T> on_lip(const Vec3<T>& force_B, const Vec3<T>& moment_B) const {
        Speeds<T> pushed = on_base(lip_B_m, force_B, moment_B);
        const Vec3<T> about_joint = moment_B + lip_arm_B_m.cross(force_B);
        pushed[6] = force_B.x();
        pushed[7] = about_joint.y();
        pushed[8] = yaw_axis_B.dot(about_joint);
        return pushed;
    }
    static void add(Speeds<T>& to, const Speeds<T>& what) {
        for (std::size_t i = 0; i < to.size(); ++i) {
            to[i] += what[i];
        }
    }
};

template <class T>
[[nodiscard]] T dot(const Speeds<T>& a, const Speeds<T>& b) {
    T sum = a[0] * b[0];
    for (std::size_t i = 1; i < a.size(); ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

namespace mechanism_parts {

/// Adds -m [c]x[c]x: a body's inertia about another point.
template <class T>
void add_steiner(Mat3<T>& inertia, const T& mass_kg, const Vec3<T>& c) {
    const T xx = mass_kg * c.x() * c.x(), yy = mass_kg * c.y() * c.y(),
            zz = mass_kg * c.z() * c.z();
    const T xy = mass_kg * c.x() * c.y(), xz = mass_kg * c.x() * c.z(),
            yz = mass_kg * c.y() * c.z();
    inertia(0, 0) += yy + zz;
    inertia(1, 1) += xx + zz;
    inertia(2, 2) += xx + yy;
    inertia(1, 0) -= xy;
    inertia(2, 0) -= xz;
    inertia(2, 1) -= yz;
}

template <class T>
void put(SpeedMatrix<T>& mass, int row, int column, const Vec3<T>& values) {
    for (int i = 0; i < 3; ++i) {
        mass(row, column + i) = values[i];
    }
}

}  // namespace mechanism_parts

/// The mechanism at a state, under gravity alone.
/// @param at  is filled
template <class T>
void place_mechanism(const MechanismModel& model, const MechanismState<T>& state,
                     Mechanism<T>& at) {
    using mechanism_parts::add_steiner;
    using mechanism_parts::put;
    using std::cos;
    using std::sin;
    at.R_WB = state.q_WB.toRotationMatrix();
    const Vec3<T>& w = state.w_WB_B_rad_s;
    SpeedMatrix<T>& mass = at.mass;
    Mat3<T> about_B = model.base_about_B_kg_m2.template cast<T>();
    Vec3<T> moment_kg_m = (model.base.mass_kg * model.base.centre_B_m).template cast<T>();

    // What the speeds ask for: m a of each centre while no speed changes, and its moment about B.
    const T w_squared = w.squaredNorm();
    const auto circled = [&w, &w_squared](const Vec3<T>& arm) -> Vec3<T> {  // w x (w x arm)
        return w.dot(arm) * w - w_squared * arm;
    };
    Vec3<T> inertial_N = -circled(moment_kg_m);
    // Of a body about another point than its centre, turning about that: as one about its centre.
    Vec3<T> inertial_N_m = -w.cross(Vec3<T>(model.base_about_B_kg_m2.template cast<T>() * w));

    if (model.has_cup) {
        const T sin_p = sin(state.joint[1]), cos_p = cos(state.joint[1]);
        const T sin_y = sin(state.joint[2]), cos_y = cos(state.joint[2]);
        at.R_BC << cos_p * cos_y, -cos_p * sin_y, sin_p,  //
            sin_y, cos_y, T(0.0),                         //
            -sin_p * cos_y, sin_p * sin_y, cos_p;
        at.yaw_axis_B = at.R_BC.col(2);
        const Vec3<T> slid(state.joint[0], T(0.0), T(0.0));
        at.joint_B_m = model.joint_B_m.template cast<T>() + slid;
        at.lip_arm_B_m = model.lip_m * at.R_BC.col(0);
        at.lip_B_m = at.joint_B_m + at.lip_arm_B_m;
        const Vec3<T> carriage_B = model.carriage.centre_B_m.template cast<T>() + slid;
        const Vec3<T> arm_B = at.R_BC * model.cup.centre_B_m.template cast<T>();
        const Vec3<T> cup_B = at.joint_B_m + arm_B;
        Mat3<T> cup_own;
        cup_own.noalias() = (at.R_BC * model.cup.inertia_kg_m2.template cast<T>())
                                .eval()
                                .lazyProduct(at.R_BC.transpose());
        const T carriage_kg(model.carriage.mass_kg), cup_kg(model.cup.mass_kg);
        const Mat3<T> carriage_own = model.carriage.inertia_kg_m2.template cast<T>();

        about_B += carriage_own + cup_own;
        add_steiner(about_B, carriage_kg, carriage_B);
        add_steiner(about_B, cup_kg, cup_B);
        moment_kg_m += carriage_kg * carriage_B + cup_kg * cup_B;

        // Slider: unit x; hinges: axis, and what it moves the cup's centre by.
        const Vec3<T> pitch_axis = Vec3<T>::UnitY();
        const Vec3<T> pitch_arm = pitch_axis.cross(arm_B);
        const Vec3<T> yaw_arm = at.yaw_axis_B.cross(arm_B);
        put<T>(mass, 6, 0, (carriage_kg + cup_kg) * Vec3<T>::UnitX());
        put<T>(mass, 6, 3,
               (carriage_kg * carriage_B + cup_kg * cup_B).cross(Vec3<T>(Vec3<T>::UnitX())));
        mass(6, 6) = carriage_kg + cup_kg;
        const auto hinge = [&](int row, const Vec3<T>& axis, const Vec3<T>& arm) {
            const Vec3<T> momentum = cup_kg * arm;
            const Vec3<T> spin = cup_own * axis;
            put<T>(mass, row, 0, momentum);
            put<T>(mass, row, 3, spin + cup_B.cross(momentum));
            mass(row, 6) = momentum.x();
            mass(row, 7) = spin.y() + momentum.dot(pitch_arm);
            if (row == 8) {
                mass(8, 8) = axis.dot(spin) + momentum.dot(yaw_arm);
            }
        };
        hinge(7, pitch_axis, pitch_arm);
        hinge(8, at.yaw_axis_B, yaw_arm);

        const Vec3<T> pitching = state.joint_rate[1] * pitch_axis;
        const Vec3<T> yawing = state.joint_rate[2] * at.yaw_axis_B;
        at.cup_w_B_rad_s = w + pitching + yawing;
        at.cup_drift_B_rad_s2 = w.cross(pitching) + (w + pitching).cross(yawing);
        const T twice = 2.0 * state.joint_rate[0];
        const Vec3<T> coriolis(T(0.0), twice * w.z(), -twice * w.y());
        const auto swung = [&](const Vec3<T>& arm) -> Vec3<T> {
            return at.cup_drift_B_rad_s2.cross(arm) +
                   at.cup_w_B_rad_s.cross(at.cup_w_B_rad_s.cross(arm));
        };
        const Vec3<T> joint_a = circled(at.joint_B_m) + coriolis;
        at.lip_drift_B_m_s2 = joint_a + swung(at.lip_arm_B_m);
        const Vec3<T> carriage_N = -carriage_kg * (circled(carriage_B) + coriolis);
        const Vec3<T> cup_N = -cup_kg * (joint_a + swung(arm_B));
        const Vec3<T> cup_N_m = -(cup_own * at.cup_drift_B_rad_s2 +
                                  at.cup_w_B_rad_s.cross(Vec3<T>(cup_own * at.cup_w_B_rad_s)));
        inertial_N += carriage_N + cup_N;
        inertial_N_m += carriage_B.cross(carriage_N) - w.cross(Vec3<T>(carriage_own * w)) +
                        cup_B.cross(cup_N) + cup_N_m;
        const Vec3<T> about_joint = cup_N_m + arm_B.cross(cup_N);
        at.force[6] = carriage_N.x() + cup_N.x();
        at.force[7] = about_joint.y();
        at.force[8] = at.yaw_axis_B.dot(about_joint);
    } else {
        for (int i = kFirstJoint; i < kFreedoms; ++i) {
            mass(i, i) = T(1.0);  // none: stays where it is
        }
    }

    for (int i = 0; i < 3; ++i) {
        mass(i, i) = T(model.mass_kg);
        for (int j = 0; j <= i; ++j) {
            mass(3 + i, 3 + j) = about_B(i, j);
        }
    }
    // m [c]x: what turning does to momentum.
    mass(3, 1) = -moment_kg_m.z();
    mass(3, 2) = moment_kg_m.y();
    mass(4, 0) = moment_kg_m.z();
    mass(4, 2) = -moment_kg_m.x();
    mass(5, 0) = -moment_kg_m.y();
    mass(5, 1) = moment_kg_m.x();

    const Vec3<T> gravity_B = kGravity_m_s2 * at.R_WB.row(2).transpose();
    for (int i = 0; i < 3; ++i) {
        at.force[static_cast<std::size_t>(i)] = inertial_N[i] + model.mass_kg * gravity_B[i];
        at.force[static_cast<std::size_t>(3 + i)] = inertial_N_m[i];
    }
    const Vec3<T> weight_N_m = moment_kg_m.cross(gravity_B);
    for (int i = 0; i < 3; ++i) {
        at.force[static_cast<std::size_t>(3 + i)] += weight_N_m[i];
        for (int j = kFirstJoint; j < kFreedoms; ++j) {
            at.force[static_cast<std::size_t>(j)] += mass(j, i) * gravity_B[i];
        }
    }
}

}  // namespace limpet::plant
