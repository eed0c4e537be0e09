// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "limpet/core/signals/consistency.hpp"
#include "limpet/simulation/model.hpp"

namespace limpet::simulation {

/// Truth less belief of the built-in filter, in its order: attitude as a rotation vector in B.
/// @param truth  of the base when the filter's last IMU sample was taken
[[nodiscard]] autopilot::ErrorVector filter_error(const FlightState& state,
                                                  const Kinematics& truth);

/// How honest the built-in filter is, at an instant to which it has just brought its covariance.
/// @param truth   of the base at `time_s`
/// @return nullopt when the filter's state is of another instant
[[nodiscard]] std::optional<Consistency> consistency_of(const FlightModel& model,
                                                        const FlightState& state,
                                                        const Kinematics& truth, double time_s);

/// Of a flight as it goes on, some 25 times a second: the filter's state after a tick is that of
/// the instant at which the tick began.
class ConsistencyWatch {
public:
    /// After every tick.
    [[nodiscard]] std::optional<Consistency> next(const FlightModel& model,
                                                  const FlightState& state);

private:
    Kinematics before_;
    double before_s_ = -1.0;
    double last_s_ = -1.0;
};

}  // namespace limpet::simulation
