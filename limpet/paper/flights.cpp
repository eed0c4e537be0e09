// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/flights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "limpet/core/frames.hpp"
#include "limpet/record/story.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kSpikeWindow_s = 0.5;
constexpr double kSteady_s = 3.0;  ///< at the end of the rest

struct Stretch {
    double from_s = kNone;
    double to_s = kNone;
};

/// A column's samples within a stretch.
std::vector<double> within(const record::Recording& recording, const char* topic,
                           const char* column, const Stretch& stretch) {
    std::vector<double> values;
    const record::Table* table = find_table(recording, topic);
    const record::Column* found = table == nullptr ? nullptr : table->find(column);
    for (std::size_t i = 0; found != nullptr && i < found->values.size(); ++i) {
        if (table->time_s[i] >= stretch.from_s && table->time_s[i] <= stretch.to_s) {
            values.push_back(found->values[i]);
        }
    }
    return values;
}

double least(const std::vector<double>& values) {
    return values.empty() ? kNone : *std::min_element(values.begin(), values.end());
}

double most(const std::vector<double>& values) {
    return values.empty() ? kNone : *std::max_element(values.begin(), values.end());
}

double mean(const std::vector<double>& values) {
    return values.empty() ? kNone
                          : std::accumulate(values.begin(), values.end(), 0.0) /
                                static_cast<double>(values.size());
}

/// How far values ever rise above the lowest one before, over their whole fall: 0 for a fall
/// without a set-back.
double setback(const std::vector<double>& values) {
    double lowest = std::numeric_limits<double>::infinity(), worst = 0.0;
    for (const double value : values) {
        lowest = std::min(lowest, value);
        worst = std::max(worst, value - lowest);
    }
    return values.size() < 2 ? kNone : worst / std::max(1e-9, values.front() - least(values));
}

double time_of(const record::RecordedEvent* event) {
    return event == nullptr ? kNone : event->time_s;
}

double value_of(const record::RecordedEvent* event, const char* name) {
    if (event != nullptr) {
        for (const auto& [key, value] : event->values) {
            if (key == name) {
                return value;
            }
        }
    }
    return kNone;
}

class Reader {
public:
    Reader(const PaperFlight& flight, Evidence& evidence)
        : recording_(flight.recording), name_(flight.name), evidence_(evidence) {}

    void approach() {
        const record::RecordedEvent* first = first_event(recording_, "approach_started");
        set("distance_before_approach_m", value_of(first, "distance_m"));
        // The walls of the paper's flights face south: the true angle is the yaw.
        const auto yaw = within(recording_, "/truth/vehicle", "yaw_rad",
                                {time_of(first) - 0.005, time_of(first) + 0.005});
        set("wall_angle_error_deg",
            yaw.empty() ? kNone
                        : std::abs(value_of(first, "misalignment_deg") + degrees(yaw.front())));
        const record::RecordedEvent* impact = first_event(recording_, "impact");
        set("spike_after_s", time_of(impact) - time_of(first));
        set("contact_s", first_contact_s());
        // The last 0.2 s, up to 50 ms before the force sensor said so.
        const std::vector<double> speeds =
            within(recording_, "/truth/vehicle", "velocity_north_m_s",
                   {time_of(impact) - 0.25, time_of(impact) - 0.05});
        set("approach_speed_change_m_s", most(speeds) - least(speeds));
    }

    /// How long the lip first met the wall.
    [[nodiscard]] double first_contact_s() const {
        const record::Table* table = find_table(recording_, "/cup");
        const record::Column* phase = table == nullptr ? nullptr : table->find("phase");
        double from_s = kNone;
        for (std::size_t i = 0; phase != nullptr && i < phase->values.size(); ++i) {
            const bool touches = phase->values[i] > 0.0;
            if (touches && std::isnan(from_s)) {
                from_s = table->time_s[i];
            } else if (!touches && !std::isnan(from_s)) {
                return table->time_s[i] - from_s;
            }
        }
        return kNone;
    }

    void touch(const std::string& prefix, const record::RecordedEvent* impact) {
        const Stretch after{time_of(impact) - 0.05, time_of(impact) + kSpikeWindow_s};
        set(prefix + "spike_N",
            least(within(recording_, "/sensors/force", "wrench.force.x", after)));
        const auto pitches = within(recording_, "/truth/vehicle", "pitch_rad",
                                    {time_of(impact), time_of(impact) + kSpikeWindow_s});
        set(prefix + "pitch_drop_deg",
            pitches.empty() ? kNone : degrees(least(pitches) - pitches.front()));
        set(prefix + "lowest_pressure_hPa",
            hectopascals(
                least(within(recording_, "/sensors/cup_pressure", "fluid_pressure", after))));
        const record::RecordedEvent* over = first_event(recording_, "hold_over", time_of(impact));
        set(prefix + "hold_s", time_of(over) - time_of(impact));
    }

    void landing() {
        const record::RecordedEvent* start = last_event(recording_, "landing_started");
        const record::RecordedEvent* end = first_event(recording_, "perched", time_of(start));
        const Stretch land{time_of(start), time_of(end)};
        set("pressure_at_landing_hPa", hectopascals(value_of(start, "pressure_Pa")));
        set("landing_pitch_rise_deg", value_of(end, "pitch_deg") - value_of(start, "pitch_deg"));
        set("landing_force_rise_N", value_of(end, "force_N") - value_of(start, "force_N"));
        set("landing_s", land.to_s - land.from_s);
        const auto thrust = within(recording_, "/truth/vehicle", "thrust_N", land);
        set("thrust_when_perched_N", thrust.empty() ? kNone : thrust.back());
    }

    void rest() {
        const double off_s = time_of(first_event(recording_, "motors_off"));
        const record::RecordedEvent* on = first_event(recording_, "motors_on", off_s);
        const Stretch end{std::max(off_s, time_of(on) - kSteady_s), time_of(on)};
        // The pump's own part: true pressure, so that the sensor's noise does not count.
        const auto ripple = within(recording_, "/cup", "pressure_Pa", end);
        set("rest_ripple_hPa", hectopascals(most(ripple) - least(ripple)));
        set("rest_pump_share", mean(within(recording_, "/cup", "pump_running", end)));
    }

    void take_off() {
        const record::RecordedEvent* on = last_event(recording_, "motors_on");
        const record::RecordedEvent* level = first_event(recording_, "level", time_of(on));
        const record::RecordedEvent* off = first_event(recording_, "pump_off", time_of(on));
        const Stretch up{time_of(on), time_of(level)};
        set("take_off_pressure_hPa", hectopascals(value_of(on, "pressure_Pa")));
        const auto thrust = within(recording_, "/truth/vehicle", "thrust_N", up);
        set("take_off_thrust_rise_N", thrust.empty() ? kNone : thrust.back() - thrust.front());
        set("take_off_pitch_setback",
            setback(within(recording_, "/truth/vehicle", "pitch_rad", up)));
        set("take_off_force_fall_N", value_of(on, "force_N") - value_of(level, "force_N"));
        set("pump_off_pitch_deg", std::abs(value_of(off, "pitch_deg")));
        set("pump_off_after_level_s", time_of(off) - time_of(level));
        const record::RecordedEvent* released =
            first_event(recording_, "pressure_released", time_of(off));
        set("pressure_released_hPa", hectopascals(value_of(released, "pressure_Pa")));
        set("waited_s",
            (released != nullptr ? time_of(released)
                                 : time_of(first_event(recording_, "aborted", time_of(off)))) -
                time_of(off));
        set("back_at_m", value_of(last_event(recording_, "backed_off"), "distance_m"));
    }

    void first_failure() {
        const record::RecordedEvent* retreat = first_event(recording_, "retreat_started");
        const record::RecordedEvent* again =
            first_event(recording_, "pre_positioned", time_of(retreat));
        set("retreated_to_m", value_of(again, "distance_m"));
        set("second_attempt_after_s",
            time_of(first_event(recording_, "approach_started", time_of(retreat))) -
                time_of(retreat));
    }

    void set(const std::string& what, double value) { evidence_.set(name_ + "." + what, value); }

private:
    const record::Recording& recording_;
    std::string name_;
    Evidence& evidence_;
};

}  // namespace

PaperFlight fly_recorded(const FlightOrder& order, const std::filesystem::path& folder) {
    const scenario::Scenario scenario =
        scenario::load_scenario(order.scenario, {.overrides = order.overrides});
    std::filesystem::create_directories(folder / order.name);
    const std::filesystem::path file = folder / order.name / "flight.mcap";
    PaperFlight flight;
    flight.name = order.name;
    flight.result = simulation::fly(simulation::build_model(scenario), file);
    flight.recording = record::read_recording(file);
    return flight;
}

void measure(const PaperFlight& flight, Evidence& evidence) {
    Reader take(flight, evidence);
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        take.set(std::string(metric.name), flight.result.metrics.*metric.field);
    }
    take.set("attempts", flight.result.attempts);
    take.set("pressure_lowest_hPa", hectopascals(flight.result.metrics.pressure_min_Pa));
    take.set("pressure_at_release_end_hPa",
             hectopascals(flight.result.metrics.pressure_at_release_end_Pa));
    take.set("seal_margin_N",
             flight.result.metrics.impact_force_N -
                 value_of(last_event(flight.recording, "attached"), "seal_threshold_N"));
    for (const Outcome outcome : {Outcome::perched, Outcome::released, Outcome::failed_to_seal,
                                  Outcome::release_aborted, Outcome::crashed, Outcome::timed_out}) {
        take.set("is_" + std::string(to_string(outcome)),
                 flight.result.outcome == outcome ? 1.0 : 0.0);
    }
    take.set("cup_sensors",
             (find_table(flight.recording, "/sensors/cup_pressure") != nullptr ? 1.0 : 0.0) +
                 (find_table(flight.recording, "/sensors/force") != nullptr ? 1.0 : 0.0));
    take.approach();
    take.touch("first_", first_event(flight.recording, "impact"));
    take.touch("", last_event(flight.recording, "impact"));
    take.landing();
    take.rest();
    take.take_off();
    take.first_failure();
}

}  // namespace limpet::paper
