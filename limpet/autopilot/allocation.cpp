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
EffectMatrix effectiveness(const RotorList<RotorGeometry>& rotors) {
    EffectMatrix matrix(4, static_cast<Eigen::Index>(rotors.size()));
    for (Eigen::Index i = 0; i < matrix.cols(); ++i) {
        const RotorGeometry& rotor = rotors[static_cast<std::size_t>(i)];
        matrix.col(i) << -rotor.p_B_m.y(), rotor.p_B_m.x(),
            rotor.direction * rotor.moment_constant_m, 1.0;
    }
    return matrix;
}

/// Of least norm: columns roll, pitch, yaw, thrust. Of four rotors it is the inverse.
Eigen::Matrix<double, Eigen::Dynamic, 4> pseudo_inverse(const EffectMatrix& matrix) {
    if (matrix.cols() == 4) {
        return Eigen::FullPivLU<Eigen::Matrix4d>(matrix).inverse();
    }
    const Eigen::Matrix4d square = matrix * matrix.transpose();
    return matrix.transpose() * square.inverse();
}

/// PX4's scale of roll and pitch: the root of twice the mean square of the entries that count.
double torque_scale(const RotorVector& column) {
    const auto count = (column.array().abs() > kNegligible).count();
    return count == 0 ? 0.0 : std::sqrt(column.squaredNorm() / (static_cast<double>(count) / 2.0));
}

RotorVector without_round_off(const RotorVector& column) {
    return (column.array().abs() < kNegligible).select(0.0, column);
}

/// A number a rotor of a mixer; how many may be known to the compiler, as of four it is.
template <int kCount>
using Each = Eigen::Matrix<double, kCount, 1, 0,
                           kCount == Eigen::Dynamic ? static_cast<int>(kMaxRotors) : kCount, 1>;
template <int kCount>
using Column = Eigen::Map<const Each<kCount>>;

/// How far to go along `direction` to lessen the worst overdrive above and below.
template <int kCount>
double desaturation_gain(const Column<kCount>& direction, const Each<kCount>& command,
                         double highest) {
    double least = 0.0;
    double most = 0.0;
    for (Eigen::Index i = 0; i < command.size(); ++i) {
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

template <int kCount>
void desaturate(Each<kCount>& command, const Column<kCount>& direction, Sign sign,
                double highest = 1.0) {
    if (command.minCoeff() >= 0.0 && command.maxCoeff() <= highest) {
        return;  // nothing is overdriven, as nearly always
    }
    const double gain = desaturation_gain<kCount>(direction, command, highest);
    if (sign == Sign::decrease_only && gain > 0.0) {
        return;
    }
    command += gain * direction;
    // what is left is overdriven both above and below: share it
    command += 0.5 * desaturation_gain<kCount>(direction, command, highest) * direction;
}

template <int kCount>
Allocation allocate_each(const Mixer& mixer, const Vector3& torque, double thrust) {
    const auto column = [](const RotorVector& of) { return Column<kCount>(of.data(), of.size()); };
    const Column<kCount> roll = column(mixer.roll), pitch = column(mixer.pitch),
                         yaw = column(mixer.yaw), lift = column(mixer.thrust);
    Each<kCount> command = roll * torque.x() + pitch * torque.y() + lift * thrust;
    desaturate<kCount>(command, lift, Sign::decrease_only);
    desaturate<kCount>(command, roll, Sign::any);
    desaturate<kCount>(command, pitch, Sign::any);
    command += yaw * torque.z();
    desaturate<kCount>(command, yaw, Sign::any, 1.0 + kYawMargin);
    desaturate<kCount>(command, lift, Sign::decrease_only);
    command = command.cwiseMax(0.0).cwiseMin(1.0);

    constexpr int kMost = Each<kCount>::MaxRowsAtCompileTime;
    const Eigen::Map<const Eigen::Matrix<double, 4, kCount, 0, 4, kMost>> effect(
        mixer.effect.data(), 4, mixer.effect.cols());
    const Vector3 given = (effect * command).template head<3>();
    Allocation result;
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        result.saturation.positive[axis] = torque[i] - given[i] > kUnallocated;
        result.saturation.negative[axis] = torque[i] - given[i] < -kUnallocated;
    }
    result.command.resize(mixer.rotors());
    std::copy_n(command.data(), command.size(), result.command.begin());
    return result;
}

}  // namespace

Mixer make_mixer(const RotorList<RotorGeometry>& rotors) {
    const EffectMatrix matrix = effectiveness(rotors);
    if (!matrix.allFinite() || Eigen::FullPivLU<EffectMatrix>(matrix).rank() < 4) {
        throw InputError(
            "rotors: positions and directions cannot make roll, pitch, yaw and thrust "
            "independently");
    }
    const auto mix = pseudo_inverse(matrix);
    const double tilt_scale = std::max(torque_scale(mix.col(0)), torque_scale(mix.col(1)));
    Mixer mixer;
    mixer.roll = without_round_off(mix.col(0) / tilt_scale);
    mixer.pitch = without_round_off(mix.col(1) / tilt_scale);
    const double yaw_scale = mix.col(2).maxCoeff();
    const double thrust_scale = mix.col(3).cwiseAbs().mean();
    mixer.yaw = without_round_off(mix.col(2) / yaw_scale);
    mixer.thrust = without_round_off(mix.col(3) / thrust_scale);
    if (mixer.thrust.minCoeff() < 0.0) {
        throw InputError("rotors: to hover one of them would have to push down");
    }
    mixer.effect =
        Eigen::Vector4d(tilt_scale, tilt_scale, yaw_scale, thrust_scale).asDiagonal() * matrix;
    return mixer;
}

Allocation allocate(const Mixer& mixer, const Vector3& torque, double thrust) {
    return mixer.rotors() == 4 ? allocate_each<4>(mixer, torque, thrust)
                               : allocate_each<Eigen::Dynamic>(mixer, torque, thrust);
}

}  // namespace limpet::autopilot
