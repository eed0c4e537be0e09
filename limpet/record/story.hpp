// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/record/recording.hpp"

/// What happened in a recording, and when: all that figures and films need to know to choose what
/// they show.
namespace limpet::record {

/// A stretch of the flight [s].
struct Window {
    double from_s = 0.0;
    double to_s = 0.0;
    [[nodiscard]] double span_s() const { return to_s - from_s; }
    [[nodiscard]] bool holds(double time_s) const { return time_s >= from_s && time_s <= to_s; }
};

/// Chapter::file of each that there may be.
inline constexpr const char* kOverview = "overview";
inline constexpr const char* kPerching = "perching";
inline constexpr const char* kTakeOff = "take_off";
inline constexpr const char* kFailedAttempt = "failed_attempt";
inline constexpr std::array kChapterFiles = {kOverview, kPerching, kTakeOff, kFailedAttempt};

/// A named part of the flight worth a picture of its own.
struct Chapter {
    std::string file;   ///< "perching": the picture's name without its ending
    std::string title;  ///< "perching"
    Window window;
    double zero_s = 0.0;      ///< of its own time: when what it is about began
    std::string zero = {};    ///< "the impact"; empty: the recording's time is its own
    std::string ending = {};  ///< what it came to, where the flight's outcome covers more
};

/// What the flight says of itself; texts are empty where the recording does not say.
struct Summary {
    std::string scenario;
    std::string seed;
    std::string outcome;
    std::string reason;
    std::string true_end;  ///< name of a TrueEnd; empty in recordings of before 0.3
};
/// For people: the outcome in words, and the truth where it does not bear it out; "unknown".
[[nodiscard]] std::string ending_words(const Summary& summary);

/// A stretch in one state of guidance.
struct Phase {
    std::string state;
    Window window;
};

/// From the first message to the last one; {0, 0} without any.
[[nodiscard]] Window whole_flight(const Recording& recording);

/// @return nullptr when there is none
[[nodiscard]] const RecordedEvent* first_event(const Recording& recording, EventName name,
                                               double after_s = -1e300);
[[nodiscard]] const RecordedEvent* last_event(const Recording& recording, EventName name,
                                              double before_s = 1e300);

/// The last attempt: approach_started - 0.5 s until the motors are off (or the vehicle perched, or
/// it gave up) + 1 s. nullopt without an approach.
[[nodiscard]] std::optional<Chapter> perching(const Recording& recording);
/// The last motors_on - 0.5 s until backed_off or aborted + 2 s. nullopt when it never left.
[[nodiscard]] std::optional<Chapter> take_off(const Recording& recording);
/// The first attempt that ended in a retreat: approach - 0.5 s until 3 s after the retreat began.
[[nodiscard]] std::optional<Chapter> failed_attempt(const Recording& recording);

/// The whole flight, then those of the above that happened.
[[nodiscard]] std::vector<Chapter> chapters(const Recording& recording);

/// From the metadata and the attached summary.json.
[[nodiscard]] Summary summary(const Recording& recording);

/// Guidance's states in their order; none when they were not recorded.
[[nodiscard]] std::vector<Phase> phases(const Recording& recording);

/// @return the table, or nullptr when the topic was not recorded
[[nodiscard]] const Table* find_table(const Recording& recording, std::string_view topic);

/// Row of the sample nearest to an instant; the table has rows.
[[nodiscard]] std::size_t nearest_row(const Table& table, double time_s);

/// "landing_started" -> "landing started"
[[nodiscard]] std::string words(std::string_view name);

}  // namespace limpet::record
