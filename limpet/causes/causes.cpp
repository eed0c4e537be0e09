// SPDX-License-Identifier: Apache-2.0
#include "limpet/causes/causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet::causes {
namespace {

constexpr const char* kMetal = "perch_metal";

double uniform(RandomStream& random, double low, double high) {
    return low + (high - low) * random.uniform();
}
double log_uniform(RandomStream& random, double low, double high) {
    return low * std::pow(high / low, random.uniform());
}

/// A brushless motor's lag about hover: J R / (Kt^2 + R dQ/dw), Kt of 380 rpm/V.
/// Source: Franklin et al., "Feedback control of dynamic systems", 2.3 (a motor's equations).
double motor_lag_s(RandomStream& random) {
    constexpr double kHover_rad_s = 560.0;
    vehicle::RotorParameters rotor{.motor_kv_rpm_V = 380.0};  // and Table I
    rotor.motor_resistance_ohm = uniform(random, 0.1, 0.4);
    rotor.spin_inertia_kg_m2 = std::clamp(random.lognormal(1e-4, 0.25), 5e-5, 1.6e-4);
    return vehicle::lag_s(vehicle::motor_law(rotor), kHover_rad_s);
}

}  // namespace

const char* to_text(Cause cause) {
    constexpr const char* kNames[kCauses] = {"motors", "dead time",        "arm",
                                             "gains",  "slider and joint", "air at the wall"};
    return kNames[static_cast<std::size_t>(cause)];
}

const std::vector<CauseInput>& cause_inputs() {
    using R = RandomStream;
    constexpr const char* kEstimate = "estimate, docs/reference/facts.md section 1";
    static const std::vector<CauseInput> all = {
        {.place = kLag,
         .name = "motors' lag, s",
         .keys = {"vehicle.rotor.time_constant_up_s"},
         .cause = Cause::motors,
         .as_simulated = 0.0125,
         .prior = "J R / (Kt^2 + R dQ/dw), 380 KV, R 0.1 … 0.4 ohm, J 1e-4 kg m2 (25 %)",
         .source = kEstimate,
         .draw = motor_lag_s},
        {.place = kRatio,
         .name = "slowing down over speeding up",
         .keys = {},
         .cause = Cause::motors,
         .as_simulated = 2.0,
         .prior = "1 … 2",
         .source = "Gazebo's motors 2; speed controllers that brake 1",
         .draw = [](R& random) { return uniform(random, 1.0, 2.0); }},
        {.place = kDelay,
         .name = "dead time, s",
         .keys = {"vehicle.rotor.command_delay_s"},
         .cause = Cause::delay,
         .as_simulated = 0.0,
         .prior = "0.001 … 0.006 + 0 … 0.010",
         .source = "PWM of 400 Hz and speed controller; a board's buses and scheduling (assumed). "
                   "PX4's own "
                   "8 "
                   "ms are in every set (docs/decisions/0039)",
         .draw =
             [](R& random) { return uniform(random, 0.001, 0.006) + uniform(random, 0.0, 0.010); }},
        {.place = kJointX,
         .name = "joint ahead of the centre of mass, m",
         .keys = {"vehicle.cup.joint_x_m"},
         .cause = Cause::arm,
         .as_simulated = 0.46,
         .prior = "0.40 … 0.58",
         .source = "clear of the discs; the paper's pictures",
         .draw = [](R& random) { return uniform(random, 0.40, 0.58); }},
        {.place = kJointZ,
         .name = "joint below it, m",
         .keys = {"vehicle.cup.joint_z_m"},
         .cause = Cause::arm,
         .as_simulated = 0.0,
         .prior = "-0.03 … 0.03",
         .source = "assumed: level in the paper's pictures",
         .draw = [](R& random) { return uniform(random, -0.03, 0.03); }},
        {.place = kInertia,
         .name = "inertia in pitch, kg m2",
         .keys = {"vehicle.inertia_kg_m2.yy"},
         .cause = Cause::arm,
         .as_simulated = 0.10,
         .prior = "0.092 … 0.13",
         .source = "a sum over guessed components, facts.md section 1; no body with roll's 0.05 "
                   "and yaw's "
                   "0.14 "
                   "has less",
         .draw = [](R& random) { return uniform(random, 0.092, 0.13); }},
        {.place = kRateK,
         .name = "rate gains over PX4's",
         .keys = {"autopilot.MC_PITCHRATE_K"},
         .cause = Cause::gains,
         .as_simulated = 1.0,
         .prior = "1, 25 %, 0.5 … 1.6",
         .source = "assumed: defaults, tuned by hand",
         .draw = [](R& random) { return std::clamp(random.lognormal(1.0, 0.25), 0.5, 1.6); }},
        {.place = kRateI,
         .name = "rate I",
         .keys = {"autopilot.MC_PITCHRATE_I"},
         .cause = Cause::gains,
         .as_simulated = 0.2,
         .prior = "0.1 … 0.3",
         .source = "PX4's default 0.2, half as much again either way",
         .draw = [](R& random) { return uniform(random, 0.1, 0.3); }},
        {.place = kAttitudeP,
         .name = "attitude P, 1/s",
         .keys = {"autopilot.MC_PITCH_P"},
         .cause = Cause::gains,
         .as_simulated = 6.5,
         .prior = "4 … 8",
         .source = "PX4's default 6.5; large vehicles are flown with less",
         .draw = [](R& random) { return uniform(random, 4.0, 8.0); }},
        {.place = kGyro,
         .name = "filter of the rates, Hz",
         .keys = {"autopilot.IMU_GYRO_CUTOFF"},
         .cause = Cause::gains,
         .as_simulated = 30.0,
         .prior = "20 … 80",
         .source = "PX4's default 30, later 40; tuning guide to 80",
         .draw = [](R& random) { return log_uniform(random, 20.0, 80.0); }},
        {.place = kDerivative,
         .name = "filter of their slope, Hz",
         .keys = {"autopilot.IMU_DGYRO_CUTOFF"},
         .cause = Cause::gains,
         .as_simulated = 30.0,
         .prior = "15 … 60",
         .source = "PX4's default 30, half to twice",
         .draw = [](R& random) { return log_uniform(random, 15.0, 60.0); }},
        {.place = kStiffness,
         .name = "slider's stiffness, N/m",
         .keys = {"vehicle.slider.stiffness_N_m"},
         .cause = Cause::joint,
         .as_simulated = 500.0,
         .prior = "250 … 1000",
         .source = "assumed: half to twice",
         .draw = [](R& random) { return log_uniform(random, 250.0, 1000.0); }},
        {.place = kDamping,
         .name = "slider's damping, N s/m",
         .keys = {"vehicle.slider.damping_N_s_m"},
         .cause = Cause::joint,
         .as_simulated = 30.0,
         .prior = "10 … 60",
         .source = "assumed: a third to twice",
         .draw = [](R& random) { return log_uniform(random, 10.0, 60.0); }},
        {.place = kCentring,
         .name = "cup's centring, N m/rad",
         .keys = {"vehicle.cup.centring_stiffness_N_m_rad"},
         .cause = Cause::joint,
         .as_simulated = 0.3,
         .prior = "0.05 … 1",
         .source = "assumed",
         .draw = [](R& random) { return uniform(random, 0.05, 1.0); }},
        {.place = kTilt,
         .name = "lip against tilting, N m/rad",
         .keys = {"suction.tilt_stiffness_N_m_rad"},
         .cause = Cause::joint,
         .as_simulated = 20.0,
         .prior = "10 … 40",
         .source = "assumed: half to twice",
         .draw = [](R& random) { return log_uniform(random, 10.0, 40.0); }},
        {.place = kMoment,
         .name = "unsteady moment at the wall, N m",
         .keys = {"environment.recirculation_moment_rms_N_m"},
         .cause = Cause::wall_air,
         .as_simulated = 0.0,
         .prior = "0 … 0.1",
         .source = "facts.md section 5: the most it allows",
         .draw = [](R& random) { return uniform(random, 0.0, 0.1); }},
        {.place = kCorrelation,
         .name = "its correlation time, s",
         .keys = {"environment.recirculation_correlation_s"},
         .cause = Cause::wall_air,
         .as_simulated = 0.5,
         .prior = "0.2 … 1",
         .source = "facts.md section 5: 0.5, half to twice",
         .draw = [](R& random) { return log_uniform(random, 0.2, 1.0); }},
        {.place = kShared,
         .name = "share of the dead time that the simulation has too",
         .keys = {},
         .cause = Cause::delay,
         .as_simulated = 0.75,
         .prior = "0.5 … 0.9",
         .source = "the paper's simulation had the real Pixhawk in the loop",
         .draw = [](R& random) { return uniform(random, 0.5, 0.9); }},
    };
    require(all.size() == static_cast<std::size_t>(kPlaces), "an input for each place");
    for (std::size_t i = 0; i < all.size(); ++i) {
        require(all[i].place == static_cast<CausePlace>(i), "inputs in the order of their places");
    }
    return all;
}

CausePoint as_simulated() {
    CausePoint point(kPlaces);
    for (Eigen::Index i = 0; i < kPlaces; ++i) {
        point[i] = cause_inputs()[static_cast<std::size_t>(i)].as_simulated;
    }
    return point;
}

CausePoint draw_point(std::size_t subset, RandomStream& random) {
    CausePoint point = as_simulated();
    for (Eigen::Index i = 0; i < kPlaces; ++i) {
        const CauseInput& input = cause_inputs()[static_cast<std::size_t>(i)];
        const double drawn = input.draw(random);  // also where it is not used: draws stay in step
        if (takes_part(subset, input.cause)) {
            point[i] = drawn;
        }
    }
    return point;
}

stability::Overrides overrides_of(const CausePoint& point) {
    // A Pixhawk's order of work (docs/decisions/0039), in the vehicle and its simulation alike.
    stability::Overrides all = {"autopilot.attitude_age_steps=2"};
    for (Eigen::Index i = 0; i < kPlaces; ++i) {
        for (const std::string& key : cause_inputs()[static_cast<std::size_t>(i)].keys) {
            all.push_back(fmt::format("{}={}", key, point[i]));
        }
    }
    all.push_back(
        fmt::format("vehicle.rotor.time_constant_down_s={}", point[kLag] * point[kRatio]));
    return all;
}

PointSwing swing_of(const CausePoint& point, const stability::SwingOf& linear) {
    const std::optional<stability::Mode> mode = linear(kMetal, overrides_of(point));
    if (!mode) {
        return {};
    }
    return is_swing(*mode) || mode->growth_1_s > 0.0
               ? PointSwing{true, mode->growth_1_s, mode->frequency_Hz}
               : PointSwing{.rests = true};
}

}  // namespace limpet::causes
