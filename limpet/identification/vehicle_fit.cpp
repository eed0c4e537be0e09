// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/vehicle_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/time.hpp"
#include "limpet/identification/turning_fit.hpp"

namespace limpet::identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNormal = 1.959963984540054;  ///< of kConfidence, two-sided

/// What a fit needs of a log.
/// @throws InputError
void need(bool given, const std::string& else_why) {
    if (!given) {
        throw InputError(else_why);
    }
}

/// Why a fit fails becomes a note.
template <class Estimate>
void note_failure(VehicleFit& fit, const char* what, const Estimate& estimate) {
    try {
        estimate();
    } catch (const InputError& error) {
        fit.notes.push_back(fmt::format("{}: {}", what, error.what()));
    }
}

/// A column of numbers at another's times: the last that was known.
class LastKnown {
public:
    LastKnown(const std::vector<double>& time_s) : time_s_(time_s) {}
    /// @param time_s  not earlier than in the last call
    /// @return its place; nullopt before the first
    [[nodiscard]] std::optional<std::size_t> at(double time_s) {
        while (next_ < time_s_.size() && time_s_[next_] <= time_s + 1e-9) {
            ++next_;
        }
        return next_ == 0 ? std::nullopt : std::optional(next_ - 1);
    }

private:
    const std::vector<double>& time_s_;
    std::size_t next_ = 0;
};

double spacing_s(const std::vector<double>& time_s) {
    return time_s.size() < 2
               ? kNaN
               : (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
}

/// When the cup touched: pressed through the slider, or pumped out.
std::vector<double> contacts_s(const FlightData& data) {
    constexpr double kTouch_N = 3.0, kSucked_Pa = 5000.0;
    std::vector<double> times;
    for (std::size_t k = 0; k < data.force_s.size(); ++k) {
        if (std::abs(data.force_N[k]) > kTouch_N) {
            times.push_back(data.force_s[k]);
        }
    }
    for (std::size_t k = 0; k < data.pressure.t_s.size(); ++k) {
        if (data.pressure.pressure_Pa.front() - data.pressure.pressure_Pa[k] > kSucked_Pa) {
            times.push_back(data.pressure.t_s[k]);
        }
    }
    std::sort(times.begin(), times.end());
    return times;
}

/// Stretches with motors on and nothing touched for half a second to either side.
std::vector<Stretch> free_flight(const FlightData& data) {
    constexpr double kBeside_s = 0.5, kLeast_s = 0.4, kRuns = 0.05, kForgotten_s = 0.4;
    const std::vector<double> contacts = contacts_s(data);
    LastKnown command(data.command_s);
    std::vector<Stretch> all;
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::size_t first = kNone;
    const auto close = [&](std::size_t last) {
        if (first != kNone && data.imu_s[last - 1] - data.imu_s[first] > kLeast_s) {
            all.push_back({first, last});
        }
        first = kNone;
    };
    for (std::size_t k = 0; k < data.imu_s.size(); ++k) {
        const double time_s = data.imu_s[k];
        const auto touch = std::lower_bound(contacts.begin(), contacts.end(), time_s - kBeside_s);
        const auto at = command.at(time_s);
        const bool on = at && std::all_of(data.command[*at].begin(), data.command[*at].end(),
                                          [](double share) { return share > kRuns; });
        const bool gap = k > 0 && time_s - data.imu_s[k - 1] > 0.02;
        // How fast the rotors turned when the log began nobody knows.
        const bool begins = time_s < data.command_s.front() + kForgotten_s;
        if (!on || gap || begins || (touch != contacts.end() && *touch < time_s + kBeside_s)) {
            if (k > 0) {
                close(k);
            }
        } else if (first == kNone) {
            first = k;
        }
    }
    if (!data.imu_s.empty()) {
        close(data.imu_s.size());
    }
    return all;
}

/// Ordinary least squares; the covariance counts what is left as correlated over `memory` samples
/// (Newey and West, Econometrica 55, 1987).
struct LinearFit {
    VectorXd value;
    MatrixXd covariance;
};
LinearFit linear_fit(const MatrixXd& inputs, const VectorXd& outputs, Eigen::Index memory) {
    const MatrixXd inverse = (inputs.transpose() * inputs)
                                 .ldlt()
                                 .solve(MatrixXd::Identity(inputs.cols(), inputs.cols()));
    LinearFit fit{.value = inverse * inputs.transpose() * outputs, .covariance = {}};
    const VectorXd left = outputs - inputs * fit.value;
    const MatrixXd scores = left.asDiagonal() * inputs;
    MatrixXd sum = scores.transpose() * scores;
    for (Eigen::Index lag = 1; lag <= memory && lag < scores.rows(); ++lag) {
        const double kernel = 1.0 - static_cast<double>(lag) / static_cast<double>(memory + 1);
        const Eigen::Index n = scores.rows() - lag;
        const MatrixXd one = scores.bottomRows(n).transpose() * scores.topRows(n);
        sum += kernel * (one + one.transpose());
    }
    fit.covariance = inverse * sum * inverse;
    return fit;
}

Fitted fitted(double value, double variance) {
    return {value, kNormal * std::sqrt(variance)};
}

/// When a command acts is known to a tick: anywhere in it, as far as a lag is concerned.
Fitted fitted_lag(double lag_s, double log_variance) {
    return fitted(lag_s, lag_s * lag_s * log_variance + kTick_s * kTick_s / 12.0);
}

/// Slope of whitened outputs on inputs, both axes in one. How much it wanders is not known: slopes
/// by each ratio, weighed by how likely it is.
Fitted wandering_slope(const std::array<VectorXd, 2>& inputs,
                       const std::array<VectorXd, 2>& outputs,
                       const std::vector<Stretch>& stretches) {
    struct ByRatio {
        double slope, variance, unlikely;
    };
    std::vector<ByRatio> all;
    double least = std::numeric_limits<double>::infinity();
    const std::size_t count = 2 * samples_of(stretches);
    for (const double ratio : ratios_to_try()) {
        double xx = 0.0, xy = 0.0, yy = 0.0, logs = 0.0;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const VectorXd x = whiten(inputs[axis], stretches, ratio).values;
            const Whitened y = whiten(outputs[axis], stretches, ratio);
            xx += x.squaredNorm();
            xy += x.dot(y.values);
            yy += y.values.squaredNorm();
            logs += y.logs;
        }
        const double squares = yy - xy * xy / xx;
        all.push_back({xy / xx, squares / static_cast<double>(count) / xx,
                       unlikelihood(squares, logs, count)});
        least = std::min(least, all.back().unlikely);
    }
    double sum = 0.0, mean = 0.0, square = 0.0;
    for (const auto& [slope, variance, unlikely] : all) {
        const double weight = std::exp(-0.5 * (unlikely - least));
        sum += weight;
        mean += weight * slope;
        square += weight * (slope * slope + variance);
    }
    mean /= sum;
    return fitted(mean, square / sum - mean * mean);
}

/// Half of how long the steps of our engine are, on the way to a sample; 0 of other logs.
double half_stride_s(const FlightData& data, std::size_t sample) {
    if (data.strides.empty() || sample == 0) {
        return 0.0;
    }
    const auto tick = [](double time_s) { return std::llround(time_s / kTick_s); };
    const std::int64_t first = tick(data.imu_s[sample - 1]), last = tick(data.imu_s[sample]);
    double squares = 0.0;
    for (std::int64_t at = first; at < last;) {
        const int ticks = data.strides[static_cast<std::size_t>(at) % data.strides.size()];
        squares += ticks * ticks;
        at += ticks;
    }
    return 0.5 * kTick_s * squares / static_cast<double>(std::max<std::int64_t>(1, last - first));
}

/// An accelerometer has a bias an axis, which wanders as far in seconds as a slow flight's drag.
void fit_drag(const FlightData& data, const vehicle::Airframe& airframe,
              const std::vector<Stretch>& free, const TurningFit& turning, VehicleFit& fit) {
    constexpr double kLeast_m_s = 0.2;
    LastKnown velocity(data.velocity_s);
    const auto n = static_cast<Eigen::Index>(data.imu_s.size());
    std::array<VectorXd, 2> inputs, outputs;
    inputs.fill(VectorXd::Zero(n));
    outputs.fill(VectorXd::Zero(n));
    std::vector<Stretch> known;  // of what is free, what has a velocity and an accelerometer
    double fastest_m_s = 0.0;
    for (const Stretch& stretch : free) {
        bool goes_on = false;
        for (std::size_t k = stretch.first; k < stretch.last; ++k) {
            const auto at = velocity.at(data.imu_s[k]);
            if (!at || !data.specific_force_B_m_s2[k].allFinite()) {
                goes_on = false;
                continue;
            }
            fastest_m_s = std::max(fastest_m_s, data.velocity_B_m_s[*at].head<2>().norm());
            // In a step of our engine thrust keeps the direction that it had at the step's
            // beginning.
            const Vector3 turned_m_s2 =
                half_stride_s(data, k) * data.rate_B_rad_s[k].cross(data.specific_force_B_m_s2[k]);
            for (std::size_t axis = 0; axis < 2; ++axis) {
                const auto i = static_cast<Eigen::Index>(axis);
                inputs[axis][static_cast<Eigen::Index>(k)] =
                    turning.hub_flow_m[k][i] * airframe.rotor.density_ratio / airframe.mass_kg;
                outputs[axis][static_cast<Eigen::Index>(k)] =
                    data.specific_force_B_m_s2[k][i] + turned_m_s2[i];
            }
            if (!goes_on) {
                known.push_back({k, k});
            }
            goes_on = true;
            known.back().last = k + 1;
        }
    }
    need(!data.velocity_s.empty(), "no velocity in the log");
    need(fastest_m_s >= kLeast_m_s, "it never flies faster than 0.2 m/s");
    fit.drag_constant_kg = wandering_slope(inputs, outputs, known);
}

constexpr double kPress_N = 2.0;  ///< pressed harder: it touches

/// The slider at one instant: travel since the touch, its speed into the vehicle, the force.
struct Pressed {
    double travel_m = 0.0;
    double speed_m_s = 0.0;
    double force_N = 0.0;
};

/// From the first touch until the slider comes back. Speed and travel are the integral of the
/// specific force ahead while level, less its mean over the last of the steady approach.
/// @param touch_s     when the force sensor first feels it
/// @param before_m_s  speed ahead just before
std::vector<Pressed> pressed_from(const FlightData& data, double touch_s, double before_m_s) {
    constexpr double kBefore_s = 0.1, kJustBefore_s = 0.01, kLongest_s = 0.12;
    double v_m_s = before_m_s, x_m = 0.0, steady = 0.0, count = 0.0;
    std::vector<Pressed> rows;
    LastKnown force(data.force_s);
    for (std::size_t k = 1; k < data.imu_s.size(); ++k) {
        const double time_s = data.imu_s[k];
        if (time_s < touch_s - kBefore_s || !data.specific_force_B_m_s2[k].allFinite()) {
            continue;
        }
        if (time_s <= touch_s - kJustBefore_s) {
            steady += data.specific_force_B_m_s2[k].x();
            ++count;
            continue;
        }
        if (time_s > touch_s + kLongest_s) {
            break;
        }
        const double step_s = time_s - data.imu_s[k - 1];
        const double a_m_s2 = data.specific_force_B_m_s2[k].x() - (count > 0 ? steady / count : 0);
        const double last_m_s = v_m_s;
        v_m_s += a_m_s2 * step_s;
        if (time_s >= touch_s - 1e-9) {
            x_m += 0.5 * (last_m_s + v_m_s) * step_s;
        }
        const auto at = force.at(time_s);
        if (at && data.force_N[*at] < -kPress_N) {
            rows.push_back({x_m, v_m_s, -data.force_N[*at]});
        } else if (!rows.empty()) {
            break;
        }
    }
    return rows;
}

/// The slider's force over travel and speed.
void fit_slider(const FlightData& data, VehicleFit& fit) {
    constexpr std::size_t kFewest = 8;
    const auto touch = std::find_if(data.force_N.begin(), data.force_N.end(),
                                    [](double force) { return force < -kPress_N; });
    need(!data.force_s.empty(), "no force sensor in the log");
    need(touch != data.force_N.end(), "the cup is never pressed");
    need(!data.velocity_s.empty() && !data.imu_s.empty(), "no IMU or no velocity in the log");
    const double touch_s = data.force_s[static_cast<std::size_t>(touch - data.force_N.begin())];
    LastKnown velocity(data.velocity_s);
    const auto before = velocity.at(touch_s - 0.01);
    need(before.has_value(), "no velocity before the touch");
    const std::vector<Pressed> rows = pressed_from(data, touch_s, data.velocity_B_m_s[*before].x());
    need(rows.size() >= kFewest, "the touch is too short for this log's rates");
    MatrixXd inputs(static_cast<Eigen::Index>(rows.size()), 3);
    VectorXd outputs(inputs.rows());
    for (Eigen::Index i = 0; i < inputs.rows(); ++i) {
        const Pressed& row = rows[static_cast<std::size_t>(i)];
        inputs.row(i) << row.travel_m, row.speed_m_s, 1.0;
        outputs[i] = row.force_N;
    }
    const LinearFit line = linear_fit(inputs, outputs, 3);
    fit.slider_stiffness_N_m = fitted(line.value[0], line.covariance(0, 0));
    fit.slider_damping_N_s_m = fitted(line.value[1], line.covariance(1, 1));
    fit.slider_preload_N = fitted(line.value[2], line.covariance(2, 2));
}

/// Of the turning fitted by the airframe's lambda_1, which itself is known so far alone.
TurningFit with_unsure_drag(const FlightData& data, const vehicle::Airframe& airframe,
                            const std::vector<Stretch>& free,
                            const std::optional<Fitted>& drag_kg) {
    TurningFit turning = fit_turning(data, airframe, free);
    if (drag_kg) {
        vehicle::Airframe more = airframe;
        more.rotor.drag_constant_kg += drag_kg->half_width / kNormal;
        const TurningFit other = fit_turning(data, more, free);
        Eigen::Matrix<double, 5, 1> moved;
        moved << other.per_inertia - turning.per_inertia,
            std::log(other.lag_up_s / turning.lag_up_s),
            std::log(other.lag_down_s / turning.lag_down_s);
        turning.covariance += moved * moved.transpose();
    }
    return turning;
}

void fit_motion(const FlightData& data, const vehicle::Airframe& airframe, VehicleFit& fit) {
    need(!data.imu_s.empty() && !data.command_s.empty(), "no gyro or no motor commands in the log");
    const std::size_t motors = data.command.front().size();
    need(motors == airframe.rotors.size(),
         fmt::format("the log has {} motors, the vehicle {}", motors, airframe.rotors.size()));
    constexpr double kSlowest_s = 0.0055;
    const double spacing = spacing_s(data.command_s);
    need(
        !(spacing > kSlowest_s),
        fmt::format("motor commands come at {:.0f} Hz, 200 Hz and more are needed (of a simulation "
                    "--set simulation.record_rate_Hz=250, of PX4 SDLOG_PROFILE's high rate)",
                    1.0 / spacing));
    const std::vector<Stretch> free = free_flight(data);
    for (const Stretch& stretch : free) {
        fit.free_s += data.imu_s[stretch.last - 1] - data.imu_s[stretch.first];
    }
    constexpr double kLeast_s = 2.0;
    need(fit.free_s >= kLeast_s,
         fmt::format("{:.1f} s of free flight, 2 s are needed", fit.free_s));
    // What air and cup do to the turning needs lambda_1 and the inertia: once more with those
    // found.
    const TurningFit first = fit_turning(data, airframe, free);
    note_failure(fit, "drag", [&] { fit_drag(data, airframe, free, first, fit); });
    vehicle::Airframe found = airframe;
    found.inertia_kg_m2 = first.per_inertia.cwiseInverse().cwiseMax(0.5 * airframe.inertia_kg_m2);
    if (fit.drag_constant_kg) {
        found.rotor.drag_constant_kg = std::max(0.0, fit.drag_constant_kg->value);
    }
    const TurningFit turning = with_unsure_drag(data, found, free, fit.drag_constant_kg);
    for (int axis = 0; axis < 3; ++axis) {
        const double inertia = 1.0 / turning.per_inertia[axis];
        fit.inertia_kg_m2[static_cast<std::size_t>(axis)] =
            fitted(inertia, std::pow(inertia, 4) * turning.covariance(axis, axis));
    }
    fit.lag_up_s = fitted_lag(turning.lag_up_s, turning.covariance(3, 3));
    fit.lag_down_s = fitted_lag(turning.lag_down_s, turning.covariance(4, 4));
    fit.notes.push_back(fmt::format(
        "taken as known: the rotors' places, thrust, torque and speeds, a dead time of {:.0f} ms, "
        "the mass",
        1000.0 * airframe.rotor.command_delay_s));
}

}  // namespace

VehicleFit identify_vehicle(const FlightData& data, const vehicle::Airframe& airframe) {
    VehicleFit fit;
    note_failure(fit, "inertia, motors' lag and drag", [&] { fit_motion(data, airframe, fit); });
    if (airframe.has_cup) {
        note_failure(fit, "slider", [&] { fit_slider(data, fit); });
        note_failure(fit, "pressure", [&] {
            need(!data.pressure.t_s.empty(), "no cup pressure in the log");
            fit.pressure = identify_pressure(data.pressure);
        });
    }
    return fit;
}

}  // namespace limpet::identification
