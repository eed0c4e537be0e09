// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/vehicle_mode.hpp"

namespace limpet::ros {

const ParameterTable<OffboardManners>& offboard_manners_table() {
    using M = OffboardManners;
    static const ParameterTable<M> table = {
        {"offboard_loss_s", "s", 0.02, 60.0, &M::loss_s, "without set-points for so long it holds",
         "PX4 allows 1 s (COM_OF_LOSS_T); half of it, as set-points come 50 times a second"},
        {"hold_speed_m_s", "m/s", 0.01, 10.0, &M::hold_speed_m_s,
         "it brakes down to this, then holds where it is",
         "assumed; PX4 brakes too before it locks its position (MPC_HOLD_MAX_XY)"},
    };
    return table;
}

void VehicleMode::set_point(const decltype(Setpoint::motion)& motion, double time_s) {
    motion_ = motion;
    set_s_ = time_s;
}

bool VehicleMode::choose(std::string_view mode, double time_s) {
    if (mode == kOffboard) {
        offboard_ = offboard_ || fresh(time_s);
        return true;
    }
    if (mode == kHold) {
        offboard_ = false;
        return true;
    }
    return false;
}

decltype(Setpoint::motion) VehicleMode::hold(const Estimate& estimate) {
    if (!held_ && !brake_yaw_rad_) {
        brake_yaw_rad_ = euler_from_quaternion(estimate.q_WB).yaw_rad;
    }
    if (!held_ && estimate.v_WB_m_s.norm() < manners_.hold_speed_m_s) {
        held_ = PositionSetpoint{.p_W_m = estimate.p_WB_m, .yaw_rad = *brake_yaw_rad_};
    }
    if (held_) {
        return *held_;
    }
    return VelocitySetpoint{.yaw_rad = *brake_yaw_rad_};
}

bool VehicleMode::update(const Estimate& estimate, double time_s, Setpoint& setpoint) {
    const bool lost = offboard_ && !fresh(time_s);
    offboard_ = offboard_ && !lost;
    if (offboard_ || !armed_) {  // who holds after that begins anew
        held_.reset();
        brake_yaw_rad_.reset();
    }
    setpoint.armed = armed_;
    if (offboard_) {
        setpoint.motion = motion_;
    } else if (armed_) {
        setpoint.motion = hold(estimate);
    } else {
        setpoint.motion = IdleSetpoint{};
    }
    return lost;
}

}  // namespace limpet::ros
