// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/draw/stage.hpp"
#include "limpet/record/recording.hpp"

namespace limpet::report {

/// An instant worth a picture.
struct Moment {
    double time_s = 0.0;
    std::string name;  ///< "impact"
};

/// The instants that tell a story, in time, at most eight, each a pictured one's length apart.
/// Fig. 9 of the paper: from the pre-position to the rest on the wall, of the last attempt; or to
/// the retreat. Empty without an approach.
[[nodiscard]] std::vector<Moment> perching_moments(const record::Recording& recording);
/// Fig. 10: from the rest on the wall back to the pre-position, of the last take-off.
[[nodiscard]] std::vector<Moment> take_off_moments(const record::Recording& recording);
/// Eight instants evenly over a flight that tells no such story.
[[nodiscard]] std::vector<Moment> flight_moments(const record::Recording& recording);

/// Where everything was, by the nearest samples of /truth/pose and /truth/vehicle.
/// @throws InputError when /truth/pose was not recorded
[[nodiscard]] draw::Pose pose_at(const record::Recording& recording, double time_s);

/// Under a picture: time, pitch, and the pressure in the cup if there is one.
[[nodiscard]] std::string caption_at(const record::Recording& recording, double time_s);

}  // namespace limpet::report
