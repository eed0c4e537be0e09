// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/turning_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFine_s = 1e-3;  ///< of the motors' model, as the simulation's
constexpr int kLags = 2, kInertias = 3;

/// Moment of the rotors, integrated over time, and the sum of their speeds, at the IMU's samples.
struct Driven {
    std::array<VectorXd, 3> spin_N_m_s;
    std::vector<double> speed_sum_rad_s;
};

/// A rotor's moment in B for each squared speed.
std::vector<Vector3> arms_of(const vehicle::AirframeNumbers& airframe) {
    std::vector<Vector3> arms;
    for (const vehicle::Rotor& rotor : airframe.rotors) {
        const double thrust = rotor.thrust_share * airframe.rotor.motor_constant_kg_m;
        arms.emplace_back(-rotor.p_B_m.y() * thrust, rotor.p_B_m.x() * thrust,
                          rotor.direction * airframe.rotor.moment_constant_m *
                              airframe.rotor.motor_constant_kg_m);
    }
    return arms;
}

/// The motors' model under the log's commands. A gyro's sample is the mean since the one before,
/// and so is the integral.
Driven drive(const FlightData& data, const vehicle::AirframeNumbers& airframe, double lag_up_s,
             double lag_down_s) {
    const vehicle::RotorParameters& rotor = airframe.rotor;
    const std::vector<Vector3> arms = arms_of(airframe);
    const std::size_t samples = data.imu_s.size();
    Driven driven;
    driven.speed_sum_rad_s.resize(samples);
    for (VectorXd& axis : driven.spin_N_m_s) {
        axis = VectorXd::Zero(static_cast<Eigen::Index>(samples));
    }
    const double keep_up = std::exp(-kFine_s / lag_up_s);
    const double keep_down = std::exp(-kFine_s / lag_down_s);
    std::vector<double> speeds(arms.size(), 0.0);
    std::size_t command = 0, sample = 0, count = 0;
    Vector3 spin = Vector3::Zero(), sum = Vector3::Zero();
    double time_s = std::max(data.command_s.front(), data.imu_s.front() - 0.5);
    bool begins = true;
    while (sample < samples) {
        while (command + 1 < data.command_s.size() &&
               data.command_s[command + 1] + rotor.command_delay_s <= time_s + 0.5 * kFine_s) {
            ++command;
        }
        Vector3 moment = Vector3::Zero();
        double all = 0.0;
        for (std::size_t i = 0; i < arms.size(); ++i) {
            const double share = i < data.command[command].size() ? data.command[command][i] : 0.0;
            const double asked =
                share > 0.0 ? std::min(rotor.speed_max_rad_s,
                                       rotor.speed_offset_rad_s + rotor.speed_scale_rad_s * share)
                            : 0.0;
            const double off = begins ? 0.0 : speeds[i] - asked;
            speeds[i] = asked + off * (off < 0.0 ? keep_up : keep_down);
            moment += arms[i] * speeds[i] * speeds[i];
            all += speeds[i];
        }
        begins = false;
        // Half of the step's moment acts before its middle.
        sum += spin + 0.5 * kFine_s * moment;
        spin += kFine_s * moment;
        ++count;
        time_s += kFine_s;
        // Samples before the first command find nothing that drives.
        while (sample < samples && time_s >= data.imu_s[sample] - 0.5 * kFine_s) {
            const Vector3 mean = count > 0 ? Vector3(sum / static_cast<double>(count)) : spin;
            for (int axis = 0; axis < 3; ++axis) {
                driven
                    .spin_N_m_s[static_cast<std::size_t>(axis)][static_cast<Eigen::Index>(sample)] =
                    mean[axis];
            }
            driven.speed_sum_rad_s[sample++] = all;
            sum.setZero();
            count = 0;
        }
    }
    return driven;
}

/// What a filter that knows the model would not have foreseen: its gain is `gain`, each stretch
/// begins anew. The first samples of a stretch, while it settles, are 0.
VectorXd unforeseen(const VectorXd& values, const std::vector<Stretch>& stretches, double gain) {
    VectorXd left = VectorXd::Zero(values.size());
    const auto settle = static_cast<std::size_t>(std::ceil(5.0 / gain));
    for (const Stretch& stretch : stretches) {
        double last = 0.0;
        for (std::size_t k = stretch.first + 1; k < stretch.last; ++k) {
            const auto i = static_cast<Eigen::Index>(k);
            last = values[i] - values[i - 1] + (1.0 - gain) * last;
            left[i] = k < stretch.first + settle ? 0.0 : last;
        }
    }
    return left;
}

std::size_t counted(const std::vector<Stretch>& stretches, double gain) {
    const auto settle = static_cast<std::size_t>(std::ceil(5.0 / gain));
    std::size_t count = 0;
    for (const Stretch& stretch : stretches) {
        const std::size_t all = stretch.last - stretch.first;
        count += all > settle ? all - settle : 0;
    }
    return count;
}

/// An axis: what the gyro did, and by what it is told.
struct TurningAxis {
    VectorXd rate;  ///< unforeseen
    VectorXd ramp;  ///< of a steady moment, unforeseen
    double gain = 0.05;
    double per_inertia = 0.0;
    double deviation = 1.0;  ///< of what is left
};

/// Least squares of rate on the moment's integral and the ramp.
/// @return what is left
VectorXd solve_axis(TurningAxis& axis, const VectorXd& spin) {
    const double ss = spin.squaredNorm(), sr = spin.dot(axis.ramp), rr = axis.ramp.squaredNorm();
    const double ys = axis.rate.dot(spin), yr = axis.rate.dot(axis.ramp);
    const double det = ss * rr - sr * sr;
    if (!(det > 1e-12 * ss * rr)) {
        throw InputError("its commands do not turn the vehicle: nothing tells the inertia");
    }
    axis.per_inertia = (ys * rr - yr * sr) / det;
    const double steady = (yr * ss - ys * sr) / det;
    return axis.rate - axis.per_inertia * spin - steady * axis.ramp;
}

/// One search: lags, and for each axis inertia, steady moment, gain and noise.
class TurningSearch {
public:
    TurningSearch(const FlightData& data, const vehicle::AirframeNumbers& airframe,
                  const std::vector<Stretch>& free)
        : data_(data),
          airframe_(airframe),
          free_(free),
          logs_(std::log(airframe.rotor.time_constant_up_s),
                std::log(airframe.rotor.time_constant_down_s)) {}

    TurningFit fit() {
        constexpr int kRounds = 3;
        for (int round = 0; round < kRounds; ++round) {
            choose_gains();
            improve();
        }
        return conclude();
    }

private:
    using Lags = Eigen::Vector2d;

    [[nodiscard]] Driven driven_by(const Lags& logs) const {
        return drive(data_, airframe_, std::exp(logs[0]), std::exp(logs[1]));
    }

    VectorXd rate_of(int axis) const {
        VectorXd rate(static_cast<Eigen::Index>(data_.imu_s.size()));
        for (Eigen::Index k = 0; k < rate.size(); ++k) {
            rate[k] = data_.rate_B_rad_s[static_cast<std::size_t>(k)][axis];
        }
        return rate;
    }

    /// The gain of each axis' filter is the one that foresees best.
    void choose_gains() {
        const Driven driven = driven_by(logs_);
        const VectorXd time = Eigen::Map<const VectorXd>(
            data_.imu_s.data(), static_cast<Eigen::Index>(data_.imu_s.size()));
        for (int a = 0; a < 3; ++a) {
            double least = std::numeric_limits<double>::infinity();
            TurningAxis best;
            for (double gain = 0.01; gain < 0.9; gain *= 1.25) {
                const std::size_t count = counted(free_, gain);
                if (count < 100) {
                    continue;
                }
                TurningAxis axis{.rate = unforeseen(rate_of(a), free_, gain),
                                 .ramp = unforeseen(time, free_, gain),
                                 .gain = gain};
                const VectorXd left = solve_axis(
                    axis, unforeseen(driven.spin_N_m_s[static_cast<std::size_t>(a)], free_, gain));
                const double mean2 = left.squaredNorm() / static_cast<double>(count);
                if (mean2 < least) {
                    least = mean2;
                    axis.deviation = std::sqrt(mean2);
                    best = axis;
                }
            }
            if (!std::isfinite(least)) {
                throw InputError("too little free flight: half a second and more is needed");
            }
            axes_[static_cast<std::size_t>(a)] = best;
        }
    }

    /// What is left of all axes, each over its deviation; inertias are solved for on the way.
    VectorXd left_by(const Lags& logs, std::array<VectorXd, 3>* spins = nullptr) {
        const Driven driven = driven_by(logs);
        const auto n = static_cast<Eigen::Index>(data_.imu_s.size());
        VectorXd all(3 * n);
        for (std::size_t a = 0; a < 3; ++a) {
            const VectorXd spin = unforeseen(driven.spin_N_m_s[a], free_, axes_[a].gain);
            all.segment(static_cast<Eigen::Index>(a) * n, n) =
                solve_axis(axes_[a], spin) / axes_[a].deviation;
            if (spins != nullptr) {
                (*spins)[a] = spin;
            }
        }
        return all;
    }

    /// Gauss and Newton over the lags, the rest solved for at each (variable projection).
    void improve() {
        constexpr double kSmall = 1e-3, kMostStep = 0.5, kEnough = 1e-5;
        constexpr int kSteps = 12;
        for (int k = 0; k < kSteps; ++k) {
            const VectorXd here = left_by(logs_);
            MatrixXd slopes(here.size(), kLags);
            for (int i = 0; i < kLags; ++i) {
                Lags aside = logs_;
                aside[i] += kSmall;
                slopes.col(i) = (left_by(aside) - here) / kSmall;
            }
            Lags step = -(slopes.transpose() * slopes).ldlt().solve(slopes.transpose() * here);
            step = step.cwiseMax(-kMostStep).cwiseMin(kMostStep);
            for (int half = 0; half < 6 && left_by(logs_ + step).squaredNorm() >
                                               here.squaredNorm() * (1.0 + 1e-12);
                 ++half) {
                step *= 0.5;
            }
            logs_ += step;
            constexpr double kShortest = -9.0, kLongest = 0.0;  // 0.1 ms, 1 s
            logs_ = logs_.cwiseMax(kShortest).cwiseMin(kLongest);
            if (step.cwiseAbs().maxCoeff() < kEnough) {
                return;
            }
        }
    }

    /// Covariance of all that was fitted, from the slopes of what is left by each.
    TurningFit conclude() {
        constexpr double kSmall = 1e-3;
        std::array<VectorXd, 3> spins, spins_aside;
        const VectorXd here = left_by(logs_, &spins);
        const auto per_inertia = [this] {
            return Eigen::Vector3d(axes_[0].per_inertia, axes_[1].per_inertia,
                                   axes_[2].per_inertia);
        };
        const Eigen::Vector3d inverse = per_inertia();
        const auto n = static_cast<Eigen::Index>(data_.imu_s.size());
        constexpr int kAll = kInertias + kLags + 3;  // with a steady moment each
        MatrixXd slopes = MatrixXd::Zero(3 * n, kAll);
        for (int a = 0; a < 3; ++a) {
            const TurningAxis& axis = axes_[static_cast<std::size_t>(a)];
            slopes.block(a * n, a, n, 1) = spins[static_cast<std::size_t>(a)] / axis.deviation;
            slopes.block(a * n, kInertias + kLags + a, n, 1) = axis.ramp / axis.deviation;
        }
        for (int i = 0; i < kLags; ++i) {
            Lags aside = logs_;
            aside[i] += kSmall;
            (void)left_by(aside, &spins_aside);
            for (int a = 0; a < 3; ++a) {
                const auto at = static_cast<std::size_t>(a);
                slopes.block(a * n, kInertias + i, n, 1) =
                    inverse[a] * (spins_aside[at] - spins[at]) / kSmall / axes_[at].deviation;
            }
        }
        (void)left_by(logs_);  // the inertias are those of the lags again
        const MatrixXd covariance =
            (slopes.transpose() * slopes).ldlt().solve(MatrixXd::Identity(kAll, kAll));
        TurningFit fit;
        fit.per_inertia = inverse;
        fit.lag_up_s = std::exp(logs_[0]);
        fit.lag_down_s = std::exp(logs_[1]);
        fit.covariance = covariance.topLeftCorner(kInertias + kLags, kInertias + kLags);
        fit.speed_sum_rad_s = driven_by(logs_).speed_sum_rad_s;
        return fit;
    }

    const FlightData& data_;
    const vehicle::AirframeNumbers& airframe_;
    const std::vector<Stretch>& free_;
    Lags logs_;
    std::array<TurningAxis, 3> axes_;
};

}  // namespace

TurningFit fit_turning(const FlightData& data, const vehicle::AirframeNumbers& airframe,
                       const std::vector<Stretch>& free) {
    require(!data.imu_s.empty() && !data.command_s.empty(), "a log with IMU and commands");
    return TurningSearch(data, airframe, free).fit();
}

}  // namespace limpet::identification
