// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>

#include "limpet/autopilot/builtin.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/mavlink/messages.hpp"
#include "limpet/mavlink/translate.hpp"
#include "limpet/px4/stand_in_manners.hpp"

/// The stand-in flight controller without its wires: messages in, motors out. The built-in
/// autopilot flies; what may be flown and when is a matter of manners. Its clock is HIL_SENSOR's.
namespace limpet::px4 {

struct StandInFlight {
    double time_s = 0.0;  ///< of the last HIL_SENSOR; 0: none yet
    Readings readings;
    bool aligned = false;  ///< the estimator has been started
    autopilot::AutopilotState autopilot;
    Manners manners;
    Setpoint commanded;  ///< the last set-point
    double heard_s = -std::numeric_limits<double>::infinity();
    PositionSetpoint hold;                           ///< where to be in the mode hold
    std::optional<mavlink::GpsGlobalOrigin> origin;  ///< of W
    double unsettled_until_s = 0.0;  ///< its position is no good for arming until then
    double thrown_north_m = 0.0;     ///< its local position is off by so much
    double thrust = 0.0;             ///< collective requested in the last step
    RotorCommand command;

    [[nodiscard]] bool valid() const { return aligned && autopilot.estimate.valid; }
    /// As it tells it.
    [[nodiscard]] Estimate local_estimate() const {
        Estimate estimate = autopilot.estimate;
        estimate.p_WB_m.x() += thrown_north_m;
        return estimate;
    }
};

/// A step: clock and IMU go on, the estimator runs, what is due happens, the vehicle is flown.
/// @return whether it was one: the time rises
bool step(const autopilot::AutopilotModel& model, const StandInParameters& parameters,
          StandInFlight& flight, const mavlink::HilSensor& message);

/// @param aids  it is a position to go by, and an origin, too
void hear(StandInFlight& flight, const mavlink::HilGps& message, bool aids);
/// @param unsettles_s  how long its position is no good for arming when it has been aligned before
///                     its first origin came
/// @param throws_m     how far its local position is off from then on, likewise
void hear(StandInFlight& flight, const mavlink::SetGpsGlobalOrigin& message, double unsettles_s,
          double throws_m);
/// A pose for the estimator; others than EKF2 uses are passed over. A stamp that is not of this
/// clock, or older than half a second, counts as now: so does PX4 until its clock is in step.
void hear(StandInFlight& flight, const mavlink::Odometry& message);
void hear(StandInFlight& flight, const mavlink::SetPositionTargetLocalNed& message);
void hear(StandInFlight& flight, const mavlink::SetAttitudeTarget& message);
/// Commands of flight: mode and arming.
/// @return nothing when it is another
[[nodiscard]] std::optional<CommandResult> obey(const StandInParameters& parameters,
                                                StandInFlight& flight,
                                                const mavlink::CommandLong& message);

}  // namespace limpet::px4
