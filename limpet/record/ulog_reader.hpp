// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/record/recording.hpp"

namespace limpet::record {

/// Reads PX4's log as tables, one a topic, `vehicle_attitude`, of further instances
/// `distance_sensor.1`: a column a field, of arrays and nested messages one an element
/// ("xyz[0]", "esc[1].esc_rpm"), times in seconds since the autopilot's boot.
/// Logged texts, parameters and dropouts are passed over; a log that ends in the middle of a
/// message is read up to there (Recording::damage).
/// @throws InputError one line: no such file, no log of PX4's, a definition that makes no sense
/// Format: https://docs.px4.io/main/en/dev_log/ulog_file_format.html
[[nodiscard]] Recording read_ulog(const std::filesystem::path& path);

}  // namespace limpet::record
