// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/driven.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/time.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet::identification {
namespace {

/// A rotor's moment in B for each squared speed.
std::vector<Vector3> arms_of(const vehicle::Airframe& airframe) {
    std::vector<Vector3> arms;
    for (const vehicle::Rotor& rotor : airframe.rotors) {
        const double thrust = rotor.thrust_share * airframe.rotor.thrust_per_speed_2_kg_m();
        arms.emplace_back(-rotor.p_B_m.y() * thrust, rotor.p_B_m.x() * thrust,
                          rotor.direction * airframe.rotor.moment_constant_m *
                              airframe.rotor.thrust_per_speed_2_kg_m());
    }
    return arms;
}

/// What flying and turning through the air changes of the rotors' moment: drag at the hubs, thrust
/// lost along the axes (vehicle/rotor.hpp).
Vector3 moment_of_air(const vehicle::Airframe& airframe, const RotorList<double>& speeds_rad_s,
                      const Kinematics& moving) {
    const Vector3 still_air = Vector3::Zero();
    return rotor_wrench_B(airframe, speeds_rad_s, moving, still_air).moment_N_m -
           rotor_wrench_B(airframe, speeds_rad_s, {}, still_air).moment_N_m;
}

/// Drag of the hubs over lambda_1.
Vector3 hub_flow_m(const vehicle::Airframe& airframe, const RotorList<double>& speeds_rad_s,
                   const Kinematics& moving) {
    Vector3 flow_m = Vector3::Zero();
    for (std::size_t i = 0; i < speeds_rad_s.size(); ++i) {
        const Vector3 v_m_s =
            moving.v_WF_W_m_s + moving.w_WF_F_rad_s.cross(airframe.rotors[i].p_B_m);
        flow_m -= speeds_rad_s[i] * Vector3(v_m_s.x(), v_m_s.y(), 0.0);
    }
    return flow_m;
}

/// The motors under the log's commands, tick by tick.
class Motors {
public:
    Motors(const FlightData& data, const vehicle::Airframe& airframe, double lag_up_s,
           double lag_down_s)
        : data_(data),
          rotor_(airframe.rotor),
          arms_(arms_of(airframe)),
          keep_up_(std::exp(-kTick_s / lag_up_s)),
          keep_down_(std::exp(-kTick_s / lag_down_s)) {
        speeds_rad_s_.resize(arms_.size(), 0.0);
    }
    [[nodiscard]] const RotorList<double>& speeds_rad_s() const { return speeds_rad_s_; }
    [[nodiscard]] Vector3 moment_N_m() const {
        Vector3 moment = Vector3::Zero();
        for (std::size_t i = 0; i < arms_.size(); ++i) {
            moment += arms_[i] * speeds_rad_s_[i] * speeds_rad_s_[i];
        }
        return moment;
    }
    /// From `time_s` to a tick later.
    void tick(double time_s) {
        while (command_ + 1 < data_.command_s.size() &&
               data_.command_s[command_ + 1] + rotor_.command_delay_s <= time_s + 0.5 * kTick_s) {
            ++command_;
        }
        const RotorList<double>& command = data_.command[command_];
        for (std::size_t i = 0; i < arms_.size(); ++i) {
            const double share = i < command.size() ? command[i] : 0.0;
            const double commanded =
                share > 0.0 ? std::min(rotor_.speed_max_rad_s,
                                       rotor_.speed_offset_rad_s + rotor_.speed_scale_rad_s * share)
                            : 0.0;
            const double off = begins_ ? 0.0 : speeds_rad_s_[i] - commanded;
            speeds_rad_s_[i] = commanded + off * (off < 0.0 ? keep_up_ : keep_down_);
        }
        begins_ = false;
    }

private:
    const FlightData& data_;
    const vehicle::RotorParameters& rotor_;
    std::vector<Vector3> arms_;
    double keep_up_, keep_down_;
    RotorList<double> speeds_rad_s_;
    std::size_t command_ = 0;
    bool begins_ = true;  ///< they turn as commanded
};

/// The integral of the moment, and the integral of that since a sample.
class Spin {
public:
    /// @param simulated  steps are those of our engine (docs/decisions/0043), else there are none
    explicit Spin(bool simulated) : simulated_(simulated) {}
    void step(const Vector3& before_N_m, const Vector3& after_N_m, int ticks) {
        const double step_s = ticks * kTick_s;
        const Vector3 moment = !simulated_ ? Vector3(0.5 * (before_N_m + after_N_m))
                               : ticks > 1 ? before_N_m
                                           : after_N_m;
        sum_ += step_s * (spin_N_m_s_ + (simulated_ ? 1.0 : 0.5) * step_s * moment);
        spin_N_m_s_ += step_s * moment;
        since_s_ += step_s;
    }
    /// Mean since the last call.
    Vector3 mean() {
        const Vector3 mean = since_s_ > 0.0 ? Vector3(sum_ / since_s_) : spin_N_m_s_;
        sum_.setZero();
        since_s_ = 0.0;
        return mean;
    }

private:
    bool simulated_;
    double since_s_ = 0.0;
    Vector3 spin_N_m_s_ = Vector3::Zero(), sum_ = Vector3::Zero();
};

/// A cup that hangs on its two hinges: quick turns of the body do not take it along, so that the
/// inertia that they meet is a few per cent less.
class HangingCup {
public:
    explicit HangingCup(const vehicle::Airframe& airframe) : body_(airframe.inertia_kg_m2) {
        if (!airframe.has_cup) {
            return;
        }
        const vehicle::BodyInertia cup = cup_inertia(airframe);
        const double ahead_m = cup.centre_B_m.x() - airframe.cup.joint_x_m;
        for (int axis = 1; axis < 3; ++axis) {
            const auto at = static_cast<std::size_t>(axis);
            const double own = cup.inertia_kg_m2(axis, axis);
            hinge_[at] = own + cup.mass_kg * ahead_m * ahead_m;
            shared_[at] = own + cup.mass_kg * ahead_m * cup.centre_B_m.x();
        }
        stiffness_ = airframe.cup.centring_stiffness_N_m_rad;
        damping_ = airframe.cup.centring_damping_N_m_s_rad;
    }
    /// A tick under the rotors' moment.
    /// @return what the cup does to the body meanwhile [N m]
    Vector3 tick(const Vector3& moment_N_m) {
        Vector3 back = Vector3::Zero();
        for (std::size_t i = 1; i < 3 && stiffness_ > 0.0; ++i) {
            const auto axis = static_cast<Eigen::Index>(i);
            const double resists = damping_ * rate_[i] + stiffness_ * angle_[i];
            const double body_rad_s2 = (moment_N_m[axis] + shared_[i] * resists / hinge_[i]) /
                                       (body_[axis] - shared_[i] * shared_[i] / hinge_[i]);
            const double before = rate_[i];
            rate_[i] = (before -
                        kTick_s * (stiffness_ * angle_[i] + shared_[i] * body_rad_s2) / hinge_[i]) /
                       (1.0 + kTick_s * (damping_ + kTick_s * stiffness_) / hinge_[i]);
            angle_[i] += kTick_s * rate_[i];
            back[axis] = -shared_[i] * (rate_[i] - before) / kTick_s;
        }
        return back;
    }

private:
    Vector3 body_;  ///< inertia of the whole
    std::array<double, 3> hinge_{}, shared_{}, angle_{}, rate_{};
    double stiffness_ = 0.0, damping_ = 0.0;
};

}  // namespace

std::vector<Vector3> velocities_of(const FlightData& data) {
    std::vector<Vector3> all(data.imu_s.size(), Vector3::Zero());
    if (data.velocity_s.empty()) {
        return all;
    }
    std::size_t next = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const double time_s =
            data.imu_s[k] - (k > 0 ? 0.5 * (data.imu_s[k] - data.imu_s[k - 1]) : 0.0);
        while (next < data.velocity_s.size() && data.velocity_s[next] <= time_s) {
            ++next;
        }
        const std::size_t after = std::min(next, data.velocity_s.size() - 1);
        const std::size_t before = next > 0 ? next - 1 : 0;
        const double apart_s = data.velocity_s[after] - data.velocity_s[before];
        const double share = apart_s > 0.0 ? (time_s - data.velocity_s[before]) / apart_s : 0.0;
        all[k] = data.velocity_B_m_s[before] +
                 share * (data.velocity_B_m_s[after] - data.velocity_B_m_s[before]);
    }
    return all;
}

Driven drive(const FlightData& data, const vehicle::Airframe& airframe,
             const std::vector<Vector3>& velocity_B_m_s, double lag_up_s, double lag_down_s) {
    const std::size_t samples = data.imu_s.size();
    Driven driven;
    driven.hub_flow_m.resize(samples);
    for (Eigen::VectorXd& axis : driven.spin_N_m_s) {
        axis = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(samples));
    }
    Motors motors(data, airframe, lag_up_s, lag_down_s);
    const bool simulated = !data.strides.empty();
    Spin spin(simulated);
    HangingCup cup(airframe);
    Vector3 by_air = Vector3::Zero();
    double time_s = std::max(data.command_s.front(), data.imu_s.front() - 0.5);
    for (std::size_t sample = 0; sample < samples;) {
        const auto tick = static_cast<std::size_t>(std::llround(time_s / kTick_s));
        const int ticks = simulated ? data.strides[tick % data.strides.size()] : 1;
        const Vector3 before_N_m = motors.moment_N_m();
        Vector3 by_cup = Vector3::Zero();
        for (int k = 0; k < ticks; ++k) {
            motors.tick(time_s + k * kTick_s);
            by_cup += cup.tick(motors.moment_N_m()) / ticks;
        }
        spin.step(before_N_m + by_cup, motors.moment_N_m() + by_cup, ticks);
        time_s += ticks * kTick_s;
        // Samples before the first command find nothing that drives.
        for (; sample < samples && time_s >= data.imu_s[sample] - 0.5 * kTick_s; ++sample) {
            // The gyro says how fast the hubs went round: the air needs no motion of its own.
            const Kinematics moving{.v_WF_W_m_s = velocity_B_m_s[sample],
                                    .w_WF_F_rad_s = data.rate_B_rad_s[sample]};
            const double since_s = sample > 0 ? data.imu_s[sample] - data.imu_s[sample - 1] : 0.0;
            const Vector3 air = since_s * moment_of_air(airframe, motors.speeds_rad_s(), moving);
            const Vector3 mean = spin.mean() + by_air + 0.5 * air;
            by_air += air;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                driven.spin_N_m_s[axis][static_cast<Eigen::Index>(sample)] =
                    mean[static_cast<Eigen::Index>(axis)];
            }
            driven.hub_flow_m[sample] = hub_flow_m(airframe, motors.speeds_rad_s(), moving);
        }
    }
    return driven;
}

}  // namespace limpet::identification
