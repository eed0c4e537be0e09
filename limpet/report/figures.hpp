// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/core/work.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/record/story.hpp"

namespace limpet::report {

/// @return pressure, pitch, its estimate's error, force, slider, thrust, distance, speed; those
/// that were recorded, over the window, and thrust where anything ever pulled. The estimate itself
/// stands where there is no truth. What has no set-point has a gap in the series "set-point":
/// pitch stands with an attitude setpoint, speed with a velocity setpoint, distance with a position
/// setpoint, as the distance measured less how far the estimated position is from that of the
/// set-point.
[[nodiscard]] std::vector<draw::ChartPanel> panels(const record::Recording& recording,
                                                   const record::Window& window);

/// Topics of the panels that the recording lacks, a sentence each; what only a vehicle with a cup
/// has is not missed on one without, nor setpoints where guidance did not fly.
[[nodiscard]] std::vector<std::string> missing_topics(const record::Recording& recording);

/// A part of a flight against time as in the paper's Figs. 11 to 15: cup pressure, pitch, force
/// through the slider, thrust, distance to the wall and speed over a common time axis,
/// with the flight's events and the states of guidance.
[[nodiscard]] draw::Chart flight_chart(const record::Recording& recording,
                                       const record::Chapter& chapter);

/// Draws those charts, PNG and SVG of each: `overview`, and when they happened `perching`,
/// `take_off`, `failed_attempt` (story.hpp describes each). A panel without data is left out.
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
