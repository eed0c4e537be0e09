// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// Logs whose unit is not what their header says.
namespace limpet::identification {

/// What a log of a cup's pressure may be in, where it is hardly absolute pressure in Pa: gauge
/// pressure of either sign, hPa, kPa, bar or psi. Recognised by where most samples lie: single wild
/// ones do not count.
/// @param pressure_Pa    as the log has it, in any order
/// @param atmosphere_Pa  around the cup; a log that reaches it is not suspected
/// @return one sentence, with the remedy; empty: nothing is suspected
[[nodiscard]] std::string suspected_pressure_unit(const std::vector<double>& pressure_Pa,
                                                  double atmosphere_Pa);

/// The same of times: milliseconds, microseconds or nanoseconds that are called seconds.
/// @param t_s  rising
[[nodiscard]] std::string suspected_time_unit(const std::vector<double>& t_s);

/// @param t_s  rising
/// @return the median of the steps from sample to sample [s]; 0 of fewer than two
[[nodiscard]] double median_step_s(const std::vector<double>& t_s);

}  // namespace limpet::identification
