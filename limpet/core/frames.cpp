// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/frames.hpp"

#include <algorithm>
#include <cmath>

namespace limpet {

double wrap_pi(double angle_rad) {
    const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
    return wrapped <= -kPi ? kPi : wrapped;
}

Quaternion quaternion_from_euler(const Euler& angles) {
    Quaternion q = Eigen::AngleAxisd(angles.yaw_rad, Vector3::UnitZ()) *
                   Eigen::AngleAxisd(angles.pitch_rad, Vector3::UnitY()) *
                   Eigen::AngleAxisd(angles.roll_rad, Vector3::UnitX());
    if (q.w() < 0.0) {
        q.coeffs() = -q.coeffs();
    }
    return q.normalized();
}

Euler euler_from_quaternion(const Quaternion& q_WB) {
    const Matrix3 R_WB = q_WB.toRotationMatrix();
    return {.roll_rad = std::atan2(R_WB(2, 1), R_WB(2, 2)),
            .pitch_rad = std::asin(std::clamp(-R_WB(2, 0), -1.0, 1.0)),
            .yaw_rad = std::atan2(R_WB(1, 0), R_WB(0, 0))};
}

Quaternion quaternion_from_rotation_vector(const Vector3& rotation_rad) {
    const double angle_rad = rotation_rad.norm();
    // sin(a/2)/a by its series where the quotient would lose digits
    const double scale = angle_rad < 1e-6 ? 0.5 - angle_rad * angle_rad / 48.0
                                          : std::sin(0.5 * angle_rad) / angle_rad;
    Quaternion q;
    q.w() = std::cos(0.5 * angle_rad);
    q.vec() = scale * rotation_rad;
    return q;
}

Vector3 rotation_vector_from_quaternion(const Quaternion& q) {
    const double sign = q.w() < 0.0 ? -1.0 : 1.0;
    const Vector3 vec = sign * q.vec();
    const double sine = vec.norm();
    const double cosine = sign * q.w();
    const double scale = sine < 1e-9 ? 2.0 : 2.0 * std::atan2(sine, cosine) / sine;
    return scale * vec;
}

Matrix3 skew(const Vector3& v) {
    Matrix3 matrix;
    matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return matrix;
}

}  // namespace limpet
