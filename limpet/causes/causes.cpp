// SPDX-License-Identifier: Apache-2.0
#include "limpet/causes/causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limpet/causes/cause_places.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/vehicle/motor.hpp"

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
        {"motors' lag, s",
         {"vehicle.rotor.time_constant_up_s"},
         Cause::motors,
         0.0125,
         "J R / (Kt^2 + R dQ/dw), 380 KV, R 0.1 … 0.4 ohm, J 1e-4 kg m2 (25 %)",
         kEstimate,
         motor_lag_s},
        {"slowing down over speeding up",
         {},
         Cause::motors,
         2.0,
         "1 … 2",
         "Gazebo's motors 2; speed controllers that brake 1",
         [](R& random) { return uniform(random, 1.0, 2.0); }},
        {"dead time, s",
         {"vehicle.rotor.command_delay_s"},
         Cause::delay,
         0.0,
         "0.001 … 0.006 + 0 … 0.010",
         "PWM of 400 Hz and speed controller; a board's buses and scheduling (assumed). PX4's own "
         "8 "
         "ms are in every set (docs/decisions/0039)",
         [](R& random) { return uniform(random, 0.001, 0.006) + uniform(random, 0.0, 0.010); }},
        {"joint ahead of the centre of mass, m",
         {"vehicle.cup.joint_x_m"},
         Cause::arm,
         0.46,
         "0.40 … 0.58",
         "clear of the discs; the paper's pictures",
         [](R& random) { return uniform(random, 0.40, 0.58); }},
        {"joint below it, m",
         {"vehicle.cup.joint_z_m"},
         Cause::arm,
         0.0,
         "-0.03 … 0.03",
         "assumed: level in the paper's pictures",
         [](R& random) { return uniform(random, -0.03, 0.03); }},
        {"inertia in pitch, kg m2",
         {"vehicle.inertia_kg_m2.yy"},
         Cause::arm,
         0.10,
         "0.092 … 0.13",
         "a sum over guessed components, facts.md section 1; no body beside roll's 0.05 and yaw's "
         "0.14 "
         "has less",
         [](R& random) { return uniform(random, 0.092, 0.13); }},
        {"rate gains over PX4's",
         {"autopilot.MC_PITCHRATE_K"},
         Cause::gains,
         1.0,
         "1, 25 %, 0.5 … 1.6",
         "assumed: defaults, tuned by hand",
         [](R& random) { return std::clamp(random.lognormal(1.0, 0.25), 0.5, 1.6); }},
        {"rate I",
         {"autopilot.MC_PITCHRATE_I"},
         Cause::gains,
         0.2,
         "0.1 … 0.3",
         "PX4's default 0.2, half as much again either way",
         [](R& random) { return uniform(random, 0.1, 0.3); }},
        {"attitude P, 1/s",
         {"autopilot.MC_PITCH_P"},
         Cause::gains,
         6.5,
         "4 … 8",
         "PX4's default 6.5; large vehicles are flown with less",
         [](R& random) { return uniform(random, 4.0, 8.0); }},
        {"filter of the rates, Hz",
         {"autopilot.IMU_GYRO_CUTOFF"},
         Cause::gains,
         30.0,
         "20 … 80",
         "PX4's default 30, later 40; tuning guide to 80",
         [](R& random) { return log_uniform(random, 20.0, 80.0); }},
        {"filter of their slope, Hz",
         {"autopilot.IMU_DGYRO_CUTOFF"},
         Cause::gains,
         30.0,
         "15 … 60",
         "PX4's default 30, half to twice",
         [](R& random) { return log_uniform(random, 15.0, 60.0); }},
        {"slider's stiffness, N/m",
         {"vehicle.slider.stiffness_N_m"},
         Cause::joint,
         500.0,
         "250 … 1000",
         "assumed: half to twice",
         [](R& random) { return log_uniform(random, 250.0, 1000.0); }},
        {"slider's damping, N s/m",
         {"vehicle.slider.damping_N_s_m"},
         Cause::joint,
         30.0,
         "10 … 60",
         "assumed: a third to twice",
         [](R& random) { return log_uniform(random, 10.0, 60.0); }},
        {"cup's centring, N m/rad",
         {"vehicle.cup.centring_stiffness_N_m_rad"},
         Cause::joint,
         0.3,
         "0.05 … 1",
         "assumed",
         [](R& random) { return uniform(random, 0.05, 1.0); }},
        {"lip against tilting, N m/rad",
         {"suction.tilt_stiffness_N_m_rad"},
         Cause::joint,
         20.0,
         "10 … 40",
         "assumed: half to twice",
         [](R& random) { return log_uniform(random, 10.0, 40.0); }},
        {"unsteady moment at the wall, N m",
         {"environment.recirculation_moment_rms_N_m"},
         Cause::wall_air,
         0.0,
         "0 … 0.1",
         "facts.md section 5: the most it allows",
         [](R& random) { return uniform(random, 0.0, 0.1); }},
        {"its correlation time, s",
         {"environment.recirculation_correlation_s"},
         Cause::wall_air,
         0.5,
         "0.2 … 1",
         "facts.md section 5: 0.5, half to twice",
         [](R& random) { return log_uniform(random, 0.2, 1.0); }},
        {"share of the dead time that the simulation has too",
         {},
         Cause::delay,
         0.75,
         "0.5 … 0.9",
         "the paper's simulation had the real Pixhawk in the loop",
         [](R& random) { return uniform(random, 0.5, 0.9); }},
    };
    require(all.size() == static_cast<std::size_t>(kPlaces), "a place for each input");
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
