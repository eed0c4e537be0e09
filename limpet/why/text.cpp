// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "limpet/record/story.hpp"
#include "limpet/why/why.hpp"

namespace limpet::why {
namespace {

std::string ending(const Trial& trial) {
    return fmt::format("{}: {}", told_with_truth(trial.result.outcome, trial.result.true_end),
                       trial.result.reason);
}

std::string change_text(const Change& change) {
    if (change.is_switch) {
        return fmt::format("{} = {}", change.key, change.to != 0.0 ? "true" : "false");
    }
    return fmt::format("{} {:.4g} -> {:.4g} {}", change.key, change.from, change.to, change.unit);
}

std::string changes_text(const std::vector<Change>& changes) {
    std::string text;
    for (const Change& change : changes) {
        text += (text.empty() ? "" : ", ") + change_text(change);
    }
    return text;
}

/// The least margin, where the cup ever held.
std::string margin_text(const char* before, const Trial& trial) {
    const double margin_N = trial.result.metrics.cup_margin_min_N;
    return std::isfinite(margin_N) ? fmt::format("{}least margin {:.1f} N", before, margin_N) : "";
}

/// A whole number, 0 without a sign.
double whole(double value) {
    return std::round(value) + 0.0;
}

/// "0.11 s attached, holding, pitch to -2 deg"
std::string held_text(const Hold& hold, double end_s) {
    std::string text = fmt::format("sealed at {:.2f} s, down to {:.0f} hPa", hold.sealed_s,
                                   hold.pressure_Pa / 100.0);
    if (std::isnan(hold.attached_s)) {
        text += ", not below the attachment threshold";
    }
    text += fmt::format(", held {:.2f} s, pitch to {:.0f} deg", hold.held_s(end_s),
                        whole(hold.pitch_deg));
    if (std::isnan(hold.ended_s)) {
        return text + "; holds at the end";
    }
    return text + fmt::format("; {}{} while {}", hold.on_purpose ? "let go on purpose, " : "",
                              hold.let_go.empty() ? "let go" : hold.let_go,
                              record::words(hold.phase));
}

/// What was at its limit, and where a peeling moment came from.
void add_loads(std::string& text, const Hold& hold) {
    const LipLoads& loads = hold.loads;
    fmt::format_to(
        std::back_inserter(text),
        "           at that moment pull {:.1f} of at most {:.1f} N, shear {:.1f} of {:.1f} "
        "N, peel {:.3f} of {:.3f} N m\n",
        loads.pull_N, loads.pull_most_N, loads.shear_N, loads.shear_most_N, loads.peel_N_m,
        loads.peel_most_N_m);
    if (hold.let_go != "peeled off") {
        return;
    }
    const PeelSources& peel = hold.peel;
    fmt::format_to(
        std::back_inserter(text),
        "           the moment comes from the joint's centring spring {:.3f} N m (bent {:.0f} "
        "deg), its damper {:.3f}, the shear\n"
        "           at lip_offset_m {:.3f}; what is borne is (vacuum - pull) radius / 2\n",
        peel.spring_N_m, peel.bent_deg, peel.damper_N_m, peel.lever_N_m);
}

std::string how_far(const Trial& trial) {
    const Hold* hold = decisive_hold(trial);
    std::string text = ending(trial);
    if (trial.stage < Stage::rested && hold != nullptr) {
        text += fmt::format("; {} after {:.2f} s at {:.0f} deg",
                            hold->let_go.empty() ? "holds" : hold->let_go,
                            hold->held_s(trial.simulated_s), whole(hold->pitch_deg));
    } else if (trial.stage >= Stage::rested) {
        text += margin_text("; ", trial);
    }
    return text;
}

void add_holds(std::string& text, const Trial& base) {
    constexpr std::size_t kMost = 6;
    for (std::size_t i = 0; i < std::min(kMost, base.holds.size()); ++i) {
        fmt::format_to(std::back_inserter(text), "{:<11}{}\n", i == 0 ? "seals" : "",
                       held_text(base.holds[i], base.simulated_s));
    }
    if (base.holds.size() > kMost) {
        fmt::format_to(std::back_inserter(text), "{:<11}and {} more\n", "",
                       base.holds.size() - kMost);
    }
    if (const Hold* hold = decisive_hold(base); hold != nullptr && !std::isnan(hold->ended_s)) {
        add_loads(text, *hold);
    }
}

void add_command(std::string& text, const Trial& trial, const std::string& wanted) {
    text += "           limpet fly " + wanted;
    for (const Change& change : trial.changes) {
        text += " --set " + change.override_text();
    }
    text += '\n';
}

void add_remedy(std::string& text, const Found& found, const std::string& wanted) {
    if (found.remedy.changes.empty()) {
        text +=
            "nothing    that can be set, within a third and three times of what it is, brings it "
            "further\n";
        return;
    }
    fmt::format_to(std::back_inserter(text), "\n{:<11}{}\n           {}\n",
                   !found.mended                     ? "furthest"
                   : found.remedy.changes.size() > 1 ? "together"
                                                     : "alone",
                   changes_text(found.remedy.changes), how_far(found.remedy));
    add_command(text, found.remedy, wanted);
    if (!found.mended) {
        text += "           nothing within a third and three times mends it, alone or in pairs\n";
    }
    if (!found.and_then.changes.empty()) {
        fmt::format_to(std::back_inserter(text), "{:<11}{}\n           {}\n", "and then",
                       change_text(found.and_then.changes.back()), how_far(found.and_then));
    }
    for (const Trial& other : found.others) {
        fmt::format_to(std::back_inserter(text), "{:<11}{}\n           {}\n", "or",
                       changes_text(other.changes), how_far(other));
    }
}

}  // namespace

std::string why_text(const Found& found, const std::string& wanted) {
    std::string text = fmt::format("{:<11}{}, seed {}: {}\n", "flight", found.scenario, found.seed,
                                   ending(found.base));
    add_holds(text, found.base);
    if (found.base.stage == Stage::done) {
        return text + fmt::format("{:<11}a success{}\n", "why", margin_text(": ", found.base));
    }
    add_remedy(text, found, wanted);
    if (!found.keys.empty()) {
        text += "\nkeys that help most, each flown by itself\n";
        for (const HelpfulKey& key : found.keys) {
            fmt::format_to(std::back_inserter(text), "  {}\n           {}\n",
                           change_text(key.change), how_far(key.alone));
        }
    }
    if (!found.parts.empty()) {
        text += "\nwhat would do alone, built otherwise\n";
        for (const HelpfulKey& part : found.parts) {
            fmt::format_to(std::back_inserter(text), "  {}\n           {}\n",
                           change_text(part.change), how_far(part.alone));
        }
    }
    if (!found.faults.empty()) {
        fmt::format_to(std::back_inserter(text),
                       "\n{:<11}{} flights, which count as not flown; the first: {}\n", "faults",
                       found.faults.size(), found.faults.front());
    }
    fmt::format_to(std::back_inserter(text), "\n{:<11}{} flown in {:.1f} s, {:.0f} a second\n",
                   "flights", found.flights, found.wall_s,
                   static_cast<double>(found.flights) / std::max(found.wall_s, 1e-3));
    return text;
}

}  // namespace limpet::why
