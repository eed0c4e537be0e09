// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "limpet/autopilot/parameters.hpp"
#include "limpet/core/parameters.hpp"

namespace limpet::px4 {

/// What of PX4's commander the stand-in flight controller honours; PX4's names, units, defaults.
struct StandInParameters {
    int FD_FAIL_P = 60;
    int FD_FAIL_R = 60;
    double COM_OF_LOSS_T = 1.0;
    double COM_DISARM_PRFLT = 10.0;
    double COM_DISARM_LAND = 2.0;
};

[[nodiscard]] const ParameterTable<StandInParameters>& stand_in_table();

/// All that can be read and set over the wire: the commander's, and those of the built-in autopilot
/// that PX4 has too.
struct WireParameters {
    StandInParameters& commander;
    autopilot::AutopilotParameters& autopilot;
};

struct WireParameter {
    std::string_view name;
    double value = 0.0;
    bool is_integer = false;  ///< INT32 in PX4
    std::uint16_t index = 0;
};

[[nodiscard]] std::uint16_t wire_parameter_count();
/// @return nothing for an index that is none
[[nodiscard]] std::optional<WireParameter> wire_parameter(const WireParameters& all,
                                                          std::uint16_t index);
/// @return nothing for a name that is none
[[nodiscard]] std::optional<WireParameter> wire_parameter(const WireParameters& all,
                                                          std::string_view name);
/// @return whether it took the value: a known name, within its range, whole if it is an integer
bool set_wire_parameter(const WireParameters& all, std::string_view name, double value);

}  // namespace limpet::px4
