// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limpet/compare/channels.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/record/story.hpp"

/// How a flight differs from a reference: events, figures of merit, every channel.
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

/// The n-th time that something happened, in a reference and in another flight.
struct EventPair {
    std::string name;
    int occurrence = 1;
    double reference_s = 0.0;  ///< NaN: did not happen there
    double other_s = 0.0;      ///< likewise

    [[nodiscard]] bool in_both() const;
};

/// Events of both, in the order of the reference; what only the other has stands where it happened.
/// Parameters that were set in flight are none.
[[nodiscard]] std::vector<EventPair> pair_events(const record::Recording& reference,
                                                 const record::Recording& other);

struct Alignment {
    enum class By {
        events,  ///< each stretch between two common events lies at both of them
        start,   ///< one shift: the first samples
        event,   ///< one shift: the first occurrence of `event`
    };
    By by = By::events;
    std::string event = {};
};

/// A stretch of the reference that the other flight has as well.
struct Piece {
    std::string from;                   ///< the last common event before it; "start"
    record::Window window;              ///< in the reference's time
    double shift_s = 0.0;               ///< the other's time less the reference's
    double reference_left_out_s = 0.0;  ///< what the reference has longer
    double other_left_out_s = 0.0;      ///< what the other has longer
};

/// Stretches in time, without overlap. What lasts longer in one flight between two common events is
/// left out midway, so that both events have what leads up to them, an impact's rise say, and what
/// follows. Where events have another order, as few as
/// possible are passed over.
/// @param reference  when it was recorded
/// @param other      likewise
/// @throws InputError when there is no common event to align at
[[nodiscard]] std::vector<Piece> align(const std::vector<EventPair>& events,
                                       const record::Window& reference, const record::Window& other,
                                       const Alignment& alignment);

/// The shift that event times are reported against: of the starts, or of the event aligned at.
[[nodiscard]] double base_shift_s(const std::vector<EventPair>& events,
                                  const record::Window& reference, const record::Window& other,
                                  const Alignment& alignment);

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

/// A number of a whole flight.
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
    double base_shift_s = 0.0;  ///< event times are reported less this
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
