// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/turning_fit.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/identification/driven.hpp"

namespace limpet::identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kLags = 2, kInertias = 3;

/// An axis: what the gyro did, and what drives it.
struct TurningAxis {
    VectorXd rate;  ///< whitened
    VectorXd ramp;  ///< of a steady moment, whitened
    double ratio = 0.0;
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
        throw InputError("its commands do not turn the vehicle: the inertia is not observable");
    }
    axis.per_inertia = (ys * rr - yr * sr) / det;
    const double steady = (yr * ss - ys * sr) / det;
    return axis.rate - axis.per_inertia * spin - steady * axis.ramp;
}

/// One search: lags, and for each axis inertia, steady moment, wander and noise.
class TurningSearch {
public:
    TurningSearch(const FlightData& data, const vehicle::Airframe& airframe,
                  const std::vector<Stretch>& free)
        : data_(data),
          airframe_(airframe),
          free_(free),
          velocity_B_m_s_(velocities_of(data)),
          logs_(std::log(airframe.rotor.time_constant_up_s),
                std::log(airframe.rotor.time_constant_down_s)) {}

    TurningFit fit() {
        constexpr int kRounds = 3;
        for (int round = 0; round < kRounds; ++round) {
            choose_ratios();
            improve();
        }
        return conclude();
    }

private:
    using Lags = Eigen::Vector2d;

    [[nodiscard]] Driven driven_by(const Lags& logs) const {
        return drive(data_, airframe_, velocity_B_m_s_, std::exp(logs[0]), std::exp(logs[1]));
    }

    VectorXd rate_of(int axis) const {
        VectorXd rate(static_cast<Eigen::Index>(data_.imu_s.size()));
        for (Eigen::Index k = 0; k < rate.size(); ++k) {
            rate[k] = data_.rate_B_rad_s[static_cast<std::size_t>(k)][axis];
        }
        return rate;
    }

    /// How much each axis wanders compared with its noise is what is likeliest.
    void choose_ratios() {
        constexpr std::size_t kFewest = 100;
        const std::size_t count = samples_of(free_);
        if (count < kFewest) {
            throw InputError("too little free flight: half a second and more is needed");
        }
        const Driven driven = driven_by(logs_);
        const VectorXd time = Eigen::Map<const VectorXd>(
            data_.imu_s.data(), static_cast<Eigen::Index>(data_.imu_s.size()));
        for (int a = 0; a < 3; ++a) {
            const auto at = static_cast<std::size_t>(a);
            double least = std::numeric_limits<double>::infinity();
            for (const double ratio : ratios_to_try()) {
                const Whitened rate = whiten(rate_of(a), free_, ratio);
                TurningAxis axis{
                    .rate = rate.values, .ramp = whiten(time, free_, ratio).values, .ratio = ratio};
                const double squares =
                    solve_axis(axis, whiten(driven.spin_N_m_s[at], free_, ratio).values)
                        .squaredNorm();
                const double unlikely = unlikelihood(squares, rate.logs, count);
                if (unlikely < least) {
                    least = unlikely;
                    axis.deviation = std::sqrt(squares / static_cast<double>(count));
                    axes_[at] = axis;
                }
            }
        }
    }

    /// What is left of all axes, each over its deviation; inertias are solved for on the way.
    VectorXd left_by(const Lags& logs, std::array<VectorXd, 3>* spins = nullptr) {
        const Driven driven = driven_by(logs);
        const auto n = static_cast<Eigen::Index>(data_.imu_s.size());
        VectorXd all(3 * n);
        for (std::size_t a = 0; a < 3; ++a) {
            const VectorXd spin = whiten(driven.spin_N_m_s[a], free_, axes_[a].ratio).values;
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

    /// By how much what is left pulls at the fitted numbers from block to block of the flight more
    /// than white noise would: a model that lacks something leaves errors that hang together, and
    /// then the slopes alone promise too much. Source: the sandwich of Huber and White, clustered.
    /// @return of each number, the factor on its deviation, >= 1
    VectorXd apart(const MatrixXd& slopes, const VectorXd& left, const MatrixXd& covariance) const {
        constexpr std::size_t kBlocks = 32;
        const auto n = static_cast<Eigen::Index>(data_.imu_s.size());
        const std::size_t count = samples_of(free_);
        MatrixXd pulls = MatrixXd::Zero(kBlocks, slopes.cols());
        std::size_t sample = 0;
        for (const Stretch& stretch : free_) {
            for (std::size_t k = stretch.first; k < stretch.last; ++k, ++sample) {
                const auto block = static_cast<Eigen::Index>(sample * kBlocks / count);
                for (Eigen::Index row = static_cast<Eigen::Index>(k); row < 3 * n; row += n) {
                    pulls.row(block) += left[row] * slopes.row(row);
                }
            }
        }
        const MatrixXd moved = pulls * covariance;
        return (moved.colwise().squaredNorm().transpose().array() / covariance.diagonal().array())
            .max(1.0)
            .sqrt();
    }

    /// Covariance of all that was fitted, from the slopes of what is left by each.
    TurningFit conclude() {
        constexpr double kSmall = 1e-3;
        std::array<VectorXd, 3> spins, spins_aside;
        (void)left_by(logs_, &spins);
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
        const VectorXd left = left_by(logs_);  // the inertias are those of the lags again
        MatrixXd covariance =
            (slopes.transpose() * slopes).ldlt().solve(MatrixXd::Identity(kAll, kAll));
        const VectorXd factors = apart(slopes, left, covariance);
        covariance = factors.asDiagonal() * covariance * factors.asDiagonal();
        TurningFit fit;
        fit.per_inertia = inverse;
        fit.lag_up_s = std::exp(logs_[0]);
        fit.lag_down_s = std::exp(logs_[1]);
        fit.covariance = covariance.topLeftCorner(kInertias + kLags, kInertias + kLags);
        fit.hub_flow_m = driven_by(logs_).hub_flow_m;
        return fit;
    }

    const FlightData& data_;
    const vehicle::Airframe& airframe_;
    const std::vector<Stretch>& free_;
    std::vector<Vector3> velocity_B_m_s_;  ///< at the IMU's samples
    Lags logs_;
    std::array<TurningAxis, 3> axes_;
};

}  // namespace

TurningFit fit_turning(const FlightData& data, const vehicle::Airframe& airframe,
                       const std::vector<Stretch>& free) {
    require(!data.imu_s.empty() && !data.command_s.empty(), "a log with IMU and commands");
    return TurningSearch(data, airframe, free).fit();
}

}  // namespace limpet::identification
