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

/// @return nullopt when it did not rest for a second, or when loads or attitude were not recorded
[[nodiscard]] std::optional<Rest> rest_of(const record::Recording& recording);

}  // namespace limpet::compare
