// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "limpet/core/work.hpp"
#include "limpet/draw/pictures.hpp"
#include "limpet/record/recording.hpp"

namespace limpet::report {

/// Draws the manoeuvre as a row of pictures, as in the paper's Figs. 9 and 10: `perching_film.png`,
/// and `take_off_film.png` when the vehicle left the wall; a flight without an approach gives
/// `flight_film.png`. Rendered off-screen from the attached model.xml and the recorded truth.
/// All frames of a strip are taken by one camera, unless the way is too long for one.
/// @param video   "mp4" or "webm": the same, from the same cameras, as a film beside each strip
/// @param folder  made when it is not there
/// @throws InputError when the recording has no model or no poses, for an unwritable folder, or
/// when
///         gnuplot, ffmpeg or OpenGL's software renderer is not installed; Interrupted, with
///         nothing in the folder
[[nodiscard]] draw::Pictures film(const record::Recording& recording,
                                  const std::filesystem::path& folder, const Work& work = {},
                                  const std::string& video = {});

}  // namespace limpet::report
