// SPDX-License-Identifier: Apache-2.0
#include "limpet/stability/level_on_cup.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/simulation/advance.hpp"

namespace limpet::stability {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Large against rounding, small against every nonlinearity: 1 um, 1 urad, 1e-6 of full torque.
constexpr double kStep = 1e-6;
constexpr int kSettlePeriods = 500;  ///< slider and lip come to rest, a swing does not grow much
/// Two or three; more where motors slow down otherwise than they speed up: their rest is a corner,
/// which is met in ever smaller steps from both sides.
constexpr int kNewtonSteps = 30;
constexpr double kStanding = 1e-7;  ///< a number that nothing moves: an integrator without gain
constexpr int kWatchPeriods = 64;   ///< longer than the longest dead time
constexpr double kResting = 1e-8;   ///< by how much the rest may move in a period

}  // namespace

LevelOnCup::LevelOnCup(std::shared_ptr<const simulation::FlightModel> model)
    : model_(std::move(model)),
      plant_(plant::kReducedEngine.make(model_->scenario->airframe,
                                        scenario::scene_of(*model_->scenario))),
      state_(start(*model_, plant_)),
      ticks_(kTicksPerSecond / model_->control_rate_Hz),
      // As flights do it, but for the sensors that make some strides shorter.
      ticks_a_stride_(std::gcd(
          static_cast<int>(*std::max_element(model_->strides.begin(), model_->strides.end())),
          ticks_)) {
    require(model_->airframe.has_cup && model_->has_wall, "a cup and a wall to be level on");
    require(kTicksPerSecond % model_->control_rate_Hz == 0,
            "a control rate that divides the tick's");
    put_on_wall();
}

/// Square before the wall, the lip just on it, sealed at the surface's best vacuum.
void LevelOnCup::put_on_wall() {
    const WallGeometry& wall = model_->cup.wall;
    const Vector3 x_T_W = wall.R_WT.col(0);
    const double yaw_rad = std::atan2(x_T_W.y(), x_T_W.x());
    const Quaternion q_WB = quaternion_from_euler({.yaw_rad = yaw_rad});
    const vehicle::CupMountParameters& mount = model_->airframe.cup;
    const Vector3 lip_B_m(mount.joint_x_m + mount.lip_offset_m, 0.0, mount.joint_z_m);
    plant_.set_pose(wall.p_WT_m - q_WB * lip_B_m, q_WB);
    see_motion(*model_, state_.truth, plant_);

    state_.autopilot.rate = {};
    state_.autopilot.rate.filtering = true;
    state_.guidance.setpoint = {
        .motion = AttitudeSetpoint{.q_WB = q_WB, .thrust = model_->guidance.hover_thrust},
        .armed = true,
        .pump_on = true};
    state_.cup.mean_pressure_Pa = model_->surfaces.back().vacuum_pressure_Pa;
    state_.cup.status.phase = CupPhase::attached;
    state_.cup.touches = static_cast<int>(model_->surfaces.size());
    state_.fine_until = 0;
}

/// As the loop does it: control, rotors, bodies and cup.
void LevelOnCup::period() {
    const Quaternion before = state_.truth.base.q_WF;
    state_.autopilot.estimate.q_WB = before;
    state_.command = control(model_->autopilot, state_.autopilot, state_.guidance.setpoint,
                             seconds(state_.tick));
    simulation::TickReport report;
    simulation::Stride stride = one_tick(*model_, state_);
    stride.ticks = ticks_a_stride_;
    for (int left = ticks_; left > 0; left -= stride.ticks) {
        state_.cup.mean_pressure_Pa = model_->surfaces.back().vacuum_pressure_Pa;
        if (stride.pushed_at_its_start()) {
            advance(*model_, state_, plant_, stride, report);
        }
        step(model_->airframe.rotor, model_->rotor_lag, state_.rotors, state_.command,
             {.battery_share = vehicle::hover_drive_share(model_->airframe)}, stride.ticks);
        if (!stride.pushed_at_its_start()) {
            advance(*model_, state_, plant_, stride, report);
        }
        state_.tick += stride.ticks;
        see_motion(*model_, state_.truth, plant_);
    }
    state_.autopilot.estimate.w_WB_B_rad_s =
        rotation_vector_from_quaternion(before.conjugate() * state_.truth.base.q_WF) /
        (ticks_ * kTick_s);
}

void LevelOnCup::restore(const simulation::Snapshot& snapshot) {
    state_ = snapshot.state;
    plant_.restore(snapshot.plant);
}

Eigen::Index LevelOnCup::size() const {
    return static_cast<Eigen::Index>(2 * plant::kFreedoms + carried_.size());
}

/// @return the bodies' displacement from `origin`, then the carried numbers as they are
Vector LevelOnCup::numbers(const plant::PlantState& origin) {
    Vector all(size());
    plant_.displacement_from(origin, {all.data(), 2 * plant::kFreedoms});
    auto at = static_cast<Eigen::Index>(2 * plant::kFreedoms);
    const std::vector<double*> own = numbers_of(state_);
    for (const std::size_t place : carried_) {
        all[at++] = *own[place];
    }
    return all;
}

void LevelOnCup::add(const Vector& step) {
    plant_.displace({step.data(), 2 * plant::kFreedoms});
    auto at = static_cast<Eigen::Index>(2 * plant::kFreedoms);
    const std::vector<double*> own = numbers_of(state_);
    for (const std::size_t place : carried_) {
        *own[place] += step[at++];
    }
    see_motion(*model_, state_.truth, plant_);
}

/// Those which the bodies' motion reaches and which reach the bodies again, at once or by way of
/// one another. Clocks, settings and what is worked out anew in every period are not among them.
void LevelOnCup::find_carried() {
    carried_.clear();
    const simulation::Snapshot here{.state = state_, .plant = plant_.save(), .seen = {}};
    const auto watch = [&](double push) {
        restore(here);
        add(Vector::Constant(size(), push));
        std::vector<double> seen;
        for (int k = 0; k < kWatchPeriods; ++k) {
            period();
            for (const double* number : numbers_of(state_)) {
                seen.push_back(*number);
            }
        }
        return seen;
    };
    const std::vector<double> still = watch(0.0);
    const std::vector<double> pushed = watch(kStep);
    const std::size_t all = still.size() / kWatchPeriods;
    for (std::size_t place = 0; place < all; ++place) {
        bool reached = false;
        for (std::size_t i = place; i < still.size(); i += all) {
            reached = reached || still[i] != pushed[i];
        }
        if (reached) {
            carried_.push_back(place);
        }
    }
    restore(here);
    keep_what_reaches(16);  // most places are dead: a look at many at once
    keep_what_reaches(1);
}

/// Of what is carried, the groups of so many whose nudge reaches the bodies in the end.
void LevelOnCup::keep_what_reaches(Eigen::Index group) {
    const simulation::Snapshot here{.state = state_, .plant = plant_.save(), .seen = {}};
    const Eigen::Index n = size();
    const auto bodies = static_cast<Eigen::Index>(2 * plant::kFreedoms);
    const Vector at_rest = image(here, Vector::Zero(n));
    using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;
    std::vector<Flags> reached;  // by each group
    for (Eigen::Index at = bodies; at < n; at += group) {
        Vector nudge = Vector::Zero(n);
        nudge.segment(at, std::min(group, n - at)).setConstant(kStep);
        reached.push_back(image(here, nudge).array() != at_rest.array());
    }
    Flags counts = Flags::Constant(n, false);
    counts.head(bodies) = true;
    for (Eigen::Index before = 0; before != counts.count();) {
        before = counts.count();
        for (std::size_t k = 0; k < reached.size(); ++k) {
            const Eigen::Index at = bodies + static_cast<Eigen::Index>(k) * group;
            if (!counts[at] && (reached[k] && counts).any()) {
                counts.segment(at, std::min(group, n - at)) = true;
            }
        }
    }
    std::vector<std::size_t> kept;
    for (Eigen::Index at = bodies; at < n; ++at) {
        if (counts[at]) {
            kept.push_back(carried_[static_cast<std::size_t>(at - bodies)]);
        }
    }
    carried_ = std::move(kept);
    restore(here);
}

/// Where one period leads from `from` and a step aside.
Vector LevelOnCup::image(const simulation::Snapshot& from, const Vector& step) {
    restore(from);
    add(step);
    period();
    return numbers(from.plant);
}

Matrix LevelOnCup::jacobian(const simulation::Snapshot& at) {
    const Eigen::Index n = size();
    Matrix jacobian(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        jacobian.col(i) =
            (image(at, kStep * Vector::Unit(n, i)) - image(at, -kStep * Vector::Unit(n, i))) /
            (2.0 * kStep);
    }
    return jacobian;
}

/// Of one period about the rest; none: Newton's method finds no rest, or leaves what is finite.
std::optional<Matrix> LevelOnCup::map_at_rest() try {
    for (int k = 0; k < kSettlePeriods; ++k) {
        period();
    }
    find_carried();
    const Eigen::Index n = size();
    for (int k = 0; k <= kNewtonSteps; ++k) {
        const simulation::Snapshot here{.state = state_, .plant = plant_.save(), .seen = {}};
        const Vector now = numbers(here.plant);
        const Matrix map = jacobian(here);
        const Vector miss = image(here, Vector::Zero(n)) - now;
        restore(here);
        if (miss.lpNorm<Eigen::Infinity>() < kResting) {
            return map;
        }
        Matrix newton = Matrix::Identity(n, n) - map;
        for (Eigen::Index i = 0; i < n; ++i) {
            if (newton.row(i).lpNorm<Eigen::Infinity>() < kStanding) {
                newton(i, i) = 1.0;
            }
        }
        add(newton.partialPivLu().solve(miss));
    }
    return std::nullopt;
} catch (const plant::Diverged&) {
    return std::nullopt;
}

std::optional<std::vector<Mode>> LevelOnCup::modes() {
    const std::optional<Matrix> map = map_at_rest();
    if (!map) {
        return std::nullopt;
    }
    const Eigen::EigenSolver<Matrix> solver(*map);
    std::vector<Mode> modes;
    for (Eigen::Index i = 0; i < map->rows(); ++i) {
        const std::complex<double> mu = solver.eigenvalues()[i];
        const bool over_at_once = std::abs(mu) < 1e-3;
        const bool stands = std::abs(mu - 1.0) < kStanding;
        const bool twin = mu.imag() < 0.0;
        if (over_at_once || stands || twin) {
            continue;
        }
        const std::complex<double> lambda = std::log(mu) / (ticks_ * kTick_s);
        const Eigen::Vector3cd turning = solver.eigenvectors().col(i).segment(3, 3);
        const double all = turning.norm();
        modes.push_back({.growth_1_s = lambda.real(),
                         .frequency_Hz = lambda.imag() / (2.0 * kPi),
                         .pitch_share = all > 0.0 ? std::abs(turning.y()) / all : 0.0});
    }
    std::sort(modes.begin(), modes.end(),
              [](const Mode& a, const Mode& b) { return a.growth_1_s > b.growth_1_s; });
    return modes;
}

std::optional<Mode> pitch_mode(const std::vector<Mode>& modes) {
    const auto is_pitch = [](const Mode& mode) {
        constexpr double kFast_Hz = 3.0;  // the free vehicle's attitude loop and filters
        return mode.frequency_Hz < kFast_Hz && mode.pitch_share > 0.7;
    };
    const auto swings = std::find_if(modes.begin(), modes.end(), [&](const Mode& mode) {
        return is_pitch(mode) && (is_swing(mode) || mode.growth_1_s > 0.0);
    });
    const auto found =
        swings != modes.end() ? swings : std::find_if(modes.begin(), modes.end(), is_pitch);
    return found != modes.end() ? std::optional(*found) : std::nullopt;
}

}  // namespace limpet::stability
