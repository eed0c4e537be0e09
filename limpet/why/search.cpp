// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/words.hpp"
#include "limpet/why/why.hpp"

namespace limpet::why {
namespace {

constexpr std::size_t kSeeds = 3;  ///< single keys with which all others are tried
constexpr std::size_t kMostKeys = 3;
constexpr std::size_t kMostOthers = 3;
constexpr double kHelps = 0.05;  ///< of a stage: less is noise
constexpr int kHalvings = 3;

class Search {
public:
    Search(const scenario::ScenarioText& text, const SearchOptions& options)
        : text_(text), options_(options) {}

    [[nodiscard]] Found run();

private:
    using Changes = std::vector<Change>;

    [[nodiscard]] Trial whole(const Changes& changes, HoldTrace* trace = nullptr) {
        ++found_.flights;
        Trial trial = fly_trial(
            text_, changes, {.traces = trace != nullptr, .trace = trace, .stop = options_.stop});
        if (options_.stop != nullptr && *options_.stop) {
            throw Interrupted("interrupted; nothing was written");
        }
        note_fault(trial);
        return trial;
    }
    void note_fault(const Trial& trial) {
        if (!trial.fault.empty()) {
            found_.faults.push_back(trial.fault);
        }
    }
    /// Each of `turned` together with `with`, the best of each key, furthest first; keys that help
    /// alone.
    [[nodiscard]] std::vector<Trial> screen(const std::vector<Change>& turned, const Changes& with,
                                            const Trial& before);
    [[nodiscard]] bool reaches(const Trial& trial) const {
        return trial.flown && trial.stage >= found_.goal;
    }
    [[nodiscard]] bool helps(const Trial& trial, const Trial& before) const {
        return trial.flown && (trial.stage > before.stage ||
                               (trial.stage == before.stage && trial.stage < Stage::rested &&
                                trial.share > before.share + kHelps));
    }
    void tell(const std::string& what) const {
        if (options_.tell) {
            options_.tell(what);
        }
    }
    void seek_remedy(const std::vector<Trial>& singles);
    void go_on(Trial best);
    [[nodiscard]] Trial milder(Trial trial);
    void fill_keys(const std::vector<Trial>& singles);
    void fill_others(std::vector<Trial> mending);
    void fill_parts();

    const scenario::ScenarioText& text_;
    const SearchOptions& options_;
    TrialOptions screening_;
    std::vector<Change> settings_;
    Found found_;
};

std::vector<Trial> Search::screen(const std::vector<Change>& turned, const Changes& with,
                                  const Trial& before) {
    std::vector<Changes> trials;
    for (const Change& change : turned) {
        const bool taken = std::any_of(with.begin(), with.end(),
                                       [&](const Change& c) { return c.key == change.key; });
        if (!taken) {
            trials.push_back(with);
            trials.back().push_back(change);
        }
    }
    found_.flights += trials.size();
    std::map<std::string, Trial> best;
    for (Trial& trial : fly_trials(text_, std::move(trials), screening_, options_.jobs)) {
        note_fault(trial);
        if (!helps(trial, before)) {
            continue;
        }
        const auto [at, is_new] = best.try_emplace(trial.changes.back().key, trial);
        if (!is_new && further(trial, at->second)) {
            at->second = std::move(trial);
        }
    }
    std::vector<Trial> sorted;
    for (auto& [key, trial] : best) {
        sorted.push_back(std::move(trial));
    }
    std::stable_sort(sorted.begin(), sorted.end(), further);
    return sorted;
}

/// As near to the flight as it is as it may be with half of the margin: each change in turn is
/// halved towards it.
Trial Search::milder(Trial trial) {
    const double enough = 0.5 * trial.share;
    for (std::size_t i = 0; i < trial.changes.size(); ++i) {
        if (trial.changes[i].is_switch) {
            continue;
        }
        double near = trial.changes[i].from;  // does not do
        for (int k = 0; k < kHalvings; ++k) {
            Changes changes = trial.changes;
            const double to = changes[i].to;
            const double middle =
                near * to > 0.0 ? std::copysign(std::sqrt(near * to), to) : 0.5 * (near + to);
            // A person would write two digits.
            changes[i].to = number_of(fmt::format("{:.2g}", middle)).value_or(middle);
            if (changes[i].to == to || changes[i].to == near) {
                break;
            }
            Trial tried = whole(changes);
            if (reaches(tried) && tried.share >= enough) {
                trial = std::move(tried);
            } else {
                near = changes[i].to;
            }
        }
    }
    return trial;
}

void Search::go_on(Trial best) {
    found_.remedy = milder(std::move(best));
    found_.mended = true;
    found_.remedy = whole(found_.remedy.changes, &found_.remedy_trace);
    for (const Change& change : settings_) {
        if (found_.remedy.stage < Stage::done && found_.and_then.changes.empty() &&
            change.is_switch) {
            Changes changes = found_.remedy.changes;
            changes.push_back(change);
            Trial tried = whole(changes);
            if (tried.flown && tried.stage == Stage::done) {
                found_.and_then = std::move(tried);
            }
        }
    }
}

void Search::fill_others(std::vector<Trial> mending) {
    for (Trial& trial : mending) {
        if (found_.others.size() == kMostOthers) {
            return;
        }
        const auto same = [&trial](const Trial& other) {
            return std::is_permutation(
                trial.changes.begin(), trial.changes.end(), other.changes.begin(),
                other.changes.end(),
                [](const Change& a, const Change& b) { return a.key == b.key; });
        };
        if (same(found_.remedy) || std::any_of(found_.others.begin(), found_.others.end(), same)) {
            continue;
        }
        Trial flown = whole(trial.changes);
        if (reaches(flown)) {
            found_.others.push_back(std::move(flown));
        }
    }
}

/// Single keys where one does, else pairs; a screened flight is flown whole before it is believed.
void Search::seek_remedy(const std::vector<Trial>& singles) {
    std::vector<Trial> mending;
    const auto take = [&](const std::vector<Trial>& trials) {
        std::copy_if(trials.begin(), trials.end(), std::back_inserter(mending),
                     [this](const Trial& trial) { return reaches(trial); });
    };
    take(singles);
    std::vector<Trial> pairs;
    if (mending.empty()) {
        for (std::size_t i = 0; i < std::min(kSeeds, singles.size()); ++i) {
            tell(fmt::format("together with {} ...", singles[i].changes.front().override_text()));
            const auto found = screen(settings_, singles[i].changes, singles[i]);
            pairs.insert(pairs.end(), found.begin(), found.end());
        }
        std::stable_sort(pairs.begin(), pairs.end(), further);
        take(pairs);
    }
    if (mending.empty() && !pairs.empty()) {
        tell("a third with the best two ...");
        take(screen(settings_, pairs.front().changes, pairs.front()));
    }
    for (std::size_t i = 0; i < mending.size(); ++i) {
        const Trial flown = whole(mending[i].changes);
        if (reaches(flown)) {
            go_on(flown);
            mending.erase(mending.begin(), mending.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            fill_others(std::move(mending));
            return;
        }
    }
    if (const auto& far = pairs.empty() ? singles : pairs; !far.empty()) {
        found_.remedy = whole(far.front().changes, &found_.remedy_trace);
    }
}

void Search::fill_keys(const std::vector<Trial>& singles) {
    const auto add = [this](const Change& change, bool in_remedy) {
        const bool there =
            std::any_of(found_.keys.begin(), found_.keys.end(),
                        [&](const HelpfulKey& key) { return key.change.key == change.key; });
        if (!there && found_.keys.size() < kMostKeys) {
            found_.keys.push_back({change, whole({change}), in_remedy});
        }
    };
    for (const Change& change : found_.remedy.changes) {
        add(change, true);
    }
    for (const Trial& other : found_.others) {
        for (const Change& change : other.changes) {
            add(change, false);
        }
    }
    for (const Trial& single : singles) {
        if (found_.keys.size() < kMostKeys && helps(whole(single.changes), found_.base)) {
            add(single.changes.front(), false);
        }
    }
}

void Search::fill_parts() {
    tell("what is built ...");
    const auto parts = parts_turned(text_.load({}));
    for (Trial& trial : screen(parts, {}, found_.base)) {
        if (reaches(trial) && found_.parts.size() < kMostKeys) {
            Trial flown = whole(trial.changes);
            if (reaches(flown)) {
                found_.parts.push_back({trial.changes.front(), std::move(flown), false});
            }
        }
    }
}

Found Search::run() {
    const auto begin = std::chrono::steady_clock::now();
    const scenario::Scenario scenario = text_.load({});
    found_.scenario = scenario.name;
    found_.seed = scenario.seed;
    found_.base = whole({}, &found_.trace);
    if (found_.base.stage < Stage::done) {
        const bool to_rest =
            found_.base.stage < Stage::rested && scenario.mission != scenario::Mission::hover;
        found_.goal = to_rest ? Stage::rested : Stage::done;
        screening_ = {.until_rest = to_rest, .stop = options_.stop};
        settings_ = settings_turned(scenario);
        tell(fmt::format("{} settings by themselves ...", settings_.size()));
        const std::vector<Trial> singles = screen(settings_, {}, found_.base);
        seek_remedy(singles);
        fill_keys(singles);
        fill_parts();
    }
    found_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(found_);
}

}  // namespace

Found find_why(const scenario::ScenarioText& text, const SearchOptions& options) {
    return Search(text, options).run();
}

const Hold* decisive_hold(const Trial& trial) {
    const Hold* best = nullptr;
    const auto order = [](const Hold& hold) {
        const bool landing = hold.phase == "pitching_up" || hold.phase == "unloading";
        return std::pair(std::isnan(hold.attached_s) ? 0
                         : landing                   ? 2
                                                     : 1,
                         landing ? hold.pitch_deg : 0.0);
    };
    for (const Hold& hold : trial.holds) {
        if (best == nullptr || order(hold) >= order(*best)) {
            best = &hold;
        }
    }
    return best;
}

}  // namespace limpet::why
