// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "limpet/record/recording.hpp"

namespace limpet::compare {

/// How a vehicle hangs on the wall with its motors off: means over the second half of the rest,
/// when it has come to stand still.
struct Rest {
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
    double slider_mm = 0.0;
    double cup_pull_N = 0.0;
    double cup_shear_N = 0.0;
    double hanging_load_N = 0.0;  ///< upwards, by the wall on cup and legs
    double wall_push_N = 0.0;     ///< out of the wall, north less: legs push what the cup pulls
    double weight_N = 0.0;        ///< of the recording's model; NaN without one
};

struct RestNumber {
    const char* name;
    double Rest::*field;
};
inline constexpr RestNumber kRestNumbers[] = {
    {"rest_pitch_deg", &Rest::pitch_deg},           {"rest_roll_deg", &Rest::roll_deg},
    {"rest_slider_mm", &Rest::slider_mm},           {"rest_cup_pull_N", &Rest::cup_pull_N},
    {"rest_cup_shear_N", &Rest::cup_shear_N},       {"rest_wall_push_N", &Rest::wall_push_N},
    {"rest_hanging_load_N", &Rest::hanging_load_N}, {"weight_N", &Rest::weight_N},
};

/// @return nullopt when it did not rest for a second, or when loads or attitude were not recorded
[[nodiscard]] std::optional<Rest> rest_of(const record::Recording& recording);

}  // namespace limpet::compare
