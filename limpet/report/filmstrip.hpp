// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/core/work.hpp"
#include "limpet/draw/pictures.hpp"
#include "limpet/draw/stage.hpp"
#include "limpet/record/recording.hpp"

namespace limpet::report {

/// Draws the manoeuvre as a row of pictures, as in the paper's Figs. 9 and 10: `perching_film.png`,
/// and `take_off_film.png` when the vehicle left the wall; a flight without an approach gives
/// `flight_film.png`. Rendered off-screen from the attached model.xml and the recorded truth.
/// All frames of a strip are taken by one camera, unless the way is too long for one.
/// @param video   "mp4" or "webm": the same, from the same cameras, as a film next to each strip
/// @param folder  made when it is not there
/// @throws InputError when the recording has no model or no poses, for an unwritable folder, or
/// when
///         gnuplot, ffmpeg or OpenGL's software renderer is not installed; Interrupted, with
///         nothing in the folder
[[nodiscard]] draw::Pictures film(const record::Recording& recording,
                                  const std::filesystem::path& folder, const Work& work = {},
                                  const std::string& video = {});

/// An instant worth a picture.
struct Moment {
    double time_s = 0.0;
    std::string name;  ///< "impact"
};

/// The instants of a manoeuvre, in time, at most eight, each a pictured one's length apart.
/// Fig. 9 of the paper: from the pre-position to the rest on the wall, of the last attempt; or to
/// the retreat. Empty without an approach.
[[nodiscard]] std::vector<Moment> perching_moments(const record::Recording& recording);
/// Fig. 10: from the rest on the wall back to the pre-position, of the last take-off.
[[nodiscard]] std::vector<Moment> take_off_moments(const record::Recording& recording);
/// Eight instants evenly over a flight without such a manoeuvre.
[[nodiscard]] std::vector<Moment> flight_moments(const record::Recording& recording);

/// Where everything was, by the nearest samples of /truth/pose and /truth/vehicle.
/// @throws InputError when /truth/pose was not recorded
[[nodiscard]] draw::Pose pose_at(const record::Recording& recording, double time_s);

/// Under a picture: time, pitch, and the pressure in the cup if there is one.
[[nodiscard]] std::string caption_at(const record::Recording& recording, double time_s);

}  // namespace limpet::report
