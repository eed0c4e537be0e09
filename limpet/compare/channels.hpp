// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "limpet/record/recording.hpp"

/// What two recordings are compared by: one number against time each, in the units that people
/// read.
namespace limpet::compare {

enum class ChannelKind {
    number,
    angle,  ///< [deg], wrapped: 179 and -179 are 2 apart
    state,  ///< holds until the next one; two states are alike (0) or not (1)
};

/// One number of a recording against time. Times ascend; NaN: no reading.
struct FlightChannel {
    std::string name;   ///< "cup_pressure_hPa": the unit is in it
    std::string group;  ///< "cup": the figure that shows it
    std::string title;  ///< "pressure in the cup"
    std::string unit;   ///< "hPa"
    ChannelKind kind = ChannelKind::number;
    std::vector<double> time_s;
    std::vector<double> values;
    std::map<double, std::string> names = {};  ///< of a state's values
    double gap_s = 0.0;                        ///< samples further apart have a gap between them
};

/// Numbers for states that were recorded as words, the same in all recordings compared.
using StateNumbers = std::map<std::string, double, std::less<>>;

/// Every channel that the recording has: Limpet's by their names, and all numbers of other topics
/// as TOPIC/COLUMN with the unit that ROS gives them. World north-east-down, body
/// forward-right-down.
[[nodiscard]] std::vector<FlightChannel> flight_channels(const record::Recording& recording,
                                                         StateNumbers& numbers);

/// Columns of a table by name; all null when one is missing, or the table.
template <std::size_t N>
[[nodiscard]] std::array<const record::Column*, N> columns_of(
    const record::Table* table, const std::array<const char*, N>& names) {
    std::array<const record::Column*, N> found{};
    for (std::size_t i = 0; i < N; ++i) {
        found[i] = table == nullptr ? nullptr : table->find(names[i]);
        if (found[i] == nullptr) {
            return {};
        }
    }
    return found;
}

/// The value at an instant: linear between two samples, angles the short way; of a state the last
/// one before.
/// @return NaN before the first and after the last sample and within a gap
[[nodiscard]] double value_at(const FlightChannel& channel, double time_s);

/// Other less reference; angles wrapped to [-180, 180); of states 0 when alike, else 1.
[[nodiscard]] double difference_of(ChannelKind kind, double reference, double other);

}  // namespace limpet::compare
