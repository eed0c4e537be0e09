// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "limpet/record/recording.hpp"

namespace limpet::ulog {

/// What a log's parameters stand under in Recording::metadata: name to number, as it was last.
inline constexpr std::string_view kPx4Parameters = "px4_parameters";

/// Reads PX4's log as tables, one a topic, `vehicle_attitude`, of further instances
/// `distance_sensor.1`: a column a field, of arrays and nested messages one an element
/// ("xyz[0]", "esc[1].esc_rpm"), times in seconds since the autopilot's boot.
/// Parameters are metadata; logged texts and dropouts are passed over. A topic that is subscribed
/// again goes on in its table; what a message is too short for is NaN. A log that ends in the
/// middle of a message is read up to there; behind bytes that are no message it goes on at the next
/// synchronisation message; both are named (Recording::damage). What was appended to a log that was
/// cut short is read as well.
/// @throws InputError one line: no such file, no log of PX4's, a definition that makes no sense,
/// one that takes more memory or time than a log of its size may (core/allowance.hpp) Format:
/// https://docs.px4.io/main/en/dev_log/ulog_file_format.html
[[nodiscard]] record::Recording read_ulog(const std::filesystem::path& path);

/// A recording as PX4's log, for the tools that read those (Flight Review, PlotJuggler): PX4's
/// topics, fields, units and frames as far as the recording has them; what is true as
/// *_groundtruth; cup and guidance as topics of ours; events as logged texts. Times in microseconds
/// from 0, all in their order. Format: https://docs.px4.io/main/en/dev_log/ulog_file_format.html
/// @throws InputError when the file cannot be written, or nothing in the recording has a place
void write_ulog(const record::Recording& recording, const std::filesystem::path& file);

}  // namespace limpet::ulog
