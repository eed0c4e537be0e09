// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>

/// Vectors, rotations and the few frame conversions that every module shares.
///
/// Alphabet (drawn in docs/conventions.md): W world, north-east-down; B body, forward-right-down,
/// origin at the centre of mass; C cup, forward-right-down when the joint is centred, origin at the
/// centre of the lip; T wall, x into the wall; S sensor. `p_WB` is the position of B's origin in W,
/// `R_WB` and `q_WB` turn a vector of B into W, `v_WB` is the velocity of B's origin in W, `w_WB_B`
/// the angular velocity of B relative to W, in B.
namespace limpet {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

inline constexpr double kPi = 3.14159265358979323846;
/// What was not measured, or did not happen.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Standard gravity [m/s^2]; +z of W points down.
inline constexpr double kGravity_m_s2 = 9.80665;
/// Pressure outside the cup [Pa]. Source: facts.md section 3.
inline constexpr double kAtmosphere_Pa = 101325.0;
/// Sea-level air density [kg/m^3]. Source: ISA.
inline constexpr double kAirDensity_kg_m3 = 1.225;

[[nodiscard]] constexpr double radians(double angle_deg) {
    return angle_deg * (kPi / 180.0);
}
[[nodiscard]] constexpr double degrees(double angle_rad) {
    return angle_rad * (180.0 / kPi);
}
/// What people read pressures in.
[[nodiscard]] constexpr double hectopascals(double pressure_Pa) {
    return 0.01 * pressure_Pa;
}

/// Roll, pitch, yaw of the aerospace z-y'-x'' sequence [rad].
struct Euler {
    double roll_rad = 0.0;
    double pitch_rad = 0.0;
    double yaw_rad = 0.0;
};

/// @param angle_rad  any finite angle [rad]
/// @return the same angle in (-pi, pi] [rad]
[[nodiscard]] double wrap_pi(double angle_rad);

/// @return q_WB of a body with these angles, w >= 0
[[nodiscard]] Quaternion quaternion_from_euler(const Euler& angles);

/// @param q_WB  unit quaternion
/// @return angles, pitch in [-pi/2, pi/2]
[[nodiscard]] Euler euler_from_quaternion(const Quaternion& q_WB);

/// The pitch of euler_from_quaternion() alone.
[[nodiscard]] double pitch_from_quaternion(const Quaternion& q_WB);

/// Rotation by the vector `rotation_rad` (axis times angle), exact at zero.
[[nodiscard]] Quaternion quaternion_from_rotation_vector(const Vector3& rotation_rad);

/// Inverse of quaternion_from_rotation_vector; the shorter way round.
[[nodiscard]] Vector3 rotation_vector_from_quaternion(const Quaternion& q);

/// The rotation vector of a rotation matrix; the shorter way round.
[[nodiscard]] Vector3 rotation_vector_from_matrix(const Matrix3& R);

/// @return the matrix [v]x with [v]x u = v x u
[[nodiscard]] Matrix3 skew(const Vector3& v);

}  // namespace limpet
