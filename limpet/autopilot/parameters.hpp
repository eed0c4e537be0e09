// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "limpet/core/parameters.hpp"

namespace limpet::autopilot {

/// Parameters of the built-in autopilot. Fields carry PX4's names, units and meaning (the one
/// exception to snake_case in Limpet), so that a `.params` file exported from a vehicle loads as
/// it is. Defaults are PX4's, except where the table's source column says "here".
struct AutopilotParameters {
    // Position and velocity, multicopter position control.
    double MPC_XY_P = 0.95;
    double MPC_Z_P = 1.0;
    double MPC_XY_VEL_P_ACC = 1.8;
    double MPC_XY_VEL_I_ACC = 0.4;
    double MPC_XY_VEL_D_ACC = 0.2;
    double MPC_Z_VEL_P_ACC = 4.0;
    double MPC_Z_VEL_I_ACC = 2.0;
    double MPC_Z_VEL_D_ACC = 0.0;
    double MPC_THR_HOVER = 0.657;
    double MPC_THR_MIN = 0.12;
    double MPC_THR_MAX = 1.0;
    double MPC_THR_XY_MARG = 0.3;
    double MPC_XY_VEL_MAX = 12.0;
    double MPC_Z_VEL_MAX_UP = 3.0;
    double MPC_Z_VEL_MAX_DN = 1.5;
    double MPC_TILTMAX_AIR = 45.0;
    double MPC_VELD_LP = 5.0;

    // Attitude.
    double MC_ROLL_P = 6.5;
    double MC_PITCH_P = 6.5;
    double MC_YAW_P = 2.8;
    double MC_YAW_WEIGHT = 0.4;
    double MC_ROLLRATE_MAX = 220.0;
    double MC_PITCHRATE_MAX = 220.0;
    double MC_YAWRATE_MAX = 200.0;
    int attitude_age_steps = 0;  ///< not PX4's name: what its order of work amounts to

    // Rates.
    double MC_ROLLRATE_P = 0.15;
    double MC_ROLLRATE_I = 0.2;
    double MC_ROLLRATE_D = 0.003;
    double MC_ROLLRATE_FF = 0.0;
    double MC_ROLLRATE_K = 1.0;
    double MC_RR_INT_LIM = 0.3;
    double MC_PITCHRATE_P = 0.15;
    double MC_PITCHRATE_I = 0.2;
    double MC_PITCHRATE_D = 0.003;
    double MC_PITCHRATE_FF = 0.0;
    double MC_PITCHRATE_K = 1.0;
    double MC_PR_INT_LIM = 0.3;
    double MC_YAWRATE_P = 0.2;
    double MC_YAWRATE_I = 0.1;
    double MC_YAWRATE_D = 0.0;
    double MC_YAWRATE_FF = 0.0;
    double MC_YAWRATE_K = 1.0;
    double MC_YR_INT_LIM = 0.3;
    double IMU_GYRO_CUTOFF = 30.0;
    double IMU_DGYRO_CUTOFF = 30.0;
    int dgyro_order = 2;  ///< of that low-pass; PX4 has no parameter for it, but had both

    // Estimator. Noises of the IMU are standard deviations per prediction of EKF2_PREDICT_US, as in
    // PX4: times sqrt(10 ms) = 0.1 sqrt(s) they are spectral densities.
    int EKF2_PREDICT_US = 10000;
    double EKF2_GYR_NOISE = 0.015;
    double EKF2_ACC_NOISE = 0.35;
    double EKF2_GYR_B_NOISE = 0.001;
    double EKF2_ACC_B_NOISE = 0.06;
    double EKF2_GBIAS_INIT = 0.1;
    double EKF2_ABIAS_INIT = 0.2;
    double EKF2_ANGERR_INIT = 0.1;
    int EKF2_NOAID_TOUT = 500000;
    int EKF2_EV_CTRL = 15;
    double EKF2_EV_DELAY = 0.0;
    double EKF2_EVP_NOISE = 0.001;
    double EKF2_EVA_NOISE = 0.003;
    double EKF2_EVP_GATE = 5.0;
    double EKF2_HDG_GATE = 5.0;
    int EKF2_GPS_CTRL = 0;
    double EKF2_GPS_P_NOISE = 0.5;
    double EKF2_GPS_V_NOISE = 0.3;
    double EKF2_GPS_P_GATE = 5.0;
    double EKF2_GPS_V_GATE = 5.0;
    int EKF2_BARO_CTRL = 0;
    double EKF2_BARO_NOISE = 3.5;
    double EKF2_BARO_GATE = 5.0;
    int EKF2_MAG_TYPE = 5;
    double EKF2_MAG_NOISE = 0.05;
    double EKF2_MAG_GATE = 3.0;

    // PX4 takes the earth's field from a world model and the position; here it is given.
    double mag_field_north_gauss = 0.21597;
    double mag_field_east_gauss = 0.0;
    double mag_field_down_gauss = 0.42755;
};

/// Table behind the YAML section `autopilot`.
[[nodiscard]] const ParameterTable<AutopilotParameters>& autopilot_table();

/// Where the estimator's position comes from: one name for the parameters of PX4 that say so.
struct PositionSource {
    struct Setting {
        std::string_view parameter;
        int value = 0;
    };
    std::string_view name;  ///< `autopilot.aiding`
    std::string_view description;
    std::array<Setting, 4> settings = {};
};

inline constexpr PositionSource kMotionCaptureAiding = {
    .name = "motion_capture",
    .description = "a motion capture system's pose: indoors",
    .settings = {
        {{"EKF2_EV_CTRL", 15}, {"EKF2_GPS_CTRL", 0}, {"EKF2_BARO_CTRL", 0}, {"EKF2_MAG_TYPE", 5}}}};
inline constexpr PositionSource kGpsAiding = {
    .name = "gps",
    .description = "GPS, barometer and magnetometer: outdoors",
    .settings = {
        {{"EKF2_EV_CTRL", 0}, {"EKF2_GPS_CTRL", 7}, {"EKF2_BARO_CTRL", 1}, {"EKF2_MAG_TYPE", 0}}}};

/// The first is the default.
[[nodiscard]] inline std::span<const PositionSource* const> position_sources() {
    static constexpr std::array kSources = {&kMotionCaptureAiding, &kGpsAiding};
    return kSources;
}

/// @return what a source sets a parameter to; nothing for the others
[[nodiscard]] constexpr std::optional<double> setting_of(const PositionSource& source,
                                                         std::string_view parameter) {
    for (const PositionSource::Setting& setting : source.settings) {
        if (setting.parameter == parameter) {
            return setting.value;
        }
    }
    return std::nullopt;
}

}  // namespace limpet::autopilot
