// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/result_json.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace limpet::simulation {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const Event& event) {
    Json values = Json::object();
    for (std::size_t k = 0; k < event.value_count; ++k) {
        values[std::string(event.values[k].name)] = number(event.values[k].value);
    }
    return {{"t_s", event.time_s},
            {"name", to_string(event.name)},
            {"station", event.station},
            {"reason", event.reason},
            {"values", values}};
}

Json json_of(const Metrics& m) {
    Json metrics = Json::object();
    for (const MetricInfo& metric : metric_table()) {
        metrics[std::string(metric.name)] = number(m.*metric.field);
    }
    return metrics;
}

Json loads_of(const Metrics& m) {
    Json loads = Json::object();
    for (const LoadPhase phase : kLoadPhases) {
        const CupLoads& load = m.loads[static_cast<std::size_t>(phase)];
        if (std::isfinite(load.margin_N)) {
            loads[std::string(to_string(phase))] = {{"pull_N", load.pull_N},
                                                    {"shear_N", load.shear_N},
                                                    {"peel_N_m", load.peel_N_m},
                                                    {"margin_N", load.margin_N}};
        }
    }
    return loads;
}

Json json_of(const autopilot::AutopilotIdentity& who) {
    return {{"name", who.name},
            {"version", who.version},
            {"git_hash", who.git_hash.empty() ? Json(nullptr) : Json(who.git_hash)},
            {"airframe", who.airframe ? Json(*who.airframe) : Json(nullptr)},
            {"system", who.system}};
}

Json common(const FlightResult& result) {
    Json events = Json::array();
    for (const Event& event : result.events) {
        events.push_back(json_of(event));
    }
    Json json = {{"scenario", result.scenario},
                 {"seed", result.seed},
                 {"outcome", to_string(result.outcome)},
                 {"reason", result.reason},
                 {"true_end", to_string(result.true_end)},
                 {"borne_out", bears_out(result.true_end, result.outcome)},
                 {"success", is_success(result.outcome, result.true_end)},
                 {"attempts", result.attempts},
                 {"events", events},
                 {"metrics", json_of(result.metrics)},
                 {"loads", loads_of(result.metrics)}};
    if (result.autopilot) {
        json["autopilot"] = json_of(*result.autopilot);
    }
    return json;
}

std::string hex(std::uint64_t value) {
    return fmt::format("{:016x}", value);
}

}  // namespace

std::string result_json(const FlightResult& result) {
    Json json = common(result);
    json["performance"] = {{"simulated_s", result.performance.simulated_s},
                           {"wall_s", result.performance.wall_s},
                           {"real_time_factor", result.performance.real_time_factor()},
                           {"physics_steps", result.performance.physics_steps}};
    if (const auto own_share = result.performance.own_share(); result.autopilot && own_share) {
        json["performance"]["own_share"] = *own_share;
    }
    json["recording"] = result.recording.empty() ? Json(nullptr) : Json(result.recording.string());
    json["state_hash"] = hex(result.state_hash);
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string summary_json(const FlightResult& result) {
    Json json = common(result);
    json["performance"] = {{"simulated_s", result.performance.simulated_s},
                           {"physics_steps", result.performance.physics_steps}};
    json["state_hash"] = hex(result.state_hash);
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace limpet::simulation
