// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "limpet/compare/compare.hpp"
#include "limpet/core/work.hpp"
#include "limpet/draw/pictures.hpp"

namespace limpet::compare {

/// Draws flights over each other, a figure a group of channels (`compare_cup`, `compare_attitude`,
/// ...): on the left the curves against the reference's time, every other flight shifted piece by
/// piece, with the events of the reference; on the right how far they are off, less what a shift by
/// a sample or two explains. PNG and SVG.
/// @param comparisons  of the same reference, in the order of `others`
/// @param folder       made when it is not there
/// @throws InputError for an unwritable folder, or when gnuplot is not installed; Interrupted, with
///         nothing in the folder
[[nodiscard]] draw::Pictures draw_comparison(const FlightTrace& reference,
                                             const std::vector<FlightTrace>& others,
                                             const std::vector<FlightComparison>& comparisons,
                                             const std::filesystem::path& folder,
                                             const Work& work = {});

}  // namespace limpet::compare
