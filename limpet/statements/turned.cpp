// SPDX-License-Identifier: Apache-2.0
#include "limpet/statements/turned.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "limpet/assumptions/assumptions.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/core/write_file.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::statements {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Statements that are judged by such evidence and are not just what the configuration says.
std::vector<const PaperStatement*> judged_by(const Study& study,
                                             const std::vector<std::string>& evidence) {
    std::vector<const PaperStatement*> found;
    for (const PaperStatement& statement : study.statements) {
        if (statement.claim.basis != "as set" &&
            std::find(evidence.begin(), evidence.end(), statement.evidence) != evidence.end()) {
            found.push_back(&statement);
        }
    }
    return found;
}

/// Numbers by name; no value is null.
Json values_of(const Evidence& evidence, const std::set<std::string>& names) {
    Json values = Json::object();
    for (const std::string& name : names) {
        if (evidence.has(name)) {
            const double value = evidence.get(name);
            values[name] = std::isfinite(value) ? Json(value) : Json();
        }
    }
    return values;
}

/// What has been measured with one value turned; null: it does not go with the others.
using Measured = std::pair<Turn, Json>;

/// The file of an experiment.
class Kept {
public:
    /// @param of  the experiment: what a file of another differs by
    Kept(fs::path file, Json of) : file_(std::move(file)), of_(std::move(of)) {
        std::ifstream from(file_);
        const Json json = Json::parse(from, nullptr, false);
        if (!json.is_object() || json.value("of", Json()) != of_) {
            return;  // of another experiment, or none
        }
        for (const Json& one : json.value("turned", Json::array())) {
            all_.push_back({{one.at("key"), one.at("more")}, one.at("evidence")});
        }
    }

    [[nodiscard]] const Json* find(const Turn& turn) const {
        const auto found = std::find_if(all_.begin(), all_.end(),
                                        [&turn](const Measured& one) { return one.first == turn; });
        return found == all_.end() ? nullptr : &found->second;
    }

    void add(const std::vector<Measured>& more) {
        all_.insert(all_.end(), more.begin(), more.end());
        Json turned = Json::array();
        for (const Measured& one : all_) {
            turned.push_back(
                {{"key", one.first.key}, {"more", one.first.more}, {"evidence", one.second}});
        }
        const Json json = {{"of", of_}, {"turned", std::move(turned)}};
        fs::create_directories(file_.parent_path());
        if (!write_file(file_, json.dump(1) + "\n")) {
            throw InputError(fmt::format("cannot write {}: is the disk full?", file_.string()));
        }
    }

private:
    fs::path file_;
    Json of_;
    std::vector<Measured> all_;
};

}  // namespace

std::string to_text(const Turn& turn) {
    return fmt::format("`{}` {:.0f} % {}", turn.key, 100.0 * kTurnedBy,
                       turn.more ? "more" : "less");
}

std::vector<Turn> turns_of(const std::vector<scenario::Scenario>& scenarios) {
    std::vector<Turn> turns;
    std::set<std::string> seen;
    for (const scenario::Scenario& scenario : scenarios) {
        for (const assumptions::Assumption& one : assumptions::assumed(scenario, kTurnedBy)) {
            if (seen.insert(one.key).second) {
                turns.push_back({one.key, false});
                turns.push_back({one.key, true});
            }
        }
    }
    return turns;
}

std::vector<Turn> turns_named(const Study& study, const std::vector<std::string>& evidence) {
    std::vector<Turn> turns;
    std::set<std::string> seen;
    for (const PaperStatement* statement : judged_by(study, evidence)) {
        for (const std::string& key : statement->claim.assumes) {
            if (seen.insert(key).second) {
                turns.push_back({key, false});
                turns.push_back({key, true});
            }
        }
    }
    return turns;
}

std::optional<std::string> override_of(const Turn& turn, const scenario::Scenario& scenario) {
    for (const assumptions::Assumption& one : assumptions::turnable(scenario, kTurnedBy)) {
        if (one.key == turn.key && !one.source.starts_with("paper")) {
            for (const double to : one.neighbours) {
                if ((std::abs(to) > std::abs(one.value)) == turn.more) {
                    return fmt::format("{}={}", one.key, scenario::number_text(to));
                }
            }
        }
    }
    return std::nullopt;
}

void do_again(Study& study, const TurnedExperiment& experiment) {
    std::set<std::string> names;
    for (const PaperStatement* statement : judged_by(study, experiment.evidence)) {
        names.insert(statement->evidence);
    }
    std::vector<Turn> turns = turns_named(study, experiment.evidence);
    if (!study.quick) {
        std::copy_if(experiment.turns.begin(), experiment.turns.end(), std::back_inserter(turns),
                     [named = turns](const Turn& turn) {
                         return std::find(named.begin(), named.end(), turn) == named.end();
                     });
    }
    Kept kept(study.folder / "assumptions" / (experiment.name + "_turned.json"),
              {{"turned_by", kTurnedBy},
               {"quick", study.quick},
               {"as_it_is", values_of(study.evidence, names)}});
    std::vector<Turn> missing;
    std::copy_if(turns.begin(), turns.end(), std::back_inserter(missing),
                 [&kept](const Turn& turn) { return kept.find(turn) == nullptr; });
    constexpr std::size_t kParts = 8;  // reports of progress, and writes
    const std::size_t part = std::max<std::size_t>(1, (missing.size() + kParts - 1) / kParts);
    for (std::size_t from = 0; from < missing.size(); from += part) {
        study.say(fmt::format("{}, assumed values turned: {} of {}", experiment.name,
                              turns.size() - missing.size() + from, turns.size()));
        std::vector<Measured> measured(std::min(part, missing.size() - from));
        for_each_index(measured.size(), study.jobs, [&](std::size_t i) {
            study.say("");
            measured[i].first = missing[from + i];
            try {
                measured[i].second = values_of(experiment.measure(measured[i].first), names);
            } catch (const InputError&) {  // the value does not go with the others
            }
        });
        kept.add(measured);
    }
    for (const Turn& turn : turns) {
        for (const auto& [name, value] : kept.find(turn)->items()) {
            study.turned[name].push_back(
                {to_text(turn), value.is_null() ? kNaN : value.get<double>()});
        }
    }
}

}  // namespace limpet::statements
