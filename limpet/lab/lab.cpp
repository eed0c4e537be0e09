// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/lab.hpp"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/lab/request.hpp"
#include "limpet/report/view.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::lab {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kLongestFlight = std::chrono::seconds(20);  ///< of wall time

scenario::Scenario load(const FlightRequest& asked) {
    return scenario::load_scenario(asked.scenario, {.overrides = asked.changes});
}

nlohmann::json names_json(const std::vector<scenario::CatalogueEntry>& entries) {
    nlohmann::json names = nlohmann::json::array();
    for (const scenario::CatalogueEntry& entry : entries) {
        names.push_back({{"name", entry.name}, {"description", entry.description}});
    }
    return names;
}

std::string key_of(const scenario::Section& section, std::string_view name) {
    return section.name + "." + std::string(name);
}

nlohmann::json row_json(const scenario::Section& section, const BoundParameter& row) {
    return {{"key", key_of(section, row.name)},
            {"unit", row.unit},
            {"minimum", row.minimum},
            {"maximum", row.maximum},
            {"value", row.value.get()},
            {"kind", row.value.is_switch()  ? "switch"
                     : row.value.is_count() ? "count"
                                            : "number"},
            {"what", row.description},
            {"source", row.source}};
}

nlohmann::json choice_json(const scenario::Section& section, const scenario::Choice& choice) {
    return {{"key", key_of(section, choice.key)},
            {"names", names_json(choice.names)},
            {"chosen", choice.names[choice.chosen].name}};
}

/// Sections with rows and choices (Lab::schema()).
nlohmann::json schema_of(scenario::Scenario scenario) {
    nlohmann::json sections = nlohmann::json::array();
    for (const scenario::Section& section : scenario_sections(scenario)) {
        nlohmann::json rows = nlohmann::json::array(), choices = nlohmann::json::array();
        for (const BoundParameter& row : section.rows) {
            rows.push_back(row_json(section, row));
        }
        for (const scenario::Choice& choice : section.choices) {
            choices.push_back(choice_json(section, choice));
        }
        sections.push_back({{"name", section.name}, {"rows", rows}, {"choices", choices}});
    }
    return {{"sections", sections}};
}

/// The page of recordings with a place for the lab in it, which may ask this server, and flights
/// that are flying on this machine.
std::string page_html() {
    std::string page(report::view_page());
    const auto put = [&page](std::string_view place, std::string_view text) {
        const std::size_t at = page.find(place);
        require(at != std::string::npos, "a page with a place for the lab");
        page.replace(at, place.size(), text);
    };
    put("<!--PANEL-->", "<aside id=\"lab\" aria-label=\"Parameters\"></aside>");
    put("connect-src data:", "connect-src 'self' data: ws://127.0.0.1:* ws://localhost:*");
    return page;
}

serve::Response json_answer(std::string body) {
    return {.content_type = "application/json", .body = std::move(body)};
}

serve::Response recording_answer(std::string bytes) {
    return {.content_type = "application/octet-stream", .body = std::move(bytes)};
}

}  // namespace

Lab::Lab(std::string scenario, const std::atomic<bool>* stop, fs::path keep)
    : first_(std::move(scenario)),
      stop_(stop),
      learn_(first_),
      swing_(first_),
      many_(first_, scratch_.path() / "many", std::move(keep)) {
    (void)report::view_page();
    (void)scenario::load_scenario(first_);
}

std::string Lab::catalogue() const {
    const fs::path root = scenario::data_root();
    return nlohmann::json{{"scenario", first_},
                          {"scenarios", names_json(scenario::list_files(root / "scenarios"))},
                          {"surfaces", names_json(scenario::list_surfaces(root))},
                          {"vehicles", names_json(scenario::list_files(root / "vehicles"))},
                          {"campaigns", names_json(scenario::list_files(root / "campaigns"))}}
        .dump();
}

std::string Lab::schema(std::string_view request) const {
    const scenario::Scenario scenario = load(flight_request_in(object_in(request), first_));
    nlohmann::json answer = schema_of(scenario);
    answer["surface"] = scenario.wall.present ? scenario.wall.surface.name : "";
    answer["seed"] = scenario.seed;
    return answer.dump();
}

std::string Lab::fly(std::string_view request) {
    const FlightRequest asked = flight_request_in(object_in(request), first_);
    const auto model = simulation::build_model(load(asked));
    const fs::path recording = scratch_.path() / "flight.mcap";
    std::atomic<bool> enough = false;
    const simulation::FlightWatch watch{
        .on_event = {}, .on_progress = [&, end = Clock::now() + kLongestFlight](double, auto) {
            enough = Clock::now() > end || (stop_ && *stop_);
        }};
    (void)simulation::fly(
        model, recording, watch, 0,
        {.stop = &enough, .brief = asked.brief, .topics = asked.topics, .compress = false});
    return taken(recording);
}

std::string Lab::yaml(std::string_view request) const {
    return to_yaml(load(flight_request_in(object_in(request), first_)));
}

void Lab::serve_on(serve::Server& server) {
    server.get("/", [](const serve::Request&) {
        return serve::Response{.content_type = "text/html; charset=utf-8",
                               .body = page_html(),
                               .headers = {{"Cache-Control", "no-store"}}};
    });
    const auto get = [&server](const char* path, auto answer) {
        server.get(path, [answer](const serve::Request&) { return json_answer(answer()); });
    };
    const auto post = [&server](const char* path, auto answer) {
        server.post(path, [answer](const serve::Request& asked) {
            return json_answer(answer(asked.body));
        });
    };
    get("/catalogue", [this] { return catalogue(); });
    post("/schema", [this](std::string_view request) { return schema(request); });
    server.post("/yaml", [this](const serve::Request& asked) {
        return serve::Response{.content_type = "application/yaml", .body = yaml(asked.body)};
    });
    server.post("/fly", [this](const serve::Request& asked) {
        const auto begun = Clock::now();
        serve::Response answer = recording_answer(fly(asked.body));
        const std::chrono::duration<double, std::milli> took = Clock::now() - begun;
        answer.headers.emplace_back("Server-Timing",
                                    fmt::format("flight;dur={:.2f}", took.count()));
        return answer;
    });
    post("/many/begin", [this](std::string_view request) {
        many_.begin(request);
        return many_.rows("{}");
    });
    post("/many/rows", [this](std::string_view request) { return many_.rows(request); });
    server.post("/many/flight", [this](const serve::Request& asked) {
        return recording_answer(many_.flight(asked.body));
    });
    get("/learn", [this] { return learn_.state(); });
    post("/learn/begin", [this](std::string_view request) {
        learn_.begin(request);
        return learn_.state();
    });
    get("/swing", [this] { return swing_.state(); });
    post("/swing/begin", [this](std::string_view request) {
        swing_.begin(request);
        return swing_.state();
    });
    const auto stop = [&post](const char* path, auto& work) {
        post(path, [&work](std::string_view) {
            work.stop();
            return std::string("{}");
        });
    };
    stop("/many/stop", many_);
    stop("/learn/stop", learn_);
    stop("/swing/stop", swing_);
}

}  // namespace limpet::lab
