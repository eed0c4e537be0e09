// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limpet/core/rotor_list.hpp"
#include "limpet/identification/pressure_curve.hpp"

namespace limpet::identification {

/// What a log says of a flight, in our axes. What the log does not have is empty.
struct FlightData {
    std::string damage = {};  ///< of the log, of which the rest was read; empty: none
    std::vector<std::string> remarks =
        {};  ///< what was done to it, or could not be read; no damage
    std::vector<double> imu_s = {};
    std::vector<Vector3> rate_B_rad_s = {};  ///< a gyro's mean since its last sample
    std::vector<Vector3> specific_force_B_m_s2 = {};
    std::vector<double> command_s = {};
    std::vector<RotorList<double>> command = {};  ///< 0..1; of a disarmed vehicle 0
    std::vector<double> velocity_s = {};
    std::vector<Vector3> velocity_B_m_s = {};
    std::vector<double> force_s = {};
    std::vector<double> force_N = {};  ///< through the slider, < 0 pressed
    PressureTrace pressure = {};
    /// Of a flight of ours: from each tick of a second how far the bodies went in a step
    /// (simulation/stride.hpp), which says when a command acts. Empty: nothing went in steps.
    std::vector<int> strides = {};
    std::string scenario_yaml = {};  ///< that a flight of ours was flown by
    double origin_s = 0.0;           ///< of all times, in the log's clock (core/time.hpp)
    std::string kind = {};           ///< "recording", "PX4 log", "CSV"
};

struct FlightSpan {
    std::optional<double> from_s = {};  ///< what is before is left out
    std::optional<double> to_s = {};
};

/// Reads a log by how it begins: an MCAP recording of ours (or of others with our topics), PX4's
/// ULog, or CSV: a header with `t_s` and any of gyro_x_rad_s (y, z), accel_x_m_s2, command_0 (1,
/// ...), velocity_x_m_s (all in B, forward-right-down), force_N, pressure_Pa; an empty cell is no
/// sample. Motors of PX4 up to v1.13 are taken from actuator_outputs: PWM, by the log's own limits
/// made 0..1, and thrust by its THR_MDL_FAC. Samples of a recording or a PX4 log that stand up to a
/// second too late are put in their places (FlightData::remarks).
/// Times of a clock (Unix, GPS) count from the first sample.
/// @param span  in the log's clock or from its first sample
/// @throws InputError one line: file:line in CSV, what is missing or cannot be read
[[nodiscard]] FlightData read_flight(const std::filesystem::path& path,
                                     const FlightSpan& span = {});

/// A flight's log as CSV, as read_flight() says.
/// @throws InputError one line: file:line, what is missing or cannot be read
[[nodiscard]] FlightData read_flight_csv(const std::filesystem::path& path);

}  // namespace limpet::identification
