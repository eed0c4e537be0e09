// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in_flight.hpp"

#include <variant>

#include "limpet/mavlink/numbers.hpp"

namespace limpet::px4 {
namespace {

/// From this EKF2_MAG_TYPE on there is no magnetometer, as the estimator has it.
constexpr int kNoMagnetometer = 5;
constexpr double kOldestPose_s = 0.5;
/// A pose may be stamped with the HIL_SENSOR that is about to come.
constexpr double kYoungestPose_s = 0.02;

/// Columns: first along `main`, then across it and `side`, then the rest.
Matrix3 triad(const Vector3& main, const Vector3& side) {
    Matrix3 axes;
    axes.col(0) = main.normalized();
    axes.col(1) = main.cross(side).normalized();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
}

/// Level by gravity, heading by the earth's field.
Quaternion level_attitude(const autopilot::AutopilotParameters& p, const Readings& readings) {
    const Vector3 field_W_gauss(p.mag_field_north_gauss, p.mag_field_east_gauss,
                                p.mag_field_down_gauss);
    const Matrix3 R_WB =
        triad(Vector3::UnitZ(), field_W_gauss) *
        triad(-readings.imu.value.specific_force_B_m_s2, readings.magnetometer.value.field_B_gauss)
            .transpose();
    return Quaternion(R_WB).normalized();
}

/// @return where it is, once what the parameters want to be aided by has been received
std::optional<Estimate> first_estimate(const autopilot::AutopilotParameters& p,
                                       const StandInFlight& flight) {
    const Readings& readings = flight.readings;
    if (!readings.imu.ever()) {
        return std::nullopt;
    }
    Estimate initial;
    initial.time_s = readings.imu.time_s;
    initial.w_WB_B_rad_s = readings.imu.value.rate_B_rad_s;
    initial.specific_force_B_m_s2 = readings.imu.value.specific_force_B_m_s2;
    if (p.EKF2_EV_CTRL > 0) {
        if (!readings.motion_capture.ever()) {
            return std::nullopt;
        }
        initial.p_WB_m = readings.motion_capture.value.p_WB_m;
        initial.q_WB = readings.motion_capture.value.q_WB;
        return initial;
    }
    if (!readings.gps.ever() || !readings.magnetometer.ever() ||
        p.EKF2_MAG_TYPE >= kNoMagnetometer) {
        return std::nullopt;
    }
    initial.p_WB_m = readings.gps.value.p_WB_m;
    initial.v_WB_m_s = readings.gps.value.v_WB_m_s;
    initial.q_WB = level_attitude(p, readings);
    return initial;
}

Situation situation(const StandInFlight& flight) {
    const Euler angles = euler_from_quaternion(flight.autopilot.estimate.q_WB);
    return {.time_s = flight.time_s,
            .thrust = flight.thrust,
            .set_point_s = flight.heard_s,
            .roll_rad = angles.roll_rad,
            .pitch_rad = angles.pitch_rad,
            .estimate_valid = flight.valid() && flight.time_s >= flight.unsettled_until_s};
}

/// Where it is now; without an origin PX4 holds over (0, 0) of its own. Source: px4.md "Motion
/// capture"
void hold_here(StandInFlight& flight) {
    const Estimate& estimate = flight.autopilot.estimate;
    flight.hold = {.p_W_m = estimate.p_WB_m,
                   .yaw_rad = euler_from_quaternion(estimate.q_WB).yaw_rad};
    if (!flight.origin) {
        flight.hold.p_W_m.head<2>().setZero();
    }
}

Setpoint wanted(const StandInFlight& flight) {
    Setpoint setpoint;
    setpoint.armed = flight.manners.armed();
    if (flight.manners.mode == FlightMode::offboard) {
        setpoint.motion = flight.commanded.motion;
    } else if (flight.manners.in_air()) {
        setpoint.motion = flight.hold;
    }
    return setpoint;
}

mavlink::GpsGlobalOrigin at(const mavlink::GeographicOrigin& place, double time_s) {
    mavlink::GpsGlobalOrigin origin{.time_usec = mavlink::boot_us(time_s)};
    put(place, origin.latitude, origin.longitude, origin.altitude);
    return origin;
}

void hear_motion(StandInFlight& flight, const auto& motion) {
    if (motion) {
        flight.commanded.motion = *motion;
        flight.heard_s = flight.time_s;
    }
}

}  // namespace

bool step(const autopilot::AutopilotModel& model, const StandInParameters& parameters,
          StandInFlight& flight, const mavlink::HilSensor& message) {
    const double time_s = 1e-6 * static_cast<double>(message.time_usec);
    if (!(time_s > flight.time_s)) {
        return false;
    }
    flight.time_s = time_s;
    mavlink::take(message, time_s, flight.readings);
    if (flight.aligned) {
        autopilot::estimate(model, flight.autopilot, flight.readings);
    } else if (const auto initial = first_estimate(model.parameters, flight)) {
        flight.autopilot = autopilot::start(model, *initial);
        flight.aligned = true;
    }
    const FlightMode before = flight.manners.mode;
    mind(parameters, flight.manners, situation(flight));
    if (before != flight.manners.mode) {
        hold_here(flight);
    }
    if (!flight.aligned) {
        return true;
    }
    const Setpoint setpoint = wanted(flight);
    flight.command = autopilot::control(model, flight.autopilot, setpoint, time_s);
    const bool flies = setpoint.armed && !std::holds_alternative<IdleSetpoint>(setpoint.motion);
    flight.thrust = flies ? flight.autopilot.attitude_target.thrust : 0.0;
    return true;
}

void hear(StandInFlight& flight, const mavlink::HilGps& message, bool aids) {
    if (const auto gps = mavlink::gps_reading(message, {})) {
        flight.readings.gps = {.time_s = flight.time_s, .value = *gps};
        if (aids && !flight.origin) {
            flight.origin.emplace(at(mavlink::GeographicOrigin{}, flight.time_s));
        }
    }
}

void hear(StandInFlight& flight, const mavlink::SetGpsGlobalOrigin& message, double unsettles_s,
          double throws_m) {
    if (flight.aligned && !flight.origin) {
        flight.unsettled_until_s = flight.time_s + unsettles_s;
        flight.thrown_north_m = throws_m;
    }
    flight.origin = mavlink::GpsGlobalOrigin{.latitude = message.latitude,
                                             .longitude = message.longitude,
                                             .altitude = message.altitude,
                                             .time_usec = mavlink::boot_us(flight.time_s)};
}

void hear(StandInFlight& flight, const mavlink::Odometry& message) {
    const auto pose = mavlink::pose_reading(message);
    if (!pose) {
        return;
    }
    const double stamp_s = 1e-6 * static_cast<double>(message.time_usec);
    const double age_s = flight.time_s - stamp_s;
    const bool ours = age_s <= kOldestPose_s && age_s >= -kYoungestPose_s;
    flight.readings.motion_capture = {.time_s = ours ? stamp_s : flight.time_s, .value = *pose};
}

void hear(StandInFlight& flight, const mavlink::SetPositionTargetLocalNed& message) {
    auto position = mavlink::position_set_point(message);
    if (position) {
        position->p_W_m.x() -= flight.thrown_north_m;
    }
    hear_motion(flight, position);
    hear_motion(flight, mavlink::velocity_set_point(message));
}

void hear(StandInFlight& flight, const mavlink::SetAttitudeTarget& message) {
    hear_motion(flight, mavlink::attitude_set_point(message));
}

std::optional<CommandResult> obey(const StandInParameters& parameters, StandInFlight& flight,
                                  const mavlink::CommandLong& message) {
    const Situation now = situation(flight);
    if (message.command == mavlink::MavCmd::component_arm_disarm) {
        const bool by_force = message.param2 == mavlink::kForce;
        return message.param1 == 1.0F ? arm(parameters, flight.manners, now, by_force)
                                      : disarm(flight.manners, now, by_force);
    }
    if (message.command != mavlink::MavCmd::do_set_mode) {
        return std::nullopt;
    }
    const bool hold =
        message.param2 == mavlink::kMainModeAuto && message.param3 == mavlink::kSubModeLoiter;
    const bool offboard = message.param2 == mavlink::kMainModeOffboard;
    if (message.param1 != 1.0F || !(hold || offboard)) {
        return CommandResult::temporarily_rejected;
    }
    const FlightMode before = flight.manners.mode;
    const CommandResult result =
        set_mode(parameters, flight.manners, now, hold ? FlightMode::hold : FlightMode::offboard);
    if (before != flight.manners.mode) {
        hold_here(flight);
    }
    return result;
}

}  // namespace limpet::px4
