// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <set>

#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/write_file.hpp"
#include "limpet/dossier/dossier_runs.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/paper/reproduce.hpp"
#include "limpet/plant/engines.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/model.hpp"

namespace limpet::dossier {
namespace {

namespace fs = std::filesystem;

/// A campaign of one scenario with what is changed in it, in its own folder.
struct Variant {
    std::string name;
    std::vector<std::string> overrides;
};

class DossierRuns {
public:
    DossierRuns(const DossierFile& file, const DossierOptions& options, const DossierWatch& watch)
        : file_(file), options_(options), watch_(watch) {}

    std::map<std::string, QuantityFound> fly() {
        const std::set<std::string> parts = parts_of_evidence();  // refused before anything flies
        std::map<std::string, campaign::Results> studies;
        for (const auto& [scenario, inputs] : file_.inputs) {
            studies.emplace(scenario, begin_study_of(scenario, inputs));
        }
        std::map<std::string, QuantityFound> all;
        for (auto& [scenario, results] : studies) {
            fly_scenario(scenario, results, all);
        }
        find_evidence(parts, all);
        return all;
    }

private:
    void say(const std::string& what) const {
        if (watch_.stop != nullptr && *watch_.stop) {
            throw Interrupted("interrupted");
        }
        if (watch_.on_work && !what.empty()) {
            watch_.on_work(what);
        }
    }

    /// @return the folder's path relative to the page
    [[nodiscard]] static std::string from(const std::string& name) {
        return "runs/" + name + "/" + campaign::Results::kFileName;
    }

    campaign::Results begin(const std::string& name, const std::string& text) const {
        const fs::path folder = options_.folder / "runs" / name;
        fs::remove_all(folder);
        fs::create_directories(folder);
        const fs::path file = folder / "campaign.yaml";
        std::ofstream(file) << text;
        return begin_results(campaign::load_campaign(file.string()), folder, false);
    }

    /// One flight a seed, so many.
    std::vector<campaign::RunRow> fly_seeds(const std::string& scenario,
                                            const Variant& variant) const {
        const std::string name = scenario + "_" + variant.name;
        say(name + ": " + std::to_string(seeds()) + " flights");
        std::string text =
            fmt::format("name: {}\nscenario: {}\nruns: {}\noverrides:\n", name, scenario, seeds());
        for (const std::string& one : variant.overrides) {
            text += fmt::format("  - {}\n", one);
        }
        campaign::Results results = begin(name, text);
        (void)run_campaign(results, options_.jobs, {.on_progress = {}, .stop = watch_.stop});
        say("");
        std::vector<campaign::RunRow> rows;
        for (const std::uint32_t run : results.finished_runs()) {
            rows.push_back(results.row(run));
        }
        return rows;
    }

    [[nodiscard]] std::uint32_t seeds() const { return options_.quick ? 12 : 60; }
    [[nodiscard]] std::uint32_t samples() const { return options_.quick ? 32 : 256; }

    void fly_scenario(const std::string& scenario, campaign::Results& study,
                      std::map<std::string, QuantityFound>& all) const {
        const scenario::Scenario nominal = scenario::load_scenario(scenario);
        const auto rows = fly_seeds(scenario, {"seeds", {}});
        const auto fine = fly_seeds(
            scenario,
            {"steps",
             {fmt::format("simulation.step_s={}", 0.5 * nominal.simulation.step_s),
              fmt::format("simulation.touch_step_s={}", 0.5 * nominal.simulation.touch_step_s)}});
        const std::string other = other_engine(scenario, *nominal.engine);
        std::vector<campaign::RunRow> elsewhere;
        if (!other.empty()) {
            elsewhere =
                fly_seeds(scenario, {"engine", {fmt::format("simulation.engine={}", other)}});
        }
        say(scenario + "_inputs: what the inputs do");
        (void)study::fly_study(study, options_.jobs, {.on_progress = {}, .stop = watch_.stop});
        say("");
        const auto assumed = weigh_assumptions(scenario, nominal);
        for (const Quantity& quantity : file_.quantities) {
            if (quantity.scenario != scenario) {
                continue;
            }
            QuantityFound& found = all[quantity.name];
            const study::StudyFigure figure = study::parse_figure(quantity.figure);
            found.nominal = mean_of(figure, rows, {}, from(scenario + "_seeds"));
            found.step = mean_of(figure, fine, rows, from(scenario + "_steps"));
            if (!other.empty()) {
                found.engine = mean_of(figure, elsewhere, rows, from(scenario + "_engine"));
                found.other_engine = other;
            }
            found.inputs = study::find_study(study, quantity.figure);
            found.inputs_from = from(scenario + "_inputs");
            found.assumed = assumed;
            found.assumed_from = register_of(scenario);
            bound(quantity, found);
        }
    }

    /// @return the register's path relative to the page
    [[nodiscard]] static std::string register_of(const std::string& scenario) {
        return "runs/" + scenario + "_assumptions/assumptions.json";
    }

    /// Every assumed value less and more; written beside the runs.
    [[nodiscard]] std::shared_ptr<const assumptions::Register> weigh_assumptions(
        const std::string& scenario, const scenario::Scenario& nominal) const {
        say(scenario + "_assumptions: each assumed value less and more");
        assumptions::RegisterOptions how{.seeds = {}, .jobs = options_.jobs, .stop = watch_.stop};
        const std::uint64_t seeds = options_.quick ? 2 : 8;
        for (std::uint64_t k = 0; k < seeds; ++k) {
            how.seeds.push_back(nominal.seed + k);
        }
        const auto all = std::make_shared<const assumptions::Register>(
            assumptions::weigh({to_yaml(nominal), scenario}, scenario, how));
        const fs::path file = options_.folder / register_of(scenario);
        fs::create_directories(file.parent_path());
        if (!write_file(file, register_json(*all) + "\n")) {
            throw InputError(fmt::format("cannot write {}: is the disk full?", file.string()));
        }
        say("");
        return all;
    }

    /// One that flies this vehicle in this program; empty without any.
    static std::string other_engine(const std::string& scenario, const plant::Engine& own) {
        for (const plant::Engine* engine : plant::engines()) {
            if (engine == &own) {
                continue;
            }
            scenario::LoadOptions options;
            options.overrides = {fmt::format("simulation.engine={}", engine->name)};
            try {
                (void)simulation::build_model(scenario::load_scenario(scenario, options));
                return std::string(engine->name);
            } catch (const InputError&) {  // not built in, or not for such a vehicle
            }
        }
        return "";
    }

    /// Of a scenario's inputs, checked.
    campaign::Results begin_study_of(const std::string& scenario,
                                     const std::vector<UncertainInput>& inputs) const {
        const std::string name = scenario + "_inputs";
        std::string text =
            fmt::format("name: {}\nscenario: {}\nruns: 1\nparameters:\n", name, scenario);
        for (const UncertainInput& input : inputs) {
            text += fmt::format("  {}: {}  # {}\n", input.key, input.spread, input.source);
        }
        try {
            campaign::Results results = begin(name, text);
            study::require_drawn(results.campaign());
            study::begin_study(results, {.figure = "simulated_s", .samples = samples()});
            return results;
        } catch (const InputError& error) {  // the user does not know that file
            fs::remove_all(options_.folder / "runs");
            const std::string message = error.what();
            const std::size_t key = message.find("parameters.");
            throw InputError(key == std::string::npos
                                 ? message
                                 : fmt::format("inputs.{}.{}", scenario,
                                               message.substr(key + std::strlen("parameters."))));
        }
    }

    /// @param less  the same runs' rows that are taken off, or none
    static Measured mean_of(const study::StudyFigure& figure,
                            const std::vector<campaign::RunRow>& rows,
                            const std::vector<campaign::RunRow>& less, const std::string& from) {
        std::vector<double> values;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const double value =
                figure.value(rows[k]) - (less.empty() ? 0.0 : figure.value(less[k]));
            if (std::isfinite(value)) {
                values.push_back(value);
            }
        }
        Measured measured{.flights = static_cast<std::uint32_t>(values.size()),
                          .flown = static_cast<std::uint32_t>(rows.size()),
                          .from = from};
        const auto n = static_cast<double>(values.size());
        if (values.size() < 2) {
            measured.value = measured.half_width = measured.deviation = kNaN;
            return measured;
        }
        double squares = 0.0;
        for (const double value : values) {
            measured.value += value / n;
        }
        for (const double value : values) {
            squares += (value - measured.value) * (value - measured.value);
        }
        measured.deviation = std::sqrt(squares / (n - 1.0));
        measured.half_width = statistics::kNormal95 * measured.deviation / std::sqrt(n);
        return measured;
    }

    static void bound(const Quantity& quantity, QuantityFound& found) {
        const auto far_end = [](const Measured& one) {
            return std::abs(one.value) + one.half_width;
        };
        found.numerical = far_end(found.step) + (found.engine ? far_end(*found.engine) : 0.0);
        // A flight that has no such figure, for it never released, say, is at the unsafe end.
        std::vector<double> values = found.inputs.values;
        const std::size_t flown = 2 * std::size_t{found.inputs.samples};
        const std::size_t without = flown - std::min(flown, values.size());
        const double unsafe = std::numeric_limits<double>::infinity();
        values.insert(quantity.safe_above ? values.begin() : values.end(), without,
                      quantity.safe_above ? -unsafe : unsafe);
        const auto held = tolerance_bound(values, quantity.safe_above, kShareHeld, kHeldConfidence);
        if (held && std::isfinite(*held) && std::isfinite(found.numerical)) {
            found.bound = *held + (quantity.safe_above ? -found.numerical : found.numerical);
        }
    }

    /// The parts of the reproduction that measure the paper's statements which are named.
    [[nodiscard]] std::set<std::string> parts_of_evidence() const {
        const auto statements =
            paper::load_statements(paper::statements_file(), paper::measured_names());
        std::map<std::string, std::string> part_of;  // by a statement's id
        for (const paper::PaperStatement& statement : statements) {
            for (const paper::StudyPart& part : paper::parts()) {
                if (std::find(part.measures.begin(), part.measures.end(), statement.evidence) !=
                    part.measures.end()) {
                    part_of[statement.claim.id] = part.name;
                }
            }
        }
        std::set<std::string> wanted;
        for (const Quantity& quantity : file_.quantities) {
            for (const std::string& id : quantity.evidence) {
                if (part_of.count(id) == 0) {
                    throw InputError(
                        fmt::format("dossier: quantity {}: evidence: \"{}\" is no "
                                    "statement that is measured",
                                    quantity.name, id));
                }
                wanted.insert(part_of.at(id));
            }
        }
        return wanted;
    }

    void find_evidence(const std::set<std::string>& parts,
                       std::map<std::string, QuantityFound>& all) const {
        std::map<std::string, std::pair<report::Claim, std::string>> claims;
        for (const std::string& part : parts) {
            say("the paper's statements: " + part);
            const std::string folder = "paper/" + part;
            fs::create_directories(options_.folder / folder);
            const paper::Reproduction result =
                paper::reproduce({.folder = options_.folder / folder,
                                  .only = part,
                                  .quick = options_.quick,
                                  .jobs = options_.jobs,
                                  .command = options_.command},
                                 {.on_part = {}, .on_work = watch_.on_work, .stop = watch_.stop});
            for (const report::Claim& claim : result.page.claims) {
                claims[claim.id] = {claim, folder + "/index.html#" + claim.id};
            }
        }
        for (const Quantity& quantity : file_.quantities) {
            for (const std::string& id : quantity.evidence) {
                all.at(quantity.name).evidence.push_back(claims.at(id));
            }
        }
    }

    const DossierFile& file_;
    const DossierOptions& options_;
    const DossierWatch& watch_;
};

}  // namespace

std::optional<double> tolerance_bound(const std::vector<double>& sorted, bool least, double share,
                                      double confidence) {
    const std::size_t n = sorted.size();
    // The k-th from the unsafe end is passed by more than the rest's share with the probability
    // that fewer than k of n lie there; the largest k for which that is small enough.
    const double rest = 1.0 - share;
    double below = 0.0;
    double log_term = static_cast<double>(n) * std::log(share);  // itself too small from 15,000 on
    std::size_t k = 0;
    for (; k < n; ++k) {
        below += std::exp(log_term);
        if (below > 1.0 - confidence) {
            break;
        }
        log_term +=
            std::log(static_cast<double>(n - k) / static_cast<double>(k + 1) * rest / share);
    }
    if (k == 0) {
        return std::nullopt;
    }
    return least ? sorted[k - 1] : sorted[n - k];
}

std::map<std::string, QuantityFound> fly_dossier(const DossierFile& file,
                                                 const DossierOptions& options,
                                                 const DossierWatch& watch) {
    return DossierRuns(file, options, watch).fly();
}

}  // namespace limpet::dossier
