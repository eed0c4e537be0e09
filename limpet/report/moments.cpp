// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>

#include "limpet/record/story.hpp"
#include "limpet/record/topics.hpp"
#include "limpet/report/filmstrip.hpp"

namespace limpet::report {
namespace {

constexpr std::size_t kMost = 8;
constexpr double kApart_s = 0.04;

/// @return nullopt when there is no such column
std::optional<double> value_at(const record::Recording& recording, std::string_view topic,
                               std::string_view column, double time_s) {
    const record::Table* table = find_table(recording, topic);
    const record::Column* found = table == nullptr ? nullptr : table->find(column);
    return found == nullptr ? std::nullopt
                            : std::optional(found->values[nearest_row(*table, time_s)]);
}

std::optional<double> pitch_at(const record::Recording& recording, double time_s) {
    return value_at(recording, "/truth/vehicle", "pitch_rad", time_s);
}

/// When the pitch has made a share of its way from the one instant to the other.
double time_of_pitch(const record::Recording& recording, const record::Window& window,
                     double share) {
    const double from = pitch_at(recording, window.from_s).value_or(0.0);
    const double to = pitch_at(recording, window.to_s).value_or(0.0);
    constexpr int kSteps = 400;
    for (int i = 0; i <= kSteps; ++i) {
        const double time_s = window.from_s + window.span_s() * i / kSteps;
        const double made = pitch_at(recording, time_s).value_or(0.0) - from;
        if (std::abs(made) >= share * std::abs(to - from)) {
            return time_s;
        }
    }
    return window.to_s;
}

class Story {
public:
    explicit Story(const record::Recording& recording)
        : recording_(recording), end_s_(whole_flight(recording).to_s) {}

    void add(double time_s, std::string name) {
        if (time_s <= end_s_) {
            moments_.emplace_back().time_s = time_s;  // GCC 12 sees ghosts in a moved pair
            moments_.back().name = std::move(name);
        }
    }
    /// The first of that name from an instant on.
    const record::RecordedEvent* add_event(EventName name, double after_s) {
        const record::RecordedEvent* event = first_event(recording_, name, after_s);
        if (event != nullptr) {
            add(event->time_s, record::words(to_string(name)));
        }
        return event;
    }
    void add_pitches(double from_s, double to_s, const char* name) {
        for (const double share : {1.0 / 3.0, 2.0 / 3.0}) {
            add(time_of_pitch(recording_, {from_s, to_s}, share), name);
        }
    }

    [[nodiscard]] std::vector<Moment> take() {
        std::stable_sort(moments_.begin(), moments_.end(),
                         [](const Moment& a, const Moment& b) { return a.time_s < b.time_s; });
        std::vector<Moment> apart;
        for (Moment& moment : moments_) {
            if (!apart.empty() && moment.time_s - apart.back().time_s < kApart_s) {
                apart.back().name += ", " + moment.name;
            } else {
                apart.push_back(std::move(moment));
            }
        }
        apart.resize(std::min(apart.size(), kMost));
        return apart;
    }

private:
    const record::Recording& recording_;
    double end_s_;
    std::vector<Moment> moments_;
};

}  // namespace

std::vector<Moment> perching_moments(const record::Recording& recording) {
    const record::RecordedEvent* approach = last_event(recording, EventName::approach_started);
    if (approach == nullptr) {
        return {};
    }
    Story story(recording);
    const double start_s = approach->time_s;
    const record::RecordedEvent* before = last_event(recording, EventName::pre_positioned, start_s);
    story.add(before == nullptr ? start_s : before->time_s,
              before == nullptr ? "approach started" : "pre-positioned");
    const record::RecordedEvent* impact = story.add_event(EventName::impact, start_s);
    if (impact == nullptr) {
        story.add(0.5 * (start_s + whole_flight(recording).to_s), "approach");
        return story.take();
    }
    story.add(start_s + 0.6 * (impact->time_s - start_s), "approach");
    if (const auto* retreat = first_event(recording, EventName::retreat_started, impact->time_s)) {
        story.add(0.5 * (impact->time_s + retreat->time_s), "hold");
        story.add(retreat->time_s, "retreat started");
        story.add(retreat->time_s + 1.0, "retreat");
        return story.take();
    }
    story.add_event(EventName::attached, impact->time_s);
    const auto* landing = first_event(recording, EventName::landing_started, impact->time_s);
    if (landing == nullptr) {
        return story.take();
    }
    if (const auto* perched = story.add_event(EventName::perched, landing->time_s)) {
        story.add_pitches(landing->time_s, perched->time_s, "landing");
        if (const auto* off = first_event(recording, EventName::motors_off, perched->time_s)) {
            story.add(off->time_s + 1.0, "at rest, motors off");
        }
    } else {
        story.add(landing->time_s, "landing started");
    }
    return story.take();
}

std::vector<Moment> take_off_moments(const record::Recording& recording) {
    const record::RecordedEvent* start = last_event(recording, EventName::motors_on);
    if (start == nullptr) {
        return {};
    }
    Story story(recording);
    story.add(start->time_s, "motors on");
    if (const auto* level = story.add_event(EventName::level, start->time_s)) {
        story.add_pitches(start->time_s, level->time_s, "pitching down");
        story.add_event(EventName::pressure_released, level->time_s);
    }
    story.add_event(EventName::aborted, start->time_s);
    const record::RecordedEvent* detached = story.add_event(EventName::detached, start->time_s);
    const record::RecordedEvent* back = story.add_event(EventName::backed_off, start->time_s);
    if (detached != nullptr && back != nullptr) {
        story.add(0.6 * detached->time_s + 0.4 * back->time_s, "backing off");
    }
    return story.take();
}

std::vector<Moment> flight_moments(const record::Recording& recording) {
    const record::Window whole = whole_flight(recording);
    const std::vector<record::Phase> states = phases(recording);
    std::vector<Moment> moments;
    for (std::size_t i = 0; i < kMost; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(kMost - 1);
        const double time_s = whole.from_s + share * whole.span_s();
        const auto next = std::find_if(
            states.begin(), states.end(),
            [time_s](const record::Phase& phase) { return phase.window.from_s > time_s; });
        moments.push_back(
            {time_s, next == states.begin() ? "flight" : record::words(std::prev(next)->state)});
    }
    return moments;
}

draw::Pose pose_at(const record::Recording& recording, double time_s) {
    const record::Table& table = recording.table("/truth/pose");
    const std::size_t row = table.time_s.empty() ? 0 : nearest_row(table, time_s);
    const auto value = [&](const char* column) {
        return recording.series("/truth/pose", column).values[row];
    };
    // ROS has east-north-up: a quarter turn about "up" makes it north-west-up.
    const Quaternion quarter(std::sqrt(0.5), 0.0, 0.0, -std::sqrt(0.5));
    draw::Pose pose;
    pose.position_m = {value("pose.position.y"), -value("pose.position.x"),
                       value("pose.position.z")};
    pose.attitude = quarter * Quaternion(value("pose.orientation.w"), value("pose.orientation.x"),
                                         value("pose.orientation.y"), value("pose.orientation.z"));
    const auto truth = [&](const char* column) {
        return value_at(recording, "/truth/vehicle", column, time_s).value_or(0.0);
    };
    constexpr double kStanding_rad_s = 20.0;
    pose.slider_m = truth("slider_position_m");
    pose.cup_pitch_rad = truth("cup_pitch_rad");
    pose.cup_yaw_rad = truth("cup_yaw_rad");
    pose.rotors_turn = truth("rotor_speed_rad_s[0]") > kStanding_rad_s;
    if (record::find_table(recording, record::kPayloadTopic) != nullptr) {
        const auto payload = [&](const char* column) {
            return value_at(recording, record::kPayloadTopic, column, time_s).value_or(0.0);
        };
        pose.payload_m = {payload("north_m"), -payload("east_m"), -payload("down_m")};
        pose.cable_holds = payload("cable_parted") == 0.0;
    }
    return pose;
}

std::string caption_at(const record::Recording& recording, double time_s) {
    std::string text = fmt::format("{:.2f} s", time_s);
    if (const auto pitch_rad = pitch_at(recording, time_s)) {
        const double tenths = std::round(10.0 * degrees(*pitch_rad));
        text += fmt::format("   pitch {:.1f}°", 0.1 * tenths + 0.0);  // never "-0.0"
    }
    if (const auto pressure_Pa =
            value_at(recording, "/sensors/cup_pressure", "fluid_pressure", time_s)) {
        text += fmt::format("   {:.0f} hPa", hectopascals(*pressure_Pa));
    }
    return text;
}

}  // namespace limpet::report
