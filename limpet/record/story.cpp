// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/story.hpp"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>

#include "limpet/core/one_line.hpp"
#include "limpet/core/signals/true_end.hpp"

namespace limpet::record {
namespace {

constexpr double kEnd_s = 1e300;  ///< as far as it was recorded

/// As much of it as was recorded.
/// @param zero  the event that its time counts from, nullptr for its own beginning
Chapter chapter(const Recording& recording, const char* file, const char* title, double from_s,
                double to_s, const RecordedEvent* zero, std::string ending) {
    const Window whole = whole_flight(recording);
    const Window window{std::max(from_s, whole.from_s), std::min(to_s, whole.to_s)};
    const bool within = zero != nullptr && window.holds(zero->time_s);
    return {file,
            title,
            window,
            within ? zero->time_s : window.from_s,
            within ? words(zero->name) : std::string("the figure's beginning"),
            std::move(ending)};
}

/// When the first of these names happens after an instant; nullptr for none of them.
const RecordedEvent* first_of(const Recording& recording, std::initializer_list<EventName> names,
                              double after_s) {
    const RecordedEvent* earliest = nullptr;
    for (const EventName name : names) {
        const RecordedEvent* event = first_event(recording, name, after_s);
        if (event != nullptr && (earliest == nullptr || event->time_s < earliest->time_s)) {
            earliest = event;
        }
    }
    return earliest;
}

std::string text_of(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? one_line(found->get<std::string>())
                                                       : std::string();
}

std::string text_of(const mcap::StringMap& map, const char* key) {
    const auto found = map.find(key);
    return found == map.end() ? std::string() : one_line(found->second);
}

}  // namespace

const Table* find_table(const Recording& recording, std::string_view topic) {
    const Table* found = find_by(recording.tables, &Table::topic, topic);
    return found == nullptr || found->time_s.empty() ? nullptr : found;
}

std::size_t nearest_row(const Table& table, double time_s) {
    const auto& times = table.time_s;
    const auto after = std::lower_bound(times.begin(), times.end(), time_s);
    if (after == times.end()) {
        return times.size() - 1;
    }
    const auto row = static_cast<std::size_t>(after - times.begin());
    return row > 0 && time_s - times[row - 1] < times[row] - time_s ? row - 1 : row;
}

Window whole_flight(const Recording& recording) {
    Window whole{1e300, -1e300};
    for (const Table& table : recording.tables) {
        if (!table.time_s.empty()) {
            const auto [first, last] =
                std::minmax_element(table.time_s.begin(), table.time_s.end());
            whole.from_s = std::min(whole.from_s, *first);
            whole.to_s = std::max(whole.to_s, *last);
        }
    }
    return whole.from_s > whole.to_s ? Window{} : whole;
}

const RecordedEvent* first_event(const Recording& recording, EventName name, double after_s) {
    const auto found =
        std::find_if(recording.events.begin(), recording.events.end(),
                     [&](const RecordedEvent& e) { return e.is(name) && e.time_s >= after_s; });
    return found == recording.events.end() ? nullptr : &*found;
}

const RecordedEvent* last_event(const Recording& recording, EventName name, double before_s) {
    const auto found =
        std::find_if(recording.events.rbegin(), recording.events.rend(),
                     [&](const RecordedEvent& e) { return e.is(name) && e.time_s <= before_s; });
    return found == recording.events.rend() ? nullptr : &*found;
}

std::optional<Chapter> perching(const Recording& recording) {
    const RecordedEvent* approach = last_event(recording, EventName::approach_started);
    if (approach == nullptr) {
        return std::nullopt;
    }
    const double start_s = approach->time_s;
    const RecordedEvent* end =
        first_of(recording, {EventName::motors_off, EventName::retreat_started, EventName::aborted},
                 start_s);
    if (end == nullptr) {
        end = first_event(recording, EventName::perched, start_s);
    }
    const bool perched = first_event(recording, EventName::perched, start_s) != nullptr;
    return chapter(recording, kPerching, "perching", start_s - 0.5,
                   end == nullptr ? kEnd_s : end->time_s + 1.0,
                   first_event(recording, EventName::impact, start_s),
                   perched          ? "perched"
                   : end != nullptr ? words(end->name)
                                    : "");
}

std::optional<Chapter> take_off(const Recording& recording) {
    const RecordedEvent* start = last_event(recording, EventName::motors_on);
    if (start == nullptr) {
        return std::nullopt;
    }
    const RecordedEvent* end =
        first_of(recording, {EventName::backed_off, EventName::aborted}, start->time_s);
    return chapter(recording, kTakeOff, "take-off", start->time_s - 0.5,
                   end == nullptr ? kEnd_s : end->time_s + 2.0, start,
                   end == nullptr ? "" : words(end->name));
}

std::optional<Chapter> failed_attempt(const Recording& recording) {
    const RecordedEvent* retreat = first_event(recording, EventName::retreat_started);
    if (retreat == nullptr) {
        return std::nullopt;
    }
    const RecordedEvent* approach =
        last_event(recording, EventName::approach_started, retreat->time_s);
    const double start_s = approach == nullptr ? retreat->time_s - 3.0 : approach->time_s;
    return chapter(recording, kFailedAttempt, "failed attempt", start_s - 0.5,
                   retreat->time_s + 3.0, first_event(recording, EventName::impact, start_s),
                   (retreat->reason.empty() ? "no seal" : retreat->reason) + ", retreat");
}

std::vector<Chapter> chapters(const Recording& recording) {
    std::vector<Chapter> found = {
        {.file = kOverview, .title = "whole flight", .window = whole_flight(recording)}};
    for (const auto& chapter :
         {perching(recording), take_off(recording), failed_attempt(recording)}) {
        if (chapter && chapter->window.span_s() > 0.0) {
            found.push_back(*chapter);
        }
    }
    return found;
}

Summary summary(const Recording& recording) {
    Summary summary;
    const auto ours = recording.metadata.find("limpet");
    if (ours != recording.metadata.end()) {
        summary.scenario = text_of(ours->second, "scenario");
        summary.seed = text_of(ours->second, "seed");
    }
    const auto json = nlohmann::json::parse(summary_text(recording), nullptr, false);
    if (json.is_object()) {
        summary.outcome = text_of(json, "outcome");
        summary.reason = text_of(json, "reason");
        summary.true_end = text_of(json, "true_end");
    }
    return summary;
}

std::string ending_words(const Summary& summary) {
    const auto outcome = outcome_from(summary.outcome);
    const auto truth = true_end_from(summary.true_end);
    return summary.outcome.empty() ? "unknown"
           : outcome && truth      ? words(told_with_truth(*outcome, *truth))
                                   : words(summary.outcome);
}

std::vector<Phase> phases(const Recording& recording) {
    std::vector<Phase> found;
    const Table* table = find_table(recording, "/guidance");
    const TextColumn* states = table == nullptr ? nullptr : table->find_text("state");
    if (states == nullptr) {
        return found;
    }
    for (std::size_t i = 0; i < states->values.size(); ++i) {
        const double time_s = table->time_s[i];
        if (found.empty() || found.back().state != states->values[i]) {
            if (!found.empty()) {
                found.back().window.to_s = time_s;
            }
            found.push_back({states->values[i], {time_s, time_s}});
        }
    }
    found.back().window.to_s = whole_flight(recording).to_s;
    return found;
}

std::string words(std::string_view name) {
    std::string text(name);
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

}  // namespace limpet::record
