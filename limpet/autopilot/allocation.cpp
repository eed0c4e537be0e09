// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/allocation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::autopilot {
namespace {

/// Share of the range by which yaw may overdrive a motor before it yields; thrust pays for it.
constexpr double kYawMargin = 0.15;
/// Torque not given that counts as saturation.
constexpr double kUnallocated = 1e-6;
/// Mixer entries below this are round-off of a symmetric frame. Source: PX4.
constexpr double kNegligible = 1e-3;

/// Torque about B and thrust of each rotor per newton; rows roll, pitch, yaw, thrust.
Eigen::Matrix4d effectiveness(const std::array<RotorGeometry, kRotors>& rotors) {
    Eigen::Matrix4d matrix;
    for (int i = 0; i < kRotors; ++i) {
        const RotorGeometry& rotor = rotors[static_cast<std::size_t>(i)];
        matrix.col(i) << -rotor.p_B_m.y(), rotor.p_B_m.x(),
            rotor.direction * rotor.moment_constant_m, 1.0;
    }
    return matrix;
}

/// PX4's scale of roll and pitch: the root of twice the mean square of the entries that count.
double torque_scale(const RotorVector& column) {
    const auto count = (column.array().abs() > kNegligible).count();
    return count == 0 ? 0.0 : std::sqrt(column.squaredNorm() / (static_cast<double>(count) / 2.0));
}

RotorVector without_round_off(const RotorVector& column) {
    return (column.array().abs() < kNegligible).select(RotorVector::Zero(), column);
}

/// How far to go along `direction` to lessen the worst overdrive above and below.
double desaturation_gain(const RotorVector& direction, const RotorVector& command, double highest) {
    double least = 0.0;
    double most = 0.0;
    for (int i = 0; i < kRotors; ++i) {
        if (std::abs(direction[i]) < kNegligible) {
            continue;
        }
        const double excess = std::clamp(command[i], 0.0, highest) - command[i];
        const double gain = excess / direction[i];
        least = std::min(least, gain);
        most = std::max(most, gain);
    }
    return least + most;
}

enum class Sign {
    any,
    decrease_only
};

void desaturate(RotorVector& command, const RotorVector& direction, Sign sign,
                double highest = 1.0) {
    if (command.minCoeff() >= 0.0 && command.maxCoeff() <= highest) {
        return;  // nothing is overdriven, as nearly always
    }
    const double gain = desaturation_gain(direction, command, highest);
    if (sign == Sign::decrease_only && gain > 0.0) {
        return;
    }
    command += gain * direction;
    // what is left is overdriven both above and below: share it
    command += 0.5 * desaturation_gain(direction, command, highest) * direction;
}

}  // namespace

Mixer make_mixer(const std::array<RotorGeometry, kRotors>& rotors) {
    const Eigen::Matrix4d matrix = effectiveness(rotors);
    const Eigen::FullPivLU<Eigen::Matrix4d> decomposition(matrix);
    if (!matrix.allFinite() || !decomposition.isInvertible()) {
        throw InputError(
            "rotors: positions and directions cannot make roll, pitch, yaw and thrust "
            "independently");
    }
    const Eigen::Matrix4d mix = decomposition.inverse();
    const double tilt_scale = std::max(torque_scale(mix.col(0)), torque_scale(mix.col(1)));
    Mixer mixer;
    mixer.roll = without_round_off(mix.col(0) / tilt_scale);
    mixer.pitch = without_round_off(mix.col(1) / tilt_scale);
    mixer.yaw = without_round_off(mix.col(2) / mix.col(2).maxCoeff());
    mixer.thrust = without_round_off(mix.col(3) / mix.col(3).cwiseAbs().mean());
    Eigen::Matrix4d normalised;
    normalised << mixer.roll, mixer.pitch, mixer.yaw, mixer.thrust;
    mixer.inverse = normalised.inverse();
    return mixer;
}

Allocation allocate(const Mixer& mixer, const Vector3& torque, double thrust) {
    RotorVector command =
        mixer.roll * torque.x() + mixer.pitch * torque.y() + mixer.thrust * thrust;
    desaturate(command, mixer.thrust, Sign::decrease_only);
    desaturate(command, mixer.roll, Sign::any);
    desaturate(command, mixer.pitch, Sign::any);
    command += mixer.yaw * torque.z();
    desaturate(command, mixer.yaw, Sign::any, 1.0 + kYawMargin);
    desaturate(command, mixer.thrust, Sign::decrease_only);
    command = command.cwiseMax(0.0).cwiseMin(1.0);

    const Vector3 given = (mixer.inverse * command).head<3>();
    Allocation result;
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        result.saturation.positive[axis] = torque[i] - given[i] > kUnallocated;
        result.saturation.negative[axis] = torque[i] - given[i] < -kUnallocated;
    }
    for (int i = 0; i < kRotors; ++i) {
        result.command[static_cast<std::size_t>(i)] = command[i];
    }
    return result;
}

}  // namespace limpet::autopilot
