// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/learn.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limpet/core/errors.hpp"
#include "limpet/plant/lane_group.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::lab {
namespace {

using nlohmann::json;

constexpr double kLeastShare = 1e-3;
constexpr double kMostShare = 0.9;

double share_in(const json& request) {
    const auto found = request.find("share");
    if (found == request.end()) {
        return 0.1;
    }
    const double share = found->is_number() ? found->get<double>() : kNaN;
    if (!(share >= kLeastShare && share <= kMostShare)) {
        throw InputError(
            fmt::format("\"share\" is a number, allowed {}..{}", kLeastShare, kMostShare));
    }
    return share;
}

/// @param flown  to its end: else it has none
json metrics_json(const simulation::Metrics& metrics, bool flown) {
    json values = json::array();
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        // null where it did not come to pass
        values.push_back(flown ? json(metrics.*metric.field) : json());
    }
    return values;
}

}  // namespace

Learn::~Learn() {
    stop();
}

void Learn::begin(std::string_view request) {
    const json json = object_in(request);
    const double share = share_in(json);
    FlightRequest asked = flight_request_in(json, first_);
    scenario::Scenario scenario =
        scenario::load_scenario(asked.scenario, {.overrides = asked.changes});
    std::vector<Turned> flights(1);
    for (const scenario::Section& section : scenario_sections(scenario)) {
        for (const BoundParameter& row : section.rows) {
            const double value = row.value.get();
            if (row.value.is_whole() || row.value.is_switch() || value == 0.0) {
                continue;
            }
            for (const double sign : {-1.0, 1.0}) {
                Turned turned;
                turned.key = section.name + "." + std::string(row.name);
                turned.unit = row.unit;
                turned.value = std::clamp(value * (1.0 + sign * share), row.minimum, row.maximum);
                flights.push_back(turned);
            }
        }
    }
    stop();
    thread_ = {};
    asked_ = std::move(asked);
    flights_ = std::move(flights);
    next_ = 0;
    trouble_.clear();
    stop_ = false;
    ++id_;
    thread_ = begin_thread(running_, [this] {
        try {
            plant::fly_side_by_side([this] { fly_all(); });
        } catch (const std::exception&) {
            trouble_.keep();
        }
        running_ = false;
    });
}

void Learn::fly_all() {
    try {
        for (std::size_t i = next_++; i < flights_.size() && !stop_; i = next_++) {
            fly(flights_[i]);
        }
    } catch (const std::exception&) {
        trouble_.keep();
        stop_ = true;
    }
}

void Learn::fly(Turned& turned) {
    std::vector<std::string> changes = asked_.changes;
    if (!turned.key.empty()) {
        changes.push_back(turned.key + "=" + scenario::number_text(turned.value));
    }
    std::string outcome = "refused";
    bool flown = false;
    simulation::Metrics metrics;
    try {
        const auto model = simulation::build_model(
            scenario::load_scenario(asked_.scenario, {.overrides = changes}));
        const auto result = simulation::fly(model, {}, {}, 0, {.stop = &stop_});
        if (stop_) {
            return;
        }
        outcome = told_with_truth(result.outcome, result.true_end);
        metrics = result.metrics;
        flown = true;
    } catch (const InputError&) {  // the value does not go with another one
    } catch (const InternalError&) {
        outcome = "fault";
    }
    const std::lock_guard lock(guards_outcomes_);
    turned.outcome = outcome;
    turned.flown = flown;
    turned.metrics = metrics;
}

std::string Learn::state() {
    trouble_.say();
    const bool running = running_;  // before the flights: none is missed when it has ended
    const std::lock_guard lock(guards_outcomes_);
    const auto flight_json = [](const Turned& turned) {
        return json{{"value", turned.value},
                    {"outcome", turned.outcome},
                    {"metrics", metrics_json(turned.metrics, turned.flown)}};
    };
    json rows = json::array(), names = json::array();
    for (std::size_t i = 1; i + 1 < flights_.size(); i += 2) {
        const Turned &less = flights_[i], &more = flights_[i + 1];
        if (!less.outcome.empty() && !more.outcome.empty()) {
            rows.push_back({{"key", less.key},
                            {"unit", less.unit},
                            {"less", flight_json(less)},
                            {"more", flight_json(more)}});
        }
    }
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        names.push_back(metric.name);
    }
    return json{{"id", id_},
                {"running", running},
                {"flights", flights_.size()},
                {"flown", std::count_if(flights_.begin(), flights_.end(),
                                        [](const Turned& t) { return !t.outcome.empty(); })},
                {"metrics", names},
                {"base", flights_.empty() ? json() : flight_json(flights_.front())},
                {"rows", rows}}
        .dump();
}

}  // namespace limpet::lab
