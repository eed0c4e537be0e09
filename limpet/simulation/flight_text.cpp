// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/flight_text.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "limpet/core/errors.hpp"
#include "limpet/px4/airframe.hpp"

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

std::optional<double> value_of(const Event& event, std::string_view name) {
    for (std::size_t k = 0; k < event.value_count; ++k) {
        if (event.values[k].name == name) {
            return event.values[k].value;
        }
    }
    return std::nullopt;
}

std::string cell(std::optional<double> value, int width, int digits, double scale = 1.0) {
    return value && std::isfinite(*value) ? fmt::format("{:>{}.{}f}", *value * scale, width, digits)
                                          : fmt::format("{:>{}}", "", width);
}

bool known(double value) {
    return std::isfinite(value);
}

/// "label     text" when there is something to say.
void add(std::vector<std::string>& lines, const Emphasis& bold, const std::string& label,
         const std::string& text) {
    if (!text.empty()) {
        lines.push_back(bold(fmt::format("{:<11}", label)) + text);
    }
}

std::string true_end_text(const FlightResult& result) {
    const double off_m = result.metrics.off_place_m;
    const auto words = [&]() -> std::string {
        switch (result.true_end) {
            case TrueEnd::on_wall: return "on the wall, sealed";
            case TrueEnd::hovering:
                return fmt::format("hovers where it belongs, {:.2f} m off", off_m);
            case TrueEnd::adrift:
                return fmt::format("hovers {:.2f} m from where it belongs", off_m);
            case TrueEnd::standing: return "stands on the ground";
            case TrueEnd::fallen: return "fell, or hit something";
            case TrueEnd::moving:
                return fmt::format("still moves, {:.2f} m from where it belongs", off_m);
            case TrueEnd::mounted: return "";
        }
        throw InternalError("true end out of range");
    };
    return words() + (bears_out(result.true_end, result.outcome)
                          ? ""
                          : fmt::format(": not {}", to_string(result.outcome)));
}

std::string impact_text(const Metrics& m) {
    return known(m.impact_speed_m_s) && known(m.impact_force_N)
               ? fmt::format(
                     "{:.2f} m/s, {:.1f} N through the slider, {:.1f} N at the lip; {:.2f} deg off "
                     "the normal at the start of the approach",
                     m.impact_speed_m_s, m.impact_force_N, m.cup_press_max_N,
                     m.alignment_at_approach_deg)
               : "";
}

std::string seal_text(const Metrics& m) {
    std::string text;
    if (known(m.time_to_land_pressure_s)) {
        text += fmt::format("P_land after {:.3f} s, ", m.time_to_land_pressure_s);
    }
    if (known(m.pressure_at_hold_end_Pa)) {
        text += fmt::format("{:.0f} hPa at the end of the hold, lowest {:.0f} hPa",
                            m.pressure_at_hold_end_Pa / 100.0, m.pressure_min_Pa / 100.0);
    }
    return text;
}

/// Of the last docking run: where the cup attached, and how it came off before it was to.
struct CameOff {
    const Event* attached = nullptr;
    const Event* lost = nullptr;
    int times = 0;  ///< in all runs
};
CameOff came_off(const FlightResult& result) {
    CameOff found;
    const Event* attached = nullptr;
    for (const Event& event : result.events) {
        if (event.name == EventName::approach_started) {
            found.attached = found.lost = attached = nullptr;
        } else if (event.name == EventName::attached) {
            attached = &event;
        } else if (event.name == EventName::contact_lost && attached != nullptr) {
            found = {attached, &event, found.times + 1};
            attached = nullptr;
        }
    }
    return found;
}

std::string came_off_text(const FlightResult& result) {
    const CameOff off = came_off(result);
    if (result.outcome != Outcome::failed_to_seal || off.lost == nullptr) {
        return "";
    }
    const auto pressure_Pa = value_of(*off.lost, "pressure_Pa");
    return fmt::format(
        "attached, and {} {:.2f} s later at {:.0f} hPa{}; limpet why finds what would "
        "hold it",
        off.lost->reason, off.lost->time_s - off.attached->time_s,
        pressure_Pa.value_or(kNaN) / 100.0,
        off.times > 1 ? fmt::format(", {} times so or alike", off.times) : "");
}

/// What the last touch required, where none has sealed.
std::string unsealed_text(const FlightResult& result) {
    const Metrics& m = result.metrics;
    if (result.outcome != Outcome::failed_to_seal || !known(m.cup_press_max_N) ||
        came_off(result).lost != nullptr) {
        return "";
    }
    std::optional<double> needed_N;
    for (const Event& event : result.events) {
        if (const auto threshold_N = value_of(event, "seal_threshold_N")) {
            needed_N = threshold_N;
        }
    }
    if (!needed_N) {
        return "";
    }
    return fmt::format(
        "the last touch, at {:.2f} m/s, pressed {:.1f} N at the lip; this spot seals {}",
        m.impact_speed_m_s, m.cup_press_max_N,
        m.cup_press_max_N < *needed_N
            ? fmt::format("above {:.1f} N: a higher guidance.dock_speed_m_s presses "
                          "harder",
                          *needed_N)
            : fmt::format("above {:.1f} N while the lip lies still and straight", *needed_N));
}

std::string perched_text(const Metrics& m) {
    return known(m.perched_pitch_deg)
               ? fmt::format("pitch {:.2f} deg", m.perched_pitch_deg) +
                     (known(m.perched_pitch_spread_deg)
                          ? fmt::format(", steady within {:.3f} deg to the end of the rest",
                                        m.perched_pitch_spread_deg)
                          : "")
               : "";
}

std::string release_text(const Metrics& m, Outcome outcome) {
    std::string text;
    if (known(m.release_s)) {
        text = fmt::format("{:.2f} s after pump off; ", m.release_s);
    } else if (known(m.pressure_at_release_end_Pa)) {
        text = fmt::format("{} {:.0f} hPa; ",
                           outcome == Outcome::release_aborted ? "given up at" : "waited until",
                           m.pressure_at_release_end_Pa / 100.0);
    }
    if (!text.empty()) {
        text += fmt::format("largest pitch while waiting {:.2f} deg", m.pitch_oscillation_max_deg);
    }
    return text;
}

void add_loads(std::vector<std::string>& lines, const Emphasis& bold, const Metrics& m) {
    if (!known(m.cup_margin_min_N)) {
        return;
    }
    add(lines, bold, "cup loads", "         pull N  shear N  peel N m  to spare N");
    for (const LoadPhase phase : kLoadPhases) {
        const CupLoads& load = m.loads[static_cast<std::size_t>(phase)];
        if (known(load.margin_N)) {
            lines.push_back(fmt::format("{:11}{:<9}{:6.1f}   {:6.1f}    {:6.2f}      {:6.1f}", "",
                                        to_string(phase), load.pull_N, load.shear_N, load.peel_N_m,
                                        load.margin_N));
        }
    }
}

}  // namespace

std::string who_text(const autopilot::AutopilotIdentity& who) {
    std::string text = who.name == "stand-in" ? "the stand-in, as PX4 " : who.name + " ";
    text += who.version + (who.git_hash.empty() ? "" : " of " + who.git_hash);
    text += who.airframe             ? fmt::format(", airframe {}", *who.airframe)
            : who.name == "stand-in" ? ""
                                     : ", airframe not reported";
    const std::string_view vehicle = who.airframe ? px4::px4_airframe_vehicle(*who.airframe) : "";
    text += vehicle.empty() ? "" : fmt::format(" of {}", vehicle);
    return text + fmt::format(", system {}", who.system);
}

std::string event_head() {
    return "  time s  event              distance m  pitch deg  force N     hPa  why";
}

std::string event_line(const Event& event) {
    if (event.name == EventName::parameter_set && event.value_count == 1) {
        return fmt::format("{:8.3f}  {:<17}  {} = {:g}", event.time_s, to_string(event.name),
                           event.values[0].name, event.values[0].value);
    }
    return fmt::format("{:8.3f}  {:<17}  {}  {}  {}  {}  {}", event.time_s, to_string(event.name),
                       cell(value_of(event, "distance_m"), 10, 2),
                       cell(value_of(event, "pitch_deg"), 9, 2),
                       cell(value_of(event, "force_N"), 7, 1),
                       cell(value_of(event, "pressure_Pa"), 6, 0, 0.01), event.reason);
}

std::vector<std::string> flight_summary(const FlightResult& result, const Emphasis& bold) {
    const Metrics& m = result.metrics;
    std::vector<std::string> lines;
    std::string outcome = bold(std::string(to_string(result.outcome))) + ": " + result.reason;
    if (result.attempts > 0) {
        outcome +=
            fmt::format(" ({} docking run{})", result.attempts, result.attempts == 1 ? "" : "s");
    }
    add(lines, bold, "outcome", outcome);
    add(lines, bold, "in truth", true_end_text(result));
    for (const std::string& fault : result.faults_not_begun) {
        add(lines, bold, "no fault", fault + " never began");
    }
    add(lines, bold, "impact", impact_text(m));
    add(lines, bold, "seal", seal_text(m));
    add(lines, bold, "came off", came_off_text(result));
    add(lines, bold, "no seal", unsealed_text(result));
    add(lines, bold, "perched", perched_text(m));
    add(lines, bold, "release", release_text(m, result.outcome));
    add_loads(lines, bold, m);
    add(lines, bold, "energy",
        fmt::format("{:.2f} Wh with the motors on, {:.3f} Wh at rest on the wall",
                    m.energy_flying_Wh, m.energy_perched_Wh));
    add(lines, bold, "speed",
        fmt::format("{:.1f} s in {:.2f} s, {:.0f} times real time, {} physics steps",
                    result.performance.simulated_s, result.performance.wall_s,
                    result.performance.real_time_factor(), result.performance.physics_steps));
    if (result.autopilot) {
        add(lines, bold, "autopilot", who_text(*result.autopilot));
    }
    add(lines, bold, "hash", hex(result.state_hash));
    return lines;
}

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
