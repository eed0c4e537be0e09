// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/compare/channels.hpp"
#include "limpet/record/story.hpp"

/// Pressure on the same contact: from the instant of sealing on, whenever that was.
namespace limpet::compare {

/// Pressures of the n-th stage of two flights, laid over each other.
struct ContactDifference {
    bool sealing = true;
    double reference_from_s = 0.0;
    double other_from_s = 0.0;
    double span_s = 0.0;       ///< that both have
    double shift_s = 0.0;      ///< other's time less the reference's where they agree best
    double largest_hPa = 0.0;  ///< what is left then
    double rms_hPa = 0.0;
};

/// Recordings have samples, contacts begin between them: the shift is searched within two samples
/// of what the phases say. Where the cup's loads were recorded, the pressure is that which acts,
/// (pull + pull to spare) / area, without the pump's ripple, which runs by the clock of the flight
/// and not from the contact on; else it is the pressure recorded. A stage too short or too sparse
/// to hold one sample in common is left out.
[[nodiscard]] std::vector<ContactDifference> compare_contacts(
    const record::Recording& reference, const std::vector<FlightChannel>& reference_channels,
    const record::Recording& other, const std::vector<FlightChannel>& other_channels);

}  // namespace limpet::compare
