// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/parameters.hpp"

namespace limpet::autopilot {
namespace {

using P = AutopilotParameters;
using Table = ParameterTable<P>;

Table position_rows() {
    return {
        {"MPC_XY_P", "1/s", 0, 2, &P::MPC_XY_P, "horizontal position error to velocity", "PX4"},
        {"MPC_Z_P", "1/s", 0, 2, &P::MPC_Z_P, "vertical position error to velocity", "PX4"},
        {"MPC_XY_VEL_P_ACC", "1/s", 0, 15, &P::MPC_XY_VEL_P_ACC,
         "horizontal velocity error to acceleration", "PX4"},
        {"MPC_XY_VEL_I_ACC", "1/s^2", 0, 60, &P::MPC_XY_VEL_I_ACC,
         "integral of the horizontal velocity error to acceleration", "PX4"},
        {"MPC_XY_VEL_D_ACC", "-", 0, 2, &P::MPC_XY_VEL_D_ACC,
         "horizontal damping by the measured acceleration", "PX4"},
        {"MPC_Z_VEL_P_ACC", "1/s", 0, 15, &P::MPC_Z_VEL_P_ACC,
         "vertical velocity error to acceleration", "PX4"},
        {"MPC_Z_VEL_I_ACC", "1/s^2", 0, 10, &P::MPC_Z_VEL_I_ACC,
         "integral of the vertical velocity error to acceleration", "PX4"},
        {"MPC_Z_VEL_D_ACC", "-", 0, 2, &P::MPC_Z_VEL_D_ACC,
         "vertical damping by the measured acceleration", "PX4"},
        {"MPC_THR_HOVER", "-", 0.1, 0.95, &P::MPC_THR_HOVER,
         "collective command that carries the weight",
         "here: (560 - 100) / 700, facts.md section 1; PX4 0.5"},
        {"MPC_THR_MIN", "-", 0, 0.5, &P::MPC_THR_MIN, "least collective command in flight", "PX4"},
        {"MPC_THR_MAX", "-", 0.1, 1, &P::MPC_THR_MAX, "largest collective command", "PX4"},
        {"MPC_THR_XY_MARG", "-", 0, 0.5, &P::MPC_THR_XY_MARG,
         "thrust reserved for the horizontal when the vertical needs all", "PX4"},
        {"MPC_XY_VEL_MAX", "m/s", 0.1, 20, &P::MPC_XY_VEL_MAX, "horizontal speed limit", "PX4"},
        {"MPC_Z_VEL_MAX_UP", "m/s", 0.1, 8, &P::MPC_Z_VEL_MAX_UP, "climb limit", "PX4"},
        {"MPC_Z_VEL_MAX_DN", "m/s", 0.1, 4, &P::MPC_Z_VEL_MAX_DN, "sink limit", "PX4"},
        {"MPC_TILTMAX_AIR", "deg", 5, 89, &P::MPC_TILTMAX_AIR,
         "tilt limit of position and velocity control", "PX4"},
        {"MPC_VELD_LP", "Hz", 0, 50, &P::MPC_VELD_LP,
         "low-pass of the acceleration behind the D gains, 0: none", "PX4"},
    };
}

Table attitude_rows() {
    return {
        {"MC_ROLL_P", "1/s", 0, 20, &P::MC_ROLL_P, "roll error to rate", "PX4"},
        {"MC_PITCH_P", "1/s", 0, 20, &P::MC_PITCH_P, "pitch error to rate", "PX4"},
        {"MC_YAW_P", "1/s", 0, 10, &P::MC_YAW_P, "heading error to rate", "PX4"},
        {"MC_YAW_WEIGHT", "-", 0, 1, &P::MC_YAW_WEIGHT,
         "share of the heading error that is corrected together with a tilt error", "PX4"},
        {"MC_ROLLRATE_MAX", "deg/s", 0, 1800, &P::MC_ROLLRATE_MAX, "roll rate limit", "PX4"},
        {"MC_PITCHRATE_MAX", "deg/s", 0, 1800, &P::MC_PITCHRATE_MAX, "pitch rate limit", "PX4"},
        {"MC_YAWRATE_MAX", "deg/s", 0, 1800, &P::MC_YAWRATE_MAX, "yaw rate limit", "PX4"},
        {"attitude_age_steps", "count", 0, 8, &P::attitude_age_steps,
         "control periods by which rate set-points are older than the rates",
         "PX4 v1.15.1 in lockstep 2: vehicle_imu's integral, attitude control after rate control"},
    };
}

Table rate_rows() {
    return {
        {"MC_ROLLRATE_P", "s/rad", 0, 1, &P::MC_ROLLRATE_P, "roll rate error to torque command",
         "PX4"},
        {"MC_ROLLRATE_I", "1/rad", 0, 2, &P::MC_ROLLRATE_I,
         "integral of the roll rate error to torque command", "PX4"},
        {"MC_ROLLRATE_D", "s^2/rad", 0, 0.05, &P::MC_ROLLRATE_D,
         "roll damping by angular acceleration", "PX4"},
        {"MC_ROLLRATE_FF", "s/rad", 0, 1, &P::MC_ROLLRATE_FF,
         "feed-forward of the roll rate setpoint", "PX4"},
        {"MC_ROLLRATE_K", "-", 0.01, 5, &P::MC_ROLLRATE_K, "scales P, I and D of the roll rate",
         "PX4"},
        {"MC_RR_INT_LIM", "-", 0, 1, &P::MC_RR_INT_LIM, "limit of the roll rate's integral", "PX4"},
        {"MC_PITCHRATE_P", "s/rad", 0, 1, &P::MC_PITCHRATE_P, "pitch rate error to torque command",
         "PX4"},
        {"MC_PITCHRATE_I", "1/rad", 0, 2, &P::MC_PITCHRATE_I,
         "integral of the pitch rate error to torque command", "PX4"},
        {"MC_PITCHRATE_D", "s^2/rad", 0, 0.05, &P::MC_PITCHRATE_D,
         "pitch damping by angular acceleration", "PX4"},
        {"MC_PITCHRATE_FF", "s/rad", 0, 1, &P::MC_PITCHRATE_FF,
         "feed-forward of the pitch rate setpoint", "PX4"},
        {"MC_PITCHRATE_K", "-", 0.01, 5, &P::MC_PITCHRATE_K, "scales P, I and D of the pitch rate",
         "PX4"},
        {"MC_PR_INT_LIM", "-", 0, 1, &P::MC_PR_INT_LIM, "limit of the pitch rate's integral",
         "PX4"},
        {"MC_YAWRATE_P", "s/rad", 0, 1, &P::MC_YAWRATE_P, "yaw rate error to torque command",
         "PX4"},
        {"MC_YAWRATE_I", "1/rad", 0, 2, &P::MC_YAWRATE_I,
         "integral of the yaw rate error to torque command", "PX4"},
        {"MC_YAWRATE_D", "s^2/rad", 0, 0.05, &P::MC_YAWRATE_D,
         "yaw damping by angular acceleration", "PX4"},
        {"MC_YAWRATE_FF", "s/rad", 0, 1, &P::MC_YAWRATE_FF, "feed-forward of the yaw rate setpoint",
         "PX4"},
        {"MC_YAWRATE_K", "-", 0.01, 5, &P::MC_YAWRATE_K, "scales P, I and D of the yaw rate",
         "PX4"},
        {"MC_YR_INT_LIM", "-", 0, 1, &P::MC_YR_INT_LIM, "limit of the yaw rate's integral", "PX4"},
        {"IMU_GYRO_CUTOFF", "Hz", 0, 1000, &P::IMU_GYRO_CUTOFF,
         "low-pass of the rates, second order, 0: none", "PX4 as of the paper, facts.md section 6"},
        {"IMU_DGYRO_CUTOFF", "Hz", 0, 1000, &P::IMU_DGYRO_CUTOFF,
         "low-pass of the angular acceleration, 0: none",
         "PX4 as of the paper, facts.md section 6"},
        {"dgyro_order", "count", 1, 2, &P::dgyro_order, "order of that low-pass",
         "PX4 as of the paper; from v1.13 on 1"},
    };
}

Table estimator_rows() {
    return {
        {"EKF2_PREDICT_US", "us", 1000, 20000, &P::EKF2_PREDICT_US,
         "largest step of the covariance, whole", "PX4"},
        {"EKF2_GYR_NOISE", "rad/s", 1e-5, 0.1, &P::EKF2_GYR_NOISE,
         "gyro noise per prediction; 3.39e-3 matches facts.md section 2",
         "PX4, larger than the sensor's to cover vibration and impacts"},
        {"EKF2_ACC_NOISE", "m/s^2", 1e-4, 1, &P::EKF2_ACC_NOISE,
         "accelerometer noise per prediction; 0.04 matches facts.md section 2",
         "PX4, larger than the sensor's to cover vibration and impacts"},
        {"EKF2_GYR_B_NOISE", "rad/s^2", 0, 0.01, &P::EKF2_GYR_B_NOISE,
         "gyro bias random walk per prediction; 3.88e-4 matches facts.md section 2", "PX4"},
        {"EKF2_ACC_B_NOISE", "m/s^3", 0, 0.1, &P::EKF2_ACC_B_NOISE,
         "accelerometer bias random walk per prediction",
         "here: matches facts.md section 2; PX4 0.003"},
        {"EKF2_GBIAS_INIT", "rad/s", 0, 0.2, &P::EKF2_GBIAS_INIT,
         "standard deviation of the gyro bias at start", "PX4"},
        {"EKF2_ABIAS_INIT", "m/s^2", 0, 0.5, &P::EKF2_ABIAS_INIT,
         "standard deviation of the accelerometer bias at start", "PX4"},
        {"EKF2_ANGERR_INIT", "rad", 0, 0.5, &P::EKF2_ANGERR_INIT,
         "standard deviation of the attitude at start", "PX4"},
        {"EKF2_NOAID_TOUT", "us", 100000, 10000000, &P::EKF2_NOAID_TOUT,
         "age of the aiding from which the estimate is not valid, whole",
         "here: a flight near a wall cannot coast; PX4 5e6"},
        {"EKF2_EV_CTRL", "count", 0, 15, &P::EKF2_EV_CTRL,
         "motion capture, bits: 1 horizontal position, 2 height, 8 attitude",
         "PX4 (whose bit 8 is the heading alone)"},
        {"EKF2_EV_DELAY", "ms", 0, 300, &P::EKF2_EV_DELAY,
         "how much older motion capture is than its time stamp says", "PX4"},
        {"EKF2_EVP_NOISE", "m", 1e-5, 1, &P::EKF2_EVP_NOISE, "motion capture position noise",
         "here: 0.5 mm, facts.md section 2, doubled; PX4 0.1"},
        {"EKF2_EVA_NOISE", "rad", 1e-5, 1, &P::EKF2_EVA_NOISE, "motion capture attitude noise",
         "here: 0.1 deg, facts.md section 2, nearly doubled; PX4 0.1"},
        {"EKF2_EVP_GATE", "SD", 1, 100, &P::EKF2_EVP_GATE,
         "innovation gate of motion capture position", "PX4"},
        {"EKF2_HDG_GATE", "SD", 1, 100, &P::EKF2_HDG_GATE,
         "innovation gate of motion capture attitude", "here: three axes; PX4 2.6"},
        {"EKF2_GPS_CTRL", "count", 0, 15, &P::EKF2_GPS_CTRL,
         "GPS, bits: 1 horizontal position, 2 height, 4 velocity",
         "here: motion capture instead; PX4 7"},
        {"EKF2_GPS_P_NOISE", "m", 0.001, 10, &P::EKF2_GPS_P_NOISE,
         "GPS position noise, height 1.5 times that", "PX4"},
        {"EKF2_GPS_V_NOISE", "m/s", 0.001, 5, &P::EKF2_GPS_V_NOISE, "GPS velocity noise", "PX4"},
        {"EKF2_GPS_P_GATE", "SD", 1, 100, &P::EKF2_GPS_P_GATE, "innovation gate of GPS position",
         "PX4"},
        {"EKF2_GPS_V_GATE", "SD", 1, 100, &P::EKF2_GPS_V_GATE, "innovation gate of GPS velocity",
         "PX4"},
        {"EKF2_BARO_CTRL", "count", 0, 1, &P::EKF2_BARO_CTRL, "1: fuse barometric height",
         "here: motion capture instead; PX4 1"},
        {"EKF2_BARO_NOISE", "m", 0.01, 15, &P::EKF2_BARO_NOISE, "barometric height noise", "PX4"},
        {"EKF2_BARO_GATE", "SD", 1, 100, &P::EKF2_BARO_GATE, "innovation gate of barometric height",
         "PX4"},
        {"EKF2_MAG_TYPE", "count", 0, 6, &P::EKF2_MAG_TYPE,
         "5 and 6: no magnetometer; otherwise its three axes are fused",
         "here: motion capture instead; PX4 0"},
        {"EKF2_MAG_NOISE", "gauss", 0.001, 1, &P::EKF2_MAG_NOISE, "magnetometer noise", "PX4"},
        {"EKF2_MAG_GATE", "SD", 1, 100, &P::EKF2_MAG_GATE, "innovation gate of the magnetometer",
         "PX4"},
        {"mag_field_north_gauss", "gauss", -1, 1, &P::mag_field_north_gauss, "earth's field, north",
         "assumed: Zurich, 0.479 gauss dipping by 63.2 deg, as the sensors'"},
        {"mag_field_east_gauss", "gauss", -1, 1, &P::mag_field_east_gauss, "earth's field, east",
         "assumed: W's north is magnetic"},
        {"mag_field_down_gauss", "gauss", -1, 1, &P::mag_field_down_gauss, "earth's field, down",
         "assumed: Zurich, 0.479 gauss dipping by 63.2 deg, as the sensors'"},
    };
}

}  // namespace

const Table& autopilot_table() {
    static const Table table = [] {
        Table all;
        for (const Table& part :
             {position_rows(), attitude_rows(), rate_rows(), estimator_rows()}) {
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }();
    return table;
}

}  // namespace limpet::autopilot
