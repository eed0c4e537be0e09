// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/core/work.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/record/story.hpp"

namespace limpet::report {

/// A part of a flight against time as in the paper's Figs. 11 to 15: cup pressure, pitch, force
/// through the slider, thrust, distance to the wall and speed (panels.hpp) over a common time axis,
/// with the flight's events and the states of guidance.
[[nodiscard]] draw::Chart flight_chart(const record::Recording& recording,
                                       const record::Chapter& chapter);

/// Draws those charts, PNG and SVG of each: `overview`, and when they happened `perching`,
/// `take_off`, `failed_attempt` (story.hpp says what each shows). A panel without data is left out.
/// A damaged recording is drawn as far as it goes and its figures say so.
/// @param folder  made when it is not there
/// @return the files, and what could not be shown
/// @throws InputError for a recording without anything to draw, an unwritable folder, or when
///         gnuplot is not installed; Interrupted, with nothing in the folder
[[nodiscard]] draw::Pictures plot(const record::Recording& recording,
                                  const std::filesystem::path& folder, const Work& work = {});

/// Where another flight is recorded: what plot() has drawn of the last one goes.
void remove_figures(const std::filesystem::path& folder);

}  // namespace limpet::report
