// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <filesystem>
#include <string>
#include <vector>

#include "limpet/autopilot/external.hpp"

// What an autopilot makes of the vehicle's turning: from the gyro's pitch rate to the pitch torque
// that it commands, identified in flight, in hover and level on the cup. The same flights for the
// built-in autopilot and for a PX4 behind its wire, so that the one can be held against the other.
namespace limpet {

enum class Place {
    hover,
    cup,  ///< level, as it waits for the release
};

/// At one frequency: command of pitch torque (normalised, as the mixer has it) over pitch rate.
struct ResponsePoint {
    Place place = Place::hover;
    double frequency_Hz = 0.0;
    std::complex<double> torque_s_rad;
};

struct Swing {
    double growth_1_s = 0.0;
    double frequency_Hz = 0.0;
};

/// Flies with many sines in pitch beside the rotor commands, over whole periods of all of them.
/// @param external  null: the built-in one
/// @throws std::runtime_error when the flight ends before that
[[nodiscard]] std::vector<ResponsePoint> loop_response(Place place,
                                                       autopilot::ExternalAutopilot* external);

/// The swing on the cup after a push of the rotors, by the true pitch.
/// @param lag_s    of the motors
/// @param pivot_m  of the cup's joint ahead of the centre of mass
[[nodiscard]] Swing kicked_swing(double lag_s, double pivot_m,
                                 autopilot::ExternalAutopilot* external);

/// The scenario of these flights, for whom PX4 is started for.
[[nodiscard]] std::string loop_scenario(Place place);
[[nodiscard]] std::vector<std::string> loop_overrides(Place place);

/// CSV: place,frequency_Hz,gain_s_rad,phase_deg; lines that begin with # say where it comes from.
[[nodiscard]] std::string response_text(const std::vector<ResponsePoint>& points);

}  // namespace limpet
