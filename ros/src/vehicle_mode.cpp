// SPDX-License-Identifier: Apache-2.0
#include "ros/src/vehicle_mode.hpp"

namespace limpet::ros {

const ParameterTable<OffboardManners>& offboard_manners_table() {
    using M = OffboardManners;
    static const ParameterTable<M> table = {
        {"offboard_loss_s", "s", 0.02, 60.0, [](M& m) -> double& { return m.loss_s; },
         "without set-points for so long it holds",
         "PX4 allows 1 s (COM_OF_LOSS_T); half of it, as set-points come 50 times a second"},
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

bool VehicleMode::update(const Estimate& estimate, double time_s, Setpoint& setpoint) {
    const bool lost = offboard_ && !fresh(time_s);
    offboard_ = offboard_ && !lost;
    if (offboard_) {
        held_.reset();
    } else if (!armed_) {
        held_.reset();  // armed again it holds where it is then
    } else if (!held_) {
        held_ = PositionSetpoint{.p_W_m = estimate.p_WB_m,
                                 .yaw_rad = euler_from_quaternion(estimate.q_WB).yaw_rad};
    }
    setpoint.armed = armed_;
    if (offboard_) {
        setpoint.motion = motion_;
    } else if (held_) {
        setpoint.motion = *held_;
    } else {
        setpoint.motion = IdleSetpoint{};
    }
    return lost;
}

}  // namespace limpet::ros
