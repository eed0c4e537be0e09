// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limpet/autopilot/estimator.hpp"

namespace limpet::autopilot {
namespace {

/// Source: PX4's limit for external positions.
constexpr double kBelieveAfter_s = 1.0;
/// How little is known, at least, of velocity once it has led the position astray.
constexpr double kLostVelocity_m_s = 1.0;
constexpr double kLostAttitude_rad = 0.5;

double square(double value) {
    return value * value;
}

/// Velocity gained from specific force since then, in W.
Vector3 force_gain_W(const Instant& at) {
    return at.now.v_WB_m_s - at.then.v_WB_m_s - Vector3(0.0, 0.0, kGravity_m_s2 * at.age_s);
}

/// From B then to B now, by way of W.
Vector3 in_present_B(const Instant& at, const Vector3& then_B) {
    return at.now.q_WB.conjugate() * (at.then.q_WB * then_B);
}

void open_up(Fusion& fusion, int block, double deviation) {
    for (int error = block; error < block + 3; ++error) {
        reset_error(fusion.covariance, error, square(deviation));
        if (fusion.followed != nullptr) {
            fusion.followed->row(error).setZero();
        }
    }
}

/// A position is believed of the moment of its measurement: since then an error of velocity has
/// gone on to move it.
void know_from_then(Covariance& covariance, const Measurement& measurement) {
    for (int i = 0; i < measurement.rows; ++i) {
        const JacobianRow& h = measurement.jacobian[static_cast<std::size_t>(i)];
        for (int axis = 0; axis < 3; ++axis) {
            const int p = kPosition + axis;
            const int v = kVelocity + axis;
            if (h[p] == 1.0) {
                covariance(p, v) = covariance(v, p) = -h[v] * covariance(v, v);
                covariance(p, p) += h[v] * h[v] * covariance(v, v);
            }
        }
    }
}

/// Of the row that is furthest off.
double worst_nis(const Fusion& fusion, const Measurement& measurement) {
    double worst = 0.0;
    for (int i = 0; i < measurement.rows; ++i) {
        const auto row = static_cast<std::size_t>(i);
        const JacobianRow& h = measurement.jacobian[row];
        const double innovation = measurement.innovation[row] - h.dot(fusion.correction);
        worst = std::max(worst, square(innovation) /
                                    (h.variance(fusion.covariance) + measurement.variance[row]));
    }
    return worst;
}

/// Takes the innovation as the error.
/// @param astray_s  for how long it has not fitted
void believe(Fusion& fusion, const Measurement& measurement, double astray_s, int block) {
    bool observed = false;
    double astray_m = 0.0;
    for (int i = 0; i < measurement.rows; ++i) {
        const auto row = static_cast<std::size_t>(i);
        for (int error = block; error < block + 3; ++error) {
            if (measurement.jacobian[row][error] == 1.0) {
                fusion.correction[error] = measurement.innovation[row];
                reset_error(fusion.covariance, error, measurement.variance[row]);
                if (fusion.followed != nullptr) {
                    fusion.followed->row(error).setZero();
                    if (fusion.wanders) {
                        (*fusion.followed)(error, error - block) = -1.0;
                    }
                }
                observed = true;
            }
        }
        astray_m = std::max(astray_m, std::abs(measurement.innovation[row]));
    }
    if (block == kPosition) {
        open_up(fusion, kVelocity, std::max(kLostVelocity_m_s, astray_m / astray_s));
        know_from_then(fusion.covariance, measurement);
    }
    if (!observed) {  // a field says nothing of the turn about it: let the next ones pass the gate
        open_up(fusion, block, kLostAttitude_rad);
    }
}

}  // namespace

std::optional<Instant> instant(const Navigation& now, const ImuHistory& history, double age_s) {
    const std::optional<Navigation> then = past(now, history, age_s);
    if (!then) {
        return std::nullopt;
    }
    return Instant{.age_s = age_s, .then = *then, .now = now};
}

Measurement measure_position(const Instant& at, const Vector3& p_WB_m, const Vector3& noise_m,
                             const std::array<bool, 3>& axes) {
    Measurement measurement;
    for (int axis = 0; axis < 3; ++axis) {
        if (axes[static_cast<std::size_t>(axis)]) {
            JacobianRow h;
            h.put(kPosition + axis, 1.0);
            h.put(kVelocity + axis, -at.age_s);
            add_row(measurement, h, p_WB_m[axis] - at.then.p_WB_m[axis], square(noise_m[axis]));
        }
    }
    return measurement;
}

Measurement measure_velocity(const Instant& at, const Vector3& v_WB_m_s, const Vector3& noise_m_s) {
    const Matrix3 R_WB = at.now.q_WB.toRotationMatrix();
    const Matrix3 by_attitude = skew(force_gain_W(at)) * R_WB;
    Measurement measurement;
    for (int axis = 0; axis < 3; ++axis) {
        JacobianRow h;
        h.put(kVelocity + axis, 1.0);
        h.put(kAttitude, Vector3(by_attitude.row(axis)));
        h.put(kAccelerometerBias, Vector3(at.age_s * R_WB.row(axis)));
        add_row(measurement, h, v_WB_m_s[axis] - at.then.v_WB_m_s[axis], square(noise_m_s[axis]));
    }
    return measurement;
}

Measurement measure_attitude(const Instant& at, const Quaternion& q_WB, double noise_rad) {
    const Vector3 error = in_present_B(
        at, rotation_vector_from_quaternion(at.then.q_WB.conjugate() * q_WB.normalized()));
    Measurement measurement;
    for (int axis = 0; axis < 3; ++axis) {
        JacobianRow h;
        h.put(kAttitude + axis, 1.0);
        h.put(kGyroBias + axis, at.age_s);
        add_row(measurement, h, error[axis], square(noise_rad));
    }
    return measurement;
}

Measurement measure_field(const Instant& at, const Vector3& field_B_gauss,
                          const Vector3& field_W_gauss, double noise_gauss) {
    const Vector3 expected_gauss = at.now.q_WB.conjugate() * field_W_gauss;
    const Vector3 error_gauss = in_present_B(at, field_B_gauss) - expected_gauss;
    const Matrix3 by_attitude = skew(expected_gauss);
    Measurement measurement;
    for (int axis = 0; axis < 3; ++axis) {
        JacobianRow h;
        h.put(kAttitude, Vector3(by_attitude.row(axis)));
        h.put(kGyroBias, Vector3(at.age_s * by_attitude.row(axis)));
        add_row(measurement, h, error_gauss[axis], square(noise_gauss));
    }
    return measurement;
}

void fuse(Fusion& fusion, Aiding& aiding, const Measurement& measurement, double stamp_s,
          double gate, int block) {
    aiding.nis_s = stamp_s;
    if (passes(fusion.covariance, fusion.correction, measurement, gate)) {
        Gains gains;
        const bool follows = fusion.followed != nullptr;
        aiding.nis =
            update(fusion.covariance, fusion.correction, measurement, follows ? &gains : nullptr) /
            std::max(1, measurement.rows);
        if (follows) {
            update(*fusion.followed, measurement, gains, fusion.wanders);
        }
    } else {
        aiding.nis = worst_nis(fusion, measurement);
        if (aiding.rejected++ == 0) {
            aiding.rejected_since_s = stamp_s;
        }
        const double astray_s = stamp_s - aiding.rejected_since_s;
        if (astray_s < kBelieveAfter_s) {
            return;
        }
        believe(fusion, measurement, astray_s, block);
    }
    aiding.fused_s = stamp_s;
    aiding.rejected = 0;
}

}  // namespace limpet::autopilot
