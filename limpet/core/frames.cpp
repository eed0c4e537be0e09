// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/frames.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "limpet/core/lanes.hpp"

namespace limpet {
namespace {

/// Most rotations are those of a step. Below 0.2 rad the functions of half of one are series in its
/// square (or its tangent's), to the last bits, and cost a tenth.
constexpr double kSmallSquared = 0.04;
constexpr double kArcTangent[] = {1.0,         -1.0 / 3.0, 1.0 / 5.0,   -1.0 / 7.0, 1.0 / 9.0,
                                  -1.0 / 11.0, 1.0 / 13.0, -1.0 / 15.0, 1.0 / 17.0};

/// The angle whose tangent's square is x, over its tangent.
double arc_tangent_over(double x) {
    double sum = *std::rbegin(kArcTangent);
    for (auto next = std::rbegin(kArcTangent) + 1; next != std::rend(kArcTangent); ++next) {
        sum = sum * x + *next;
    }
    return sum;
}

}  // namespace

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
            .pitch_rad = pitch_from_quaternion(q_WB),
            .yaw_rad = std::atan2(R_WB(1, 0), R_WB(0, 0))};
}

double pitch_from_quaternion(const Quaternion& q_WB) {
    const double up = 2.0 * (q_WB.w() * q_WB.y() - q_WB.x() * q_WB.z());  // of x_B in W
    return std::asin(std::clamp(up, -1.0, 1.0));
}

Quaternion quaternion_from_rotation_vector(const Vector3& rotation_rad) {
    const double squared = rotation_rad.squaredNorm();
    Quaternion q;
    if (squared < kSmallSquared) {
        double sine_over = 0.0;
        small_sine_cosine(0.25 * squared, sine_over, q.w());
        q.vec() = 0.5 * sine_over * rotation_rad;
        return q;
    }
    const double angle_rad = std::sqrt(squared);
    q.w() = std::cos(0.5 * angle_rad);
    q.vec() = std::sin(0.5 * angle_rad) / angle_rad * rotation_rad;
    return q;
}

Vector3 rotation_vector_from_quaternion(const Quaternion& q) {
    const double squared = q.vec().squaredNorm();
    const double small = kSmallSquared / 4.0 * q.w() * q.w();
    if (squared < small) {
        const double over = 1.0 / q.w();
        return 2.0 * over * arc_tangent_over(squared * over * over) * q.vec();
    }
    const double sign = q.w() < 0.0 ? -1.0 : 1.0;
    const double sine = std::sqrt(squared);
    return sign * 2.0 * std::atan2(sine, sign * q.w()) / sine * q.vec();
}

Vector3 rotation_vector_from_matrix(const Matrix3& R) {
    const Vector3 twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
    const double squared = twice_sine.squaredNorm();
    const double twice_cosine = R.trace() - 1.0;
    if (twice_cosine < 0.0 || squared > kSmallSquared / 4.0 * twice_cosine * twice_cosine) {
        return rotation_vector_from_quaternion(Quaternion(R));
    }
    const double over = 1.0 / twice_cosine;
    return over * arc_tangent_over(squared * over * over) * twice_sine;
}

Matrix3 skew(const Vector3& v) {
    Matrix3 matrix;
    matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return matrix;
}

}  // namespace limpet
