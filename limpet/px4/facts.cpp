// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/facts.hpp"

#include <algorithm>
#include <limits>

namespace limpet::px4 {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

}  // namespace

const std::vector<Px4Fact>& px4_facts() {
    static const std::vector<Px4Fact> facts = {
        {"CA_AIRFRAME", Px4Type::int32, 0, 0, 12},
        {"CA_ROTOR_COUNT", Px4Type::int32, 0, 0, 12},
        {"CA_ROTOR0_PX", Px4Type::real32, 0, -100, 100},
        {"CA_ROTOR0_PY", Px4Type::real32, 0, -100, 100},
        {"CA_ROTOR0_KM", Px4Type::real32, 0.05, -1, 1},
        {"CA_ROTOR1_PX", Px4Type::real32, 0, -100, 100},
        {"CA_ROTOR1_PY", Px4Type::real32, 0, -100, 100},
        {"CA_ROTOR1_KM", Px4Type::real32, 0.05, -1, 1},
        {"CA_ROTOR2_PX", Px4Type::real32, 0, -100, 100},
        {"CA_ROTOR2_PY", Px4Type::real32, 0, -100, 100},
        {"CA_ROTOR2_KM", Px4Type::real32, 0.05, -1, 1},
        {"CA_ROTOR3_PX", Px4Type::real32, 0, -100, 100},
        {"CA_ROTOR3_PY", Px4Type::real32, 0, -100, 100},
        {"CA_ROTOR3_KM", Px4Type::real32, 0.05, -1, 1},
        {"PWM_MAIN_FUNC1", Px4Type::int32, 0, 0, 440},
        {"PWM_MAIN_FUNC2", Px4Type::int32, 0, 0, 440},
        {"PWM_MAIN_FUNC3", Px4Type::int32, 0, 0, 440},
        {"PWM_MAIN_FUNC4", Px4Type::int32, 0, 0, 440},
        {"BAT1_N_CELLS", Px4Type::int32, 0, 0, 16},
        {"BAT1_CAPACITY", Px4Type::real32, -1, -1, 100000},
        {"THR_MDL_FAC", Px4Type::real32, 0, 0, 1},
        {"MPC_USE_HTE", Px4Type::int32, 1, 0, 1},
        {"EKF2_EV_CTRL", Px4Type::int32, 15, 0, 15},
        {"EKF2_EV_DELAY", Px4Type::real32, 0, 0, 300},
        {"EKF2_EV_NOISE_MD", Px4Type::int32, 0, 0, 1},
        {"EKF2_EVP_NOISE", Px4Type::real32, 0.1, 0.01, kNone},
        {"EKF2_EVA_NOISE", Px4Type::real32, 0.1, 0.05, kNone},
        {"EKF2_HGT_REF", Px4Type::int32, 1, 0, 3},
        {"EKF2_GPS_CTRL", Px4Type::int32, 7, 0, 15},
        {"EKF2_BARO_CTRL", Px4Type::int32, 1, 0, 1},
        {"EKF2_MAG_TYPE", Px4Type::int32, 0, 0, 5},
        {"SYS_HAS_GPS", Px4Type::int32, 1, 0, 1},
        {"SYS_HAS_MAG", Px4Type::int32, 1, -kNone, kNone},
        {"COM_ARM_WO_GPS", Px4Type::int32, 1, 0, 1},
        {"FD_FAIL_P", Px4Type::int32, 60, 0, 180},
        {"FD_FAIL_R", Px4Type::int32, 60, 0, 180},
        {"COM_DISARM_PRFLT", Px4Type::real32, 10, -kNone, kNone},
        {"COM_DISARM_LAND", Px4Type::real32, 2, -kNone, kNone},
        {"COM_SPOOLUP_TIME", Px4Type::real32, 1, 0, 30},
        {"COM_OF_LOSS_T", Px4Type::real32, 1, 0, 60},
        {"COM_OBL_RC_ACT", Px4Type::int32, 0, 0, 7},
        {"COM_RC_IN_MODE", Px4Type::int32, 3, 0, 4},
        {"NAV_DLL_ACT", Px4Type::int32, 0, 0, 6},
        {"COM_ARM_SDCARD", Px4Type::int32, 1, 0, 2},
        {"COM_LOW_BAT_ACT", Px4Type::int32, 0, 0, 3},
        {"COM_FLTT_LOW_ACT", Px4Type::int32, 3, 0, 3},
        {"CBRK_SUPPLY_CHK", Px4Type::int32, 0, 0, 894281},
        {"SYS_HITL", Px4Type::int32, 0, -1, 2},
        {"MAV_1_MODE", Px4Type::int32, 2, 0, 12},
        {"MAV_1_RATE", Px4Type::int32, 0, 0, kNone},
        {"MAV_1_FORWARD", Px4Type::int32, 0, 0, 1},
        {"MPC_XY_P", Px4Type::real32, 0.95, 0, 2},
        {"MPC_Z_P", Px4Type::real32, 1, 0.1, 1.5},
        {"MPC_XY_VEL_P_ACC", Px4Type::real32, 1.8, 1.2, 5},
        {"MPC_XY_VEL_I_ACC", Px4Type::real32, 0.4, 0, 60},
        {"MPC_XY_VEL_D_ACC", Px4Type::real32, 0.2, 0.1, 2},
        {"MPC_Z_VEL_P_ACC", Px4Type::real32, 4, 2, 15},
        {"MPC_Z_VEL_I_ACC", Px4Type::real32, 2, 0.2, 3},
        {"MPC_Z_VEL_D_ACC", Px4Type::real32, 0, 0, 2},
        {"MPC_THR_HOVER", Px4Type::real32, 0.5, 0.1, 0.8},
        {"MPC_THR_MIN", Px4Type::real32, 0.12, 0.05, 0.5},
        {"MPC_THR_MAX", Px4Type::real32, 1, 0, 1},
        {"MPC_THR_XY_MARG", Px4Type::real32, 0.3, 0, 0.5},
        {"MPC_XY_VEL_MAX", Px4Type::real32, 12, 0, 20},
        {"MPC_Z_VEL_MAX_UP", Px4Type::real32, 3, 0.5, 8},
        {"MPC_Z_VEL_MAX_DN", Px4Type::real32, 1.5, 0.5, 4},
        {"MPC_TILTMAX_AIR", Px4Type::real32, 45, 20, 89},
        {"MPC_VELD_LP", Px4Type::real32, 5, 0, 10},
        {"MC_ROLL_P", Px4Type::real32, 6.5, 0, 12},
        {"MC_PITCH_P", Px4Type::real32, 6.5, 0, 12},
        {"MC_YAW_P", Px4Type::real32, 2.8, 0, 5},
        {"MC_YAW_WEIGHT", Px4Type::real32, 0.4, 0, 1},
        {"MC_ROLLRATE_MAX", Px4Type::real32, 220, 0, 1800},
        {"MC_PITCHRATE_MAX", Px4Type::real32, 220, 0, 1800},
        {"MC_YAWRATE_MAX", Px4Type::real32, 200, 0, 1800},
        {"MC_ROLLRATE_P", Px4Type::real32, 0.15, 0.01, 0.5},
        {"MC_ROLLRATE_I", Px4Type::real32, 0.2, 0, kNone},
        {"MC_ROLLRATE_D", Px4Type::real32, 0.003, 0, 0.01},
        {"MC_ROLLRATE_FF", Px4Type::real32, 0, 0, kNone},
        {"MC_ROLLRATE_K", Px4Type::real32, 1, 0.01, 5},
        {"MC_RR_INT_LIM", Px4Type::real32, 0.3, 0, kNone},
        {"MC_PITCHRATE_P", Px4Type::real32, 0.15, 0.01, 0.6},
        {"MC_PITCHRATE_I", Px4Type::real32, 0.2, 0, kNone},
        {"MC_PITCHRATE_D", Px4Type::real32, 0.003, 0, kNone},
        {"MC_PITCHRATE_FF", Px4Type::real32, 0, 0, kNone},
        {"MC_PITCHRATE_K", Px4Type::real32, 1, 0.01, 5},
        {"MC_PR_INT_LIM", Px4Type::real32, 0.3, 0, kNone},
        {"MC_YAWRATE_P", Px4Type::real32, 0.2, 0, 0.6},
        {"MC_YAWRATE_I", Px4Type::real32, 0.1, 0, kNone},
        {"MC_YAWRATE_D", Px4Type::real32, 0, 0, kNone},
        {"MC_YAWRATE_FF", Px4Type::real32, 0, 0, kNone},
        {"MC_YAWRATE_K", Px4Type::real32, 1, 0, 5},
        {"MC_YR_INT_LIM", Px4Type::real32, 0.3, 0, kNone},
        {"IMU_GYRO_CUTOFF", Px4Type::real32, 40, 0, 1000},
        {"IMU_DGYRO_CUTOFF", Px4Type::real32, 30, 0, 1000},
        // Boards only: not in SITL's list. pwm_out_sim/module_hil.yaml, serial_params.c.jinja,
        // uavcan_params.c.
        {"HIL_ACT_FUNC1", Px4Type::int32, 0, 0, 440},
        {"HIL_ACT_FUNC2", Px4Type::int32, 0, 0, 440},
        {"HIL_ACT_FUNC3", Px4Type::int32, 0, 0, 440},
        {"HIL_ACT_FUNC4", Px4Type::int32, 0, 0, 440},
        {"UAVCAN_ENABLE", Px4Type::int32, 0, 0, 3},
        {"MAV_1_CONFIG", Px4Type::int32, 0, 0, 1000},
        {"SER_TEL2_BAUD", Px4Type::int32, 921600, 0, 3000000},
    };
    return facts;
}

const Px4Fact* find_px4_fact(std::string_view name) {
    const auto& facts = px4_facts();
    const auto found = std::find_if(facts.begin(), facts.end(),
                                    [name](const Px4Fact& fact) { return fact.name == name; });
    return found == facts.end() ? nullptr : &*found;
}

}  // namespace limpet::px4
