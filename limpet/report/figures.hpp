// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/record/recording.hpp"
#include "limpet/report/pictures.hpp"

namespace limpet {

/// Draws a flight against time as in the paper's Figs. 11 to 15: cup pressure, pitch, force through
/// the slider, thrust and distance to the wall over a common time axis, with the flight's events
/// and the states of guidance. PNG and SVG of each: `overview`, and when they happened `perching`,
/// `take_off`, `failed_attempt` (story.hpp says what each shows). A panel without data is left out.
/// A damaged recording is drawn as far as it goes and its figures say so.
/// @param folder  made when it is not there
/// @return the files, and what could not be shown
/// @throws InputError for a recording without anything to draw, an unwritable folder, or when
///         gnuplot is not installed
[[nodiscard]] Pictures plot(const Recording& recording, const std::filesystem::path& folder);

}  // namespace limpet
