// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/many.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <new>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/lab/request.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/statistics/shares.hpp"

namespace limpet::lab {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uint32_t kMostRuns = 20'000;  ///< rows stay in memory, here and in the page
constexpr std::size_t kMostRowsAtOnce = 5000;

/// A campaign's file (data/campaigns/README.md) in JSON, which is YAML: the scenario over a grid.
nlohmann::ordered_json file_text(const json& request, FlightRequest asked) {
    const scenario::Scenario scenario =
        scenario::load_scenario(asked.scenario, {.overrides = asked.changes});
    std::erase_if(asked.changes, [](const std::string& text) { return text.starts_with("seed="); });
    nlohmann::ordered_json file{{"name", "lab"},
                                {"description", "from the lab"},
                                {"scenario", asked.scenario},
                                {"overrides", asked.changes},
                                {"seed", scenario.seed}};
    nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
    for (const json& axis : request.at("axes")) {
        parameters[axis.at("key").get<std::string>()]["range"] = {
            {"from", axis.at("from").get<double>()},
            {"to", axis.at("to").get<double>()},
            {"count", whole_in(axis, "count", 1, kMostRuns)}};
    }
    file[parameters.empty() ? "runs" : "repeats"] = whole_in(request, "repeats", 1, kMostRuns, 1);
    file["parameters"] = parameters;
    return file;
}

json value_json(const campaign::SampledValue& value) {
    return std::visit([](const auto& v) { return json(v); }, value);
}

json row_json(const campaign::RunRow& row, bool success) {
    json values = json::array(), metrics = json::array();
    for (const campaign::SampledValue& value : row.sample) {
        values.push_back(value_json(value));
    }
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        metrics.push_back(row.metrics.*metric.field);  // null where it did not come to pass
    }
    return {{"run", row.run},           {"outcome", row.outcome}, {"reason", row.reason},
            {"true_end", row.true_end}, {"success", success},     {"values", values},
            {"metrics", metrics}};
}

json keys_json(const campaign::Campaign& campaign) {
    json keys = json::array();
    for (const campaign::VariedKey& key : campaign.keys) {
        json values = json::array();
        for (const campaign::SampledValue& value : key.values) {
            values.push_back(value_json(value));
        }
        keys.push_back({{"key", key.key}, {"values", values}});
    }
    return keys;
}

}  // namespace

Many::Many(std::string scenario, fs::path scratch, fs::path keep)
    : first_(std::move(scenario)), scratch_(std::move(scratch)), keep_(std::move(keep)) {}

Many::~Many() {
    stop();
}

campaign::Campaign Many::campaign_in(std::string_view request) const {
    const json asked = object_in(request);
    try {
        if (asked.contains("campaign")) {
            const std::string name = asked.at("campaign");
            if (scenario::is_path(name)) {
                throw InputError("\"campaign\": a name, not a path");
            }
            return campaign::load_campaign(name);
        }
        const fs::path file = scratch_ / "lab.yaml";
        fs::create_directories(scratch_);
        std::ofstream(file) << file_text(asked, flight_request_in(asked, first_)).dump(1);
        try {
            return campaign::load_campaign(file.string());
        } catch (const InputError& error) {  // the user does not know that file
            const std::string message = error.what();
            const std::string place = scenario::shown_path(file) + ":";
            const std::size_t end = message.find(": ", place.size());
            throw InputError(message.starts_with(place) && end != std::string::npos
                                 ? message.substr(end + 2)
                                 : message);
        }
    } catch (const json::exception&) {
        throw InputError(
            "\"campaign\" is a text; or \"axes\" a list of {\"key\", \"from\", \"to\", "
            "\"count\"} and \"repeats\" a count");
    }
}

fs::path Many::place_for(const campaign::Campaign& campaign) const {
    if (keep_.empty()) {
        fs::remove_all(scratch_);
        return scratch_;
    }
    fs::path folder = keep_ / campaign.name;
    for (int n = 2; is_there(folder); ++n) {
        folder = keep_ / fmt::format("{}_{}", campaign.name, n);
    }
    return folder;
}

void Many::begin(std::string_view request) {
    const campaign::Campaign campaign = campaign_in(request);
    if (campaign.runs > kMostRuns) {
        throw InputError(fmt::format("{} runs, the lab flies at most {}; more: limpet campaign",
                                     campaign.runs, kMostRuns));
    }
    stop();
    thread_ = {};  // what is in the air lands
    results_.reset();
    folder_ = place_for(campaign);
    fs::create_directories(folder_);
    results_ = std::make_unique<campaign::Results>(begin_results(campaign, folder_, false));
    ++id_;
    landed_.clear();
    progress_ = {};
    problem_.clear();
    stop_ = false;
    thread_ = begin_thread(running_, [this] {
        // One processor is the page's.
        const int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
        try {
            (void)run_campaign(*results_, jobs,
                               {.on_progress =
                                    [this](const campaign::Progress& progress) {
                                        const std::lock_guard lock(guards_landed_);
                                        progress_ = progress;
                                    },
                                .stop = &stop_,
                                .on_row =
                                    [this](const campaign::RunRow& row) {
                                        const std::lock_guard lock(guards_landed_);
                                        landed_.push_back(row);
                                    }});
        } catch (const std::bad_alloc&) {
            const std::lock_guard lock(guards_landed_);
            problem_ = "not enough memory";
        } catch (const std::exception& error) {
            const std::lock_guard lock(guards_landed_);
            problem_ = error.what();
        }
        running_ = false;
    });
}

std::string Many::rows(std::string_view request) {
    const json asked = object_in(request);
    const auto& wanted = asked.contains("from") ? asked["from"] : json(0U);
    if (!wanted.is_number_unsigned()) {
        throw InputError("\"from\" is a count");
    }
    if (results_ == nullptr) {
        return json{{"id", 0}, {"running", false}, {"rows", json::array()}}.dump();
    }
    const bool running = running_;  // before the rows: none is missed when it has ended
    const campaign::Campaign& campaign = results_->campaign();
    const std::lock_guard lock(guards_landed_);
    statistics::Proportion success{.runs = static_cast<std::uint32_t>(landed_.size())};
    json rows = json::array();
    const auto from = wanted.get<std::size_t>();
    for (std::size_t i = 0; i < landed_.size(); ++i) {
        const bool succeeded = campaign::is_success(campaign, landed_[i]);
        success.successes += succeeded ? 1U : 0U;
        if (i >= from && rows.size() < kMostRowsAtOnce) {
            rows.push_back(row_json(landed_[i], succeeded));
        }
    }
    json outcomes = json::array(), metrics = json::array();
    for (const Outcome outcome : campaign.success) {
        outcomes.push_back(to_string(outcome));
    }
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        metrics.push_back(metric.name);
    }
    const statistics::Interval interval = success.interval();
    return json{{"id", id_},
                {"name", campaign.name},
                {"scenario", campaign.scenario_name},
                {"runs", campaign.runs},
                {"finished", landed_.size()},
                {"running", running},
                {"left_s", progress_.left_s()},
                {"problem", problem_},
                {"folder", keep_.empty() ? "" : folder_.string()},
                {"keys", keys_json(campaign)},
                {"metrics", metrics},
                {"points", grid_points(campaign.keys)},
                {"success",
                 {{"runs", success.successes},
                  {"outcomes", outcomes},
                  {"low", interval.low},
                  {"high", interval.high}}},
                {"rows", rows}}
        .dump();
}

std::string Many::flight(std::string_view request) {
    const json asked = object_in(request);
    constexpr std::uint32_t kMostIds = 1'000'000'000;
    const std::uint32_t run = whole_in(asked, "run", 0, kMostRuns);
    if (results_ == nullptr || whole_in(asked, "id", 0, kMostIds) != id_) {
        throw InputError("that campaign is gone, another one has begun");
    }
    // Its own view of the file: the workers write meanwhile.
    campaign::Results results(campaign::Results::file_of(folder_), campaign::Access::read);
    const fs::path recording = folder_ / "run.mcap";
    (void)replay_run(results, run, recording);
    return taken(recording);
}

}  // namespace limpet::lab
