// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/draw/chart.hpp"
#include "limpet/record/story.hpp"

/// The curves of the paper's Figs. 11 to 14, taken from a recording, and beside what was achieved
/// what guidance asked for.
namespace limpet::report {

/// @return pressure, pitch, its estimate's error, force, slider, thrust, distance, speed; those
/// that were recorded, over the window, and thrust where anything ever pulled. The estimate itself
/// stands where there is no truth. What guidance did not ask for has a gap in the series "asked":
/// pitch stands with an attitude setpoint, speed with a velocity setpoint, distance with a position
/// setpoint, as the distance measured less how far the estimated position is from the one that was
/// asked for.
[[nodiscard]] std::vector<draw::ChartPanel> panels(const record::Recording& recording,
                                                   const record::Window& window);

/// Topics of the panels that the recording lacks, a sentence each; what only a vehicle with a cup
/// has is not missed on one without, nor setpoints where nobody flew.
[[nodiscard]] std::vector<std::string> missing_topics(const record::Recording& recording);

}  // namespace limpet::report
