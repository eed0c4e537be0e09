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

constexpr double kSpikeWindow_s = 0.5;
constexpr double kSteady_s = 3.0;  ///< at the end of the rest
constexpr const char* kTruth = "/truth/vehicle";

/// Samples of a column; every result is NaN without any.
struct Samples {
    std::vector<double> values = {};

    [[nodiscard]] double first() const { return values.empty() ? kNaN : values.front(); }
    [[nodiscard]] double last() const { return values.empty() ? kNaN : values.back(); }
    [[nodiscard]] double least() const {
        return values.empty() ? kNaN : *std::min_element(values.begin(), values.end());
    }
    [[nodiscard]] double most() const {
        return values.empty() ? kNaN : *std::max_element(values.begin(), values.end());
    }
    [[nodiscard]] double mean() const {
        return std::accumulate(values.begin(), values.end(), 0.0) /
               static_cast<double>(values.size());
    }
    /// How far values ever rise above the lowest one before, over their whole fall: 0 for a fall
    /// without a set-back.
    [[nodiscard]] double setback() const {
        double lowest = std::numeric_limits<double>::infinity(), worst = 0.0;
        for (const double value : values) {
            lowest = std::min(lowest, value);
            worst = std::max(worst, value - lowest);
        }
        return values.size() < 2 ? kNaN : worst / std::max(1e-9, first() - least());
    }
};

/// Pearson's; NaN for fewer than two pairs.
double correlation(const Samples& a, const Samples& b) {
    const std::size_t n = std::min(a.values.size(), b.values.size());
    double aa = 0.0, bb = 0.0, ab = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double da = a.values[i] - a.mean(), db = b.values[i] - b.mean();
        aa += da * da, bb += db * db, ab += da * db;
    }
    return n < 2 ? kNaN : ab / std::sqrt(aa * bb);
}

/// An event; its time and numbers are NaN when it did not come to pass.
class Instant {
public:
    explicit Instant(const record::RecordedEvent* event) : event_(event) {}

    [[nodiscard]] bool came() const { return event_ != nullptr; }
    [[nodiscard]] double time_s() const { return came() ? event_->time_s : kNaN; }
    [[nodiscard]] double operator[](const char* name) const {
        if (came()) {
            for (const auto& [key, value] : event_->values) {
                if (key == name) {
                    return value;
                }
            }
        }
        return kNaN;
    }

private:
    const record::RecordedEvent* event_;
};

class Reader {
public:
    Reader(const PaperFlight& flight, Evidence& evidence)
        : recording_(flight.recording), name_(flight.name), evidence_(evidence) {}

    void approach() {
        const Instant start = first(EventName::approach_started), impact = first(EventName::impact);
        set("distance_before_approach_m", start["distance_m"]);
        // The walls of the paper's flights face south: the true angle is the yaw.
        const double yaw_rad =
            within(kTruth, "yaw_rad", start.time_s() - 0.005, start.time_s() + 0.005).first();
        set("wall_angle_error_deg", std::abs(start["misalignment_deg"] + degrees(yaw_rad)));
        set("spike_after_s", impact.time_s() - start.time_s());
        set("contact_s", first_contact_s());
        // The last 0.2 s, up to 50 ms before the force sensor measured it.
        const Samples speeds =
            within(kTruth, "velocity_north_m_s", impact.time_s() - 0.25, impact.time_s() - 0.05);
        set("approach_speed_change_m_s", speeds.most() - speeds.least());
    }

    /// How long the lip first met the wall.
    [[nodiscard]] double first_contact_s() const {
        const record::Table* table = find_table(recording_, "/cup");
        const record::Column* phase = table == nullptr ? nullptr : table->find("phase");
        double from_s = kNaN;
        for (std::size_t i = 0; phase != nullptr && i < phase->values.size(); ++i) {
            const bool touches = phase->values[i] > 0.0;
            if (touches && std::isnan(from_s)) {
                from_s = table->time_s[i];
            } else if (!touches && !std::isnan(from_s)) {
                return table->time_s[i] - from_s;
            }
        }
        return kNaN;
    }

    void touch(const std::string& prefix, const Instant& impact) {
        const double at_s = impact.time_s(), end_s = at_s + kSpikeWindow_s;
        const Samples pitches = within(kTruth, "pitch_rad", at_s, end_s);
        set(prefix + "spike_N",
            within("/sensors/force", "wrench.force.x", at_s - 0.05, end_s).least());
        // Thrown back by its spring the vehicle pulls the slider against its outer stop.
        const record::Table* truth = find_table(recording_, kTruth);
        const record::Column* force = truth == nullptr ? nullptr : truth->find("slider_force_N");
        const record::Column* slider =
            truth == nullptr ? nullptr : truth->find("slider_position_m");
        double rebound_N = kNaN, rebound_s = kNaN, slider_m = kNaN;
        for (std::size_t i = 0; force != nullptr && slider != nullptr && i < truth->time_s.size();
             ++i) {
            if (truth->time_s[i] >= at_s && truth->time_s[i] <= end_s &&
                !(force->values[i] <= rebound_N)) {
                rebound_N = force->values[i];
                rebound_s = truth->time_s[i] - at_s;
                slider_m = slider->values[i];
            }
        }
        set(prefix + "rebound_N", rebound_N);
        set(prefix + "rebound_after_s", rebound_s);
        set(prefix + "rebound_slider_mm", 1e3 * slider_m);
        set(prefix + "pitch_drop_deg", degrees(pitches.least() - pitches.first()));
        set(prefix + "lowest_pressure_hPa",
            hectopascals(
                within("/sensors/cup_pressure", "fluid_pressure", at_s - 0.05, end_s).least()));
        set(prefix + "hold_s", first(EventName::hold_over, at_s).time_s() - at_s);
    }

    void landing() {
        const Instant start = last(EventName::landing_started),
                      end = first(EventName::perched, start.time_s());
        set("pressure_at_landing_hPa", hectopascals(start["pressure_Pa"]));
        set("landing_pitch_rise_deg", end["pitch_deg"] - start["pitch_deg"]);
        set("landing_force_rise_N", end["force_N"] - start["force_N"]);
        set("landing_s", end.time_s() - start.time_s());
        set("landing_force_lift_correlation",
            correlation(within(kTruth, "slider_force_N", start.time_s(), end.time_s()),
                        within(kTruth, "thrust_N", start.time_s(), end.time_s())));
        set("thrust_when_perched_N",
            within(kTruth, "thrust_N", start.time_s(), end.time_s()).last());
    }

    void rest() {
        const double off_s = first(EventName::motors_off).time_s();
        const double on_s = first(EventName::motors_on, off_s).time_s();
        const double from_s = std::max(off_s, on_s - kSteady_s);
        // The pump's own part: true pressure, so that the sensor's noise does not count.
        const Samples ripple = within("/cup", "pressure_Pa", from_s, on_s);
        set("rest_ripple_hPa", hectopascals(ripple.most() - ripple.least()));
        set("rest_pump_share", within("/cup", "pump_running", from_s, on_s).mean());
    }

    void take_off() {
        const Instant on = last(EventName::motors_on), level = first(EventName::level, on.time_s());
        const Instant off = first(EventName::pump_off, on.time_s());
        const Instant released = first(EventName::pressure_released, off.time_s());
        const Samples thrust = within(kTruth, "thrust_N", on.time_s(), level.time_s());
        set("take_off_pressure_hPa", hectopascals(on["pressure_Pa"]));
        set("take_off_thrust_rise_N", thrust.last() - thrust.first());
        set("take_off_pitch_setback",
            within(kTruth, "pitch_rad", on.time_s(), level.time_s()).setback());
        set("take_off_force_fall_N", on["force_N"] - level["force_N"]);
        set("pump_off_pitch_deg", std::abs(off["pitch_deg"]));
        set("pump_off_after_level_s", off.time_s() - level.time_s());
        set("pressure_released_hPa", hectopascals(released["pressure_Pa"]));
        const Instant end = released.came() ? released : first(EventName::aborted, off.time_s());
        set("waited_s", end.time_s() - off.time_s());
        set("back_at_m", last(EventName::backed_off)["distance_m"]);
    }

    /// From pump off until nine tenths of the vacuum are gone, by the true pressure.
    void regain() {
        const Instant off = last(EventName::pump_off);
        const record::Table* cup = find_table(recording_, "/cup");
        const record::Column* pressure = cup == nullptr ? nullptr : cup->find("pressure_Pa");
        double begin_Pa = kNaN, regained_s = kNaN;
        for (std::size_t i = 0; pressure != nullptr && i < pressure->values.size(); ++i) {
            if (!(cup->time_s[i] >= off.time_s())) {
                continue;
            }
            const double now_Pa = pressure->values[i];
            begin_Pa = std::isnan(begin_Pa) ? now_Pa : begin_Pa;
            if (kAtmosphere_Pa - now_Pa <= 0.1 * (kAtmosphere_Pa - begin_Pa)) {
                regained_s = cup->time_s[i] - off.time_s();
                break;
            }
        }
        set("pressure_regained_s", regained_s);
    }

    void first_failure() {
        const double retreat_s = first(EventName::retreat_started).time_s();
        set("retreated_to_m", first(EventName::pre_positioned, retreat_s)["distance_m"]);
        set("second_attempt_after_s",
            first(EventName::approach_started, retreat_s).time_s() - retreat_s);
    }

    [[nodiscard]] Instant first(EventName name, double after_s = -1e300) const {
        return Instant(first_event(recording_, name, after_s));
    }
    [[nodiscard]] Instant last(EventName name) const {
        return Instant(last_event(recording_, name));
    }

    void set(const std::string& what, double value) { evidence_.set(name_ + "." + what, value); }

private:
    [[nodiscard]] Samples within(const char* topic, const char* column, double from_s,
                                 double to_s) const {
        Samples samples;
        const record::Table* table = find_table(recording_, topic);
        const record::Column* found = table == nullptr ? nullptr : table->find(column);
        for (std::size_t i = 0; found != nullptr && i < found->values.size(); ++i) {
            if (table->time_s[i] >= from_s && table->time_s[i] <= to_s) {
                samples.values.push_back(found->values[i]);
            }
        }
        return samples;
    }

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
    take.set("seal_margin_N", flight.result.metrics.impact_force_N -
                                  take.last(EventName::attached)["seal_threshold_N"]);
    for (const Outcome outcome :
         {Outcome::perched, Outcome::released, Outcome::failed_to_seal, Outcome::release_aborted,
          Outcome::aborted, Outcome::crashed, Outcome::timed_out}) {
        take.set("is_" + std::string(to_string(outcome)),
                 flight.result.outcome == outcome && bears_out(flight.result.true_end, outcome)
                     ? 1.0
                     : 0.0);
    }
    take.set("cup_sensors",
             (find_table(flight.recording, "/sensors/cup_pressure") != nullptr ? 1.0 : 0.0) +
                 (find_table(flight.recording, "/sensors/force") != nullptr ? 1.0 : 0.0));
    take.approach();
    take.touch("first_", take.first(EventName::impact));
    take.touch("", take.last(EventName::impact));
    take.landing();
    take.rest();
    take.take_off();
    take.regain();
    take.first_failure();
    take.set("rested", take.first(EventName::motors_off).came() ? 1.0 : 0.0);
    take.set("approached", take.first(EventName::approach_started).came() ? 1.0 : 0.0);
}

}  // namespace limpet::paper
