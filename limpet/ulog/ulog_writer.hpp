// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/record/recording.hpp"

namespace limpet::ulog {

/// A recording as PX4's log, for the tools that read those (Flight Review, PlotJuggler): PX4's
/// topics, fields, units and frames as far as the recording has them; what is true as
/// *_groundtruth; cup and guidance as topics of ours; events as logged texts. Times in microseconds
/// from 0, all in their order. Format: https://docs.px4.io/main/en/dev_log/ulog_file_format.html
/// @throws InputError when the file cannot be written, or nothing in the recording has a place
void write_ulog(const record::Recording& recording, const std::filesystem::path& file);

}  // namespace limpet::ulog
