// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/draw/pictures.hpp"
#include "limpet/record/recording.hpp"

namespace limpet::report {

/// Draws the manoeuvre as a row of pictures, as in the paper's Figs. 9 and 10: `perching_film.png`,
/// and `take_off_film.png` when the vehicle left the wall; a flight without an approach gives
/// `flight_film.png`. Rendered off-screen from the attached model.xml and the recorded truth.
/// @param folder  made when it is not there
/// @throws InputError when the recording has no model or no poses, for an unwritable folder, or
/// when
///         gnuplot or OpenGL's software renderer is not installed
[[nodiscard]] draw::Pictures film(const record::Recording& recording,
                                  const std::filesystem::path& folder);

}  // namespace limpet::report
