// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/lab.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/lab/request.hpp"
#include "limpet/lab/schema.hpp"
#include "limpet/report/view.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::lab {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kLongestFlight = std::chrono::seconds(20);  ///< of wall time

scenario::Scenario load(const Asked& asked) {
    return scenario::load_scenario(asked.scenario, {.overrides = asked.changes});
}

nlohmann::json names_json(const std::vector<scenario::CatalogueEntry>& entries) {
    nlohmann::json names = nlohmann::json::array();
    for (const scenario::CatalogueEntry& entry : entries) {
        names.push_back({{"name", entry.name}, {"description", entry.description}});
    }
    return names;
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
    : first_(std::move(scenario)), stop_(stop) {
    (void)report::view_page();
    (void)scenario::load_scenario(first_);
    std::string folder = (fs::temp_directory_path() / "limpet_lab_XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) {
        throw InputError("cannot make " + folder);
    }
    scratch_ = folder;
    learn_ = std::make_unique<Learn>(first_);
    swing_ = std::make_unique<Swing>(first_);
    many_ = std::make_unique<Many>(first_, scratch_ / "many", std::move(keep));
}

Lab::~Lab() {
    many_.reset();
    std::error_code ignored;
    fs::remove_all(scratch_, ignored);
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
    const scenario::Scenario scenario = load(asked_in(object_in(request), first_));
    nlohmann::json answer = schema_of(scenario);
    answer["surface"] = scenario.wall.present ? scenario.wall.surface.name : "";
    answer["seed"] = scenario.seed;
    return answer.dump();
}

std::string Lab::fly(std::string_view request) {
    const Asked asked = asked_in(object_in(request), first_);
    const auto model = simulation::build_model(load(asked));
    const fs::path recording = scratch_ / "flight.mcap";
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
    return to_yaml(load(asked_in(object_in(request), first_)));
}

void Lab::serve_on(serve::Server& server) {
    server.get("/", [](const serve::Request&) {
        return serve::Response{.content_type = "text/html; charset=utf-8",
                               .body = page_html(),
                               .headers = {{"Cache-Control", "no-store"}}};
    });
    server.get("/catalogue", [this](const serve::Request&) { return json_answer(catalogue()); });
    server.post("/schema",
                [this](const serve::Request& asked) { return json_answer(schema(asked.body)); });
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
    server.post("/many/begin", [this](const serve::Request& asked) {
        many_->begin(asked.body);
        return json_answer(many_->rows("{}"));
    });
    server.post("/many/stop", [this](const serve::Request&) {
        many_->stop();
        return json_answer("{}");
    });
    server.post("/many/rows", [this](const serve::Request& asked) {
        return json_answer(many_->rows(asked.body));
    });
    server.post("/learn/begin", [this](const serve::Request& asked) {
        learn_->begin(asked.body);
        return json_answer(learn_->state());
    });
    server.post("/learn/stop", [this](const serve::Request&) {
        learn_->stop();
        return json_answer("{}");
    });
    server.get("/learn", [this](const serve::Request&) { return json_answer(learn_->state()); });
    server.post("/swing/begin", [this](const serve::Request& asked) {
        swing_->begin(asked.body);
        return json_answer(swing_->state());
    });
    server.post("/swing/stop", [this](const serve::Request&) {
        swing_->stop();
        return json_answer("{}");
    });
    server.get("/swing", [this](const serve::Request&) { return json_answer(swing_->state()); });
    server.post("/many/flight", [this](const serve::Request& asked) {
        return recording_answer(many_->flight(asked.body));
    });
}

}  // namespace limpet::lab
