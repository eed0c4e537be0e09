// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/compare/align.hpp"
#include "limpet/compare/channels.hpp"
#include "limpet/compare/contact.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/record/story.hpp"

/// How a flight differs from a reference: events, figures of merit, every channel.
namespace limpet::compare {

/// Lowest and highest of a channel in one flight, over the whole of it.
struct Extremes {
    double lowest = 0.0;
    double highest = 0.0;
};

/// One channel of both, at the reference's samples within the pieces.
struct ChannelDifference {
    std::string name;
    std::string unit;
    ChannelKind kind = ChannelKind::number;
    double largest = 0.0;     ///< of |other - reference|; of states 1 where they are not alike
    double at_s = 0.0;        ///< when, in the reference's time
    std::string phase = {};   ///< the reference's state of guidance then, or the event before
    double rms = 0.0;         ///< of states the root of the share of samples not alike
    std::size_t samples = 0;  ///< compared; 0: the flights share none
    Extremes reference;
    Extremes other;
};

/// A number that says something of a whole flight.
struct FlightFigure {
    std::string name;                  ///< "impact_force_N"
    double reference = 0.0;            ///< NaN: not there
    double other = 0.0;                ///< likewise
    bool against_zero = false;         ///< what it should be is 0: the other's own size counts
    [[nodiscard]] double off() const;  ///< how far the other is off [of its unit], NaN: not there
};

/// What a flight is called and came to.
struct FlightIdentity {
    std::string label;
    std::string path;
    record::Summary summary;
    double from_s = 0.0;
    double to_s = 0.0;
};

struct FlightComparison {
    FlightIdentity reference;
    FlightIdentity other;
    double base_shift_s = 0.0;  ///< event times are told less this
    std::vector<EventPair> events = {};
    std::vector<Piece> pieces = {};
    std::vector<FlightFigure> figures = {};
    std::vector<ContactDifference> contacts = {};
    std::vector<ChannelDifference> channels = {};
    std::vector<std::string> only_in_reference = {};  ///< channels
    std::vector<std::string> only_in_other = {};

    [[nodiscard]] double event_difference_s(const EventPair& event) const;
};

/// A recording with its channels; all that are compared share their StateNumbers.
struct FlightTrace {
    const record::Recording* recording = nullptr;  ///< outlives this
    std::string label;
    std::vector<FlightChannel> channels;
};

/// How far the other flight is off, at the reference's samples within the pieces; NaN where one of
/// them has no value.
struct Differences {
    std::vector<double> time_s;
    std::vector<double> values;
};
[[nodiscard]] Differences differences(const FlightChannel& reference, const FlightChannel& other,
                                      const std::vector<Piece>& pieces);

/// The same, less what a shift of the other by at most so much to either side explains: 0 where it
/// passes the reference's value on the way, else how far it stays off.
[[nodiscard]] Differences beyond_shift(const FlightChannel& reference, const FlightChannel& other,
                                       const std::vector<Piece>& pieces, double shift_s);

/// @throws InputError when there is no common event to align at, or no common channel
[[nodiscard]] FlightComparison compare(const FlightTrace& reference, const FlightTrace& other,
                                       const Alignment& alignment);

}  // namespace limpet::compare
