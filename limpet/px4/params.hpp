// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/autopilot/parameters.hpp"

namespace limpet::px4 {

/// Loads a parameter file as QGroundControl and `param export` write it: lines of
/// `vehicle component name value type`, separated by tabs, `#` begins a comment. All or nothing:
/// on an error `parameters` stays as it was.
/// @return names in the file that this autopilot does not model, in the file's order; all names of
///         components other than the autopilot (component 1) are among them
/// @throws InputError naming file:line, name, value and limits: unreadable file, wrong number of
///         columns, no number, out of range
[[nodiscard]] std::vector<std::string> load_px4_params(const std::string& path,
                                                       autopilot::AutopilotParameters& parameters);

}  // namespace limpet::px4
