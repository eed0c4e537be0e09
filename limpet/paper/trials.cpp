// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/trials.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include "limpet/campaign/campaign.hpp"
#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSpeedKey = "pendulum.impact_speed_m_s";

/// A moved assumption as lines of the campaign's file.
struct Move {
    std::string name;  ///< of a folder
    std::string assumption;
    std::string overrides;                                             ///< items of the list
    std::vector<std::pair<std::string, std::string>> parameters = {};  ///< that replace the file's
};

std::vector<Move> moves() {
    constexpr double kPart = 0.2, kMost_deg = 8.0;
    const scenario::Scenario nominal = scenario::load_scenario("pendulum_concrete");
    std::vector<Move> all = {{"as_assumed", "as assumed", ""}};
    const auto by_a_part = [&](const char* name, const char* words, const char* key, double value) {
        for (const auto& [suffix, sign] : {std::pair{"low", -1.0}, std::pair{"high", 1.0}}) {
            all.push_back({fmt::format("{}_{}", name, suffix),
                           fmt::format("{} {:+.0f} %", words, 100.0 * sign * kPart),
                           fmt::format("{}={}", key, value * (1.0 + sign * kPart))});
        }
    };
    by_a_part("threshold", "force that seals", "wall.surface.seal_threshold_median_N",
              nominal.wall.surface.seal_threshold_median_N);
    by_a_part("damping", "slider's damping", "vehicle.slider.damping_N_s_m",
              nominal.airframe.slider.damping_N_s_m);
    for (const auto& [name, sigma_deg] : {std::pair{"none", 0.0}, std::pair{"most", kMost_deg}}) {
        const std::string spread = fmt::format(
            "{{normal: {{mean: 0, sigma: {}, from: -25, to: 25}}}}", std::max(sigma_deg, 1e-6));
        all.push_back({fmt::format("misalignment_{}", name),
                       fmt::format("misalignment of {:.0f} deg, standard deviation", sigma_deg),
                       "",
                       {{"pendulum.yaw_deg", spread}, {"pendulum.pitch_deg", spread}}});
    }
    return all;
}

/// The campaign's file with a move in it.
std::string moved_text(const std::string& text, const Move& move, int repeats) {
    std::istringstream lines(text);
    std::string all, line;
    std::size_t replaced = 0;
    while (std::getline(lines, line)) {
        if (line.starts_with('#')) {
            continue;  // of the file as it was
        }
        if (line.starts_with("description:")) {
            line =
                "name: fig3_" + move.name + "\ndescription: the trials of fig3, " + move.assumption;
            ++replaced;
        } else if (line.starts_with("repeats:")) {
            line = fmt::format("repeats: {}", repeats);
            ++replaced;
        }
        for (const auto& [key, value] : move.parameters) {
            if (line.starts_with("  " + key + ":")) {
                line = fmt::format("  {}: {}", key, value);
                ++replaced;
            }
        }
        all += line + "\n";
    }
    require(replaced == 2 + move.parameters.size(), "fig3 has the lines that are moved");
    return all + fmt::format("overrides: [{}]\n", move.overrides);
}

}  // namespace

campaign::CampaignSummary fly_trials(const std::string& wanted, const Study& study,
                                     std::vector<double>* press_N) {
    const campaign::Campaign campaign = campaign::load_campaign(wanted);
    const fs::path folder = study.folder / "campaigns" / campaign.name;
    fs::remove(campaign::Results::file_of(folder));
    fs::create_directories(folder);
    campaign::Results results = begin_results(campaign, folder, false);
    run_campaign(results, study.jobs, {.on_progress = {}, .stop = study.stop});
    study.say("");  // some of its runs may be missing
    if (press_N != nullptr) {
        SQLite::Statement select(
            results.database(),
            fmt::format("SELECT avg(impact_force_N) FROM runs GROUP BY {0} ORDER BY {0}",
                        campaign::sql_name(kSpeedKey)));
        while (select.executeStep()) {
            press_N->push_back(select.getColumn(0).getDouble());
        }
    }
    return summarise(results);
}

const campaign::KeySummary& success_by(const campaign::CampaignSummary& summary, const char* key) {
    for (const campaign::KeySummary& one : summary.keys) {
        if (one.key == key) {
            return one;
        }
    }
    throw InternalError(summary.name + " does not vary " + key);
}

const campaign::KeySummary& by_speed(const campaign::CampaignSummary& summary) {
    return success_by(summary, kSpeedKey);
}

statistics::Proportion between(const std::vector<campaign::Group>& groups, double from_m_s,
                               double to_m_s) {
    constexpr double kRounding_m_s = 1e-6;
    statistics::Proportion sum{};
    for (const campaign::Group& group : groups) {
        if (group.middle() > from_m_s - kRounding_m_s && group.middle() < to_m_s + kRounding_m_s) {
            sum.successes += group.proportion.successes;
            sum.runs += group.proportion.runs;
        }
    }
    require(sum.runs > 0, "trials at these speeds");
    return sum;
}

BestMargin best_margin(const std::vector<campaign::Group>& groups) {
    const auto variance = [](const statistics::Proportion& p) {
        return p.probability() * (1.0 - p.probability()) / p.runs;
    };
    const statistics::Proportion best = between(groups, 1.0, 1.2);
    statistics::Proportion slower{};
    for (const campaign::Group& group : groups) {
        if (group.middle() < 0.95 &&
            (slower.runs == 0 || group.proportion.probability() > slower.probability())) {
            slower = group.proportion;
        }
    }
    const double mean = best.probability() - slower.probability();
    return {mean, mean - statistics::kNormal95 * std::sqrt(variance(best) + variance(slower))};
}

std::vector<MovedTrials> fly_moved_trials(const Study& study, int repeats) {
    const std::string text = campaign::load_campaign("fig3").yaml;
    std::vector<MovedTrials> all;
    for (const Move& move : moves()) {
        study.say("pendulum trials, " + move.assumption);
        const fs::path folder = study.folder / "campaigns" / ("fig3_" + move.name);
        fs::create_directories(folder);
        const fs::path path = folder / "campaign.yaml";
        std::ofstream file(path, std::ios::binary);
        file << moved_text(text, move, repeats);
        file.close();
        if (!file) {
            throw InputError(fmt::format("cannot write {}: is the disk full?", path.string()));
        }
        MovedTrials& moved =
            all.emplace_back(MovedTrials{move.assumption, fly_trials(path.string(), study), {}});
        const auto& curve = by_speed(moved.summary).curve;
        require(curve.has_value(), "trials that a curve can be fitted to");
        moved.curve = *curve;
    }
    return all;
}

}  // namespace limpet::paper
