// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/record/recording.hpp"
#include "limpet/record/story.hpp"

/// Two flights laid over each other in time.
namespace limpet::compare {

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
/// follows. Where flights tell events in another order, as few as
/// possible are passed over.
/// @param reference  when it was recorded
/// @param other      likewise
/// @throws InputError when there is no common event to align at
[[nodiscard]] std::vector<Piece> align(const std::vector<EventPair>& events,
                                       const record::Window& reference, const record::Window& other,
                                       const Alignment& alignment);

/// The shift that event times are told against: of the starts, or of the event aligned at.
[[nodiscard]] double base_shift_s(const std::vector<EventPair>& events,
                                  const record::Window& reference, const record::Window& other,
                                  const Alignment& alignment);

}  // namespace limpet::compare
