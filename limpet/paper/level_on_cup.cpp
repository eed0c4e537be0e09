// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/level_on_cup.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/simulation/advance.hpp"

namespace limpet {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Large against rounding, small against every nonlinearity: 1 um, 1 urad, 1e-6 of full torque.
constexpr double kStep = 1e-6;
constexpr int kSettlePeriods = 500;  ///< slider and lip come to rest, a swing does not grow much
constexpr int kNewtonSteps = 6;
constexpr double kStanding = 1e-7;  ///< a number that nothing moves: an integrator without gain
constexpr double kResting = 1e-8;   ///< by how much the rest may move in a period

}  // namespace

LevelOnCup::LevelOnCup(std::shared_ptr<const SimulationModel> model)
    : model_(std::move(model)),
      plant_(model_->plant),
      state_(start(*model_, plant_)),
      ticks_(kTicksPerSecond / model_->control_rate_Hz),
      delay_ticks_(static_cast<std::size_t>(
          std::lround(model_->scenario.airframe.rotor.command_delay_s / kTick_s))) {
    require(model_->scenario.airframe.has_cup && model_->scenario.wall.present,
            "a cup and a wall to be level on");
    require(ticks_ * model_->control_rate_Hz == kTicksPerSecond,
            "a control rate that divides the tick's");
    put_on_wall();
}

/// Square before the wall, the lip just on it, sealed at the surface's best vacuum.
void LevelOnCup::put_on_wall() {
    const Scenario& scenario = model_->scenario;
    const WallGeometry& wall = model_->cup.wall;
    const Vector3 x_T_W = wall.R_WT.col(0);
    const double yaw_rad = std::atan2(x_T_W.y(), x_T_W.x());
    const Quaternion q_WB = quaternion_from_euler({.yaw_rad = yaw_rad});
    const CupMountParameters& mount = scenario.airframe.cup;
    const Vector3 lip_B_m(mount.joint_x_m + mount.lip_offset_m, 0.0, mount.joint_z_m);
    plant_.set_pose(wall.p_WT_m - q_WB * lip_B_m, q_WB);
    see_motion(*model_, state_.truth, plant_);

    state_.autopilot.rate = {};
    state_.autopilot.rate.filtering = true;
    state_.guidance.setpoint = {
        .motion = AttitudeSetpoint{.q_WB = q_WB, .thrust = scenario.guidance.hover_thrust},
        .armed = true,
        .pump_on = true};
    state_.cup.mean_pressure_Pa = scenario.wall.surface.vacuum_pressure_Pa;
    state_.cup.status.phase = CupPhase::attached;
    state_.cup.touches = static_cast<int>(scenario.wall.first_touches.size()) + 1;
    state_.fine_until = 0;
}

/// As the loop does it: control, rotors, bodies and cup.
void LevelOnCup::period() {
    const Airframe& airframe = model_->scenario.airframe;
    const Quaternion before = state_.truth.base.q_WF;
    state_.autopilot.estimate.q_WB = before;
    state_.command = control(model_->autopilot, state_.autopilot, state_.guidance.setpoint,
                             seconds(state_.tick));
    EventList events;
    for (int k = 0; k < ticks_; ++k) {
        step(airframe.rotor, state_.rotors, state_.command, kTick_s);
        state_.cup.mean_pressure_Pa = model_->scenario.wall.surface.vacuum_pressure_Pa;
        advance(*model_, state_, plant_, events);
        ++state_.tick;
        see_motion(*model_, state_.truth, plant_);
    }
    state_.autopilot.estimate.w_WB_B_rad_s =
        rotation_vector_from_quaternion(before.conjugate() * state_.truth.base.q_WF) /
        (ticks_ * kTick_s);
}

/// Numbers beside the bodies' own that go from one period to the next.
template <class Visit>
void LevelOnCup::for_each_number(Visit visit) {
    for (double& speed_rad_s : state_.rotors.speed_rad_s) {
        visit(speed_rad_s);
    }
    for (std::size_t age = 1; age <= delay_ticks_; ++age) {
        const std::size_t slot =
            (state_.rotors.next + kCommandDelaySteps - age) % kCommandDelaySteps;
        for (double& asked_rad_s : state_.rotors.asked_rad_s[slot]) {
            visit(asked_rad_s);
        }
    }
    const auto visit3 = [&visit](Vector3& v) {
        visit(v.x());
        visit(v.y());
        visit(v.z());
    };
    RateControlState& rate = state_.autopilot.rate;
    visit3(rate.integral);
    visit3(rate.rate_rad_s);
    visit3(rate.acceleration_rad_s2);
    for (LowPass* filter : {&rate.rate_filter, &rate.acceleration_filter}) {
        visit3(filter->input_1);
        visit3(filter->input_2);
        visit3(filter->output_1);
        visit3(filter->output_2);
    }
    visit3(state_.autopilot.estimate.w_WB_B_rad_s);
}

std::size_t LevelOnCup::size() const {
    constexpr std::size_t kRates = 3 * (3 + 2 * 4 + 1);
    return 2 * plant_.freedoms() + kRotors * (1 + delay_ticks_) + kRates;
}

/// @return the bodies' displacement from `origin`, then all other numbers as they are
Vector LevelOnCup::numbers(const PlantState& origin) {
    Vector all(static_cast<Eigen::Index>(size()));
    plant_.displacement_from(origin, {all.data(), 2 * plant_.freedoms()});
    auto at = static_cast<Eigen::Index>(2 * plant_.freedoms());
    for_each_number([&](double value) { all[at++] = value; });
    return all;
}

void LevelOnCup::add(const Vector& step) {
    plant_.displace({step.data(), 2 * plant_.freedoms()});
    auto at = static_cast<Eigen::Index>(2 * plant_.freedoms());
    for_each_number([&](double& value) { value += step[at++]; });
    see_motion(*model_, state_.truth, plant_);
}

/// Where one period leads from `from` and a step aside.
Vector LevelOnCup::image(const Snapshot& from, const Vector& step) {
    state_ = from.state;
    plant_.restore(from.plant);
    add(step);
    period();
    return numbers(from.plant);
}

Matrix LevelOnCup::jacobian(const Snapshot& at) {
    const auto n = static_cast<Eigen::Index>(size());
    Matrix jacobian(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        jacobian.col(i) =
            (image(at, kStep * Vector::Unit(n, i)) - image(at, -kStep * Vector::Unit(n, i))) /
            (2.0 * kStep);
    }
    return jacobian;
}

std::vector<Mode> LevelOnCup::modes() {
    for (int k = 0; k < kSettlePeriods; ++k) {
        period();
    }
    const auto n = static_cast<Eigen::Index>(size());
    Matrix map;
    for (int k = 0;; ++k) {
        const Snapshot here{.state = state_, .plant = plant_.save()};
        const Vector now = numbers(here.plant);
        map = jacobian(here);
        const Vector miss = image(here, Vector::Zero(n)) - now;
        state_ = here.state;
        plant_.restore(here.plant);
        if (miss.lpNorm<Eigen::Infinity>() < kResting) {
            break;
        }
        require(k < kNewtonSteps, "a vehicle that can rest level on its cup");
        Matrix newton = Matrix::Identity(n, n) - map;
        for (Eigen::Index i = 0; i < n; ++i) {
            if (newton.row(i).lpNorm<Eigen::Infinity>() < kStanding) {
                newton(i, i) = 1.0;
            }
        }
        add(newton.partialPivLu().solve(miss));
    }

    const Eigen::EigenSolver<Matrix> solver(map);
    std::vector<Mode> modes;
    for (Eigen::Index i = 0; i < n; ++i) {
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

Mode pitch_mode(const std::vector<Mode>& modes) {
    constexpr double kSlow_Hz =
        3.0;  // faster ones are the free vehicle's attitude loop and filters
    const auto found = std::find_if(modes.begin(), modes.end(), [](const Mode& mode) {
        return mode.frequency_Hz < kSlow_Hz && mode.pitch_share > 0.7;
    });
    require(found != modes.end(), "a swing in pitch");
    return *found;
}

}  // namespace limpet
