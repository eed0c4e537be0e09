// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "limpet/campaign/workers.hpp"
#include "limpet/rare/rare_event.hpp"
#include "limpet/rare/subset_simulation.hpp"
#include "limpet/study/sobol.hpp"

namespace limpet::study {

/// A number of a flight: a figure, or 1 where an event happened and 0 where it did not.
struct StudyFigure {
    rare::RareEvent event;
    bool is_event = false;
    [[nodiscard]] const std::string& text() const { return event.text; }
    /// NaN: did not come to pass.
    [[nodiscard]] double value(const campaign::RunRow& row) const;
};
/// @param text  a metric, an outcome, or a metric with <, <=, > or >= and a number
/// @throws InputError one line: what is unknown and what is near
[[nodiscard]] StudyFigure parse_figure(const std::string& text);

/// How the runs of a study lie: a sample A, a sample B, and for each drawn key, and for the
/// flight's own noise at the end, A with that one from B. Run k * samples + j is the j-th of the
/// k-th block.
struct StudyPlan {
    std::uint64_t seed = 1;
    std::size_t inputs = 0;  ///< drawn keys
    std::uint32_t samples = 256;

    [[nodiscard]] std::uint32_t runs() const {
        return samples * static_cast<std::uint32_t>(inputs + 3);
    }
};
[[nodiscard]] StudyPlan plan_of(const campaign::Campaign& campaign, std::uint32_t samples);

[[nodiscard]] rare::RarePoint point_of(const StudyPlan& plan, std::uint32_t run);

/// Checks before anything flies that all that varies is drawn.
/// @throws InputError one line: the key and what is wrong with it
void require_drawn(const campaign::Campaign& campaign);

/// What a study looks for; a table `study` next to the campaign's, of one row.
struct StudyRequest {
    std::string figure;
    std::uint32_t samples = 256;
};
/// @return nullopt: the results are not a study's
/// @throws InputError when the table is damaged
[[nodiscard]] std::optional<StudyRequest> study_request(campaign::Results& results);
/// Stores the request; another figure of the same flights may be requested at any time.
/// @throws InputError when the results are a campaign's or a search's, or of another size
void begin_study(campaign::Results& results, const StudyRequest& request);
/// @throws InputError when the results are a study's
void require_no_study(campaign::Results& results);
/// @return noise of a run of a study; nullopt: the results are none
[[nodiscard]] std::optional<NoiseBlend> study_noise(campaign::Results& results, std::uint32_t run);

/// Flies the runs that are missing, on `jobs` threads, each with several side by side; rows do not
/// depend on how many.
/// @throws InputError as run_campaign()
campaign::Progress fly_study(campaign::Results& results, int jobs,
                             const campaign::CampaignWatch& watch = {});

/// An input and what it brings about.
struct StudiedInput {
    std::string key;  ///< "noise": the flight's own random numbers
    SobolIndex index;
};

/// What a study has found, of the samples of which every run has the figure.
struct StudyFound {
    std::string name, scenario, version, figure;
    std::uint64_t seed = 0;
    std::uint32_t samples = 0;  ///< flown
    std::uint32_t used = 0;     ///< of them
    bool is_event = false;
    statistics::Proportion events;     ///< among A and B, which are independent
    std::vector<double> values;        ///< of A and B, sorted
    std::vector<StudiedInput> inputs;  ///< empty where too few samples have the figure
    [[nodiscard]] double mean() const;
    [[nodiscard]] double deviation() const;
};
/// @param figure  one of the flights', or empty: that of the request
[[nodiscard]] StudyFound find_study(campaign::Results& results, const std::string& figure = {});

/// For people: lines of at most a screen's width.
[[nodiscard]] std::string study_text(const StudyFound& found);
/// One JSON object.
[[nodiscard]] std::string study_json(const StudyFound& found);
/// Draws the indices with their intervals, as study.png and study.svg.
/// @return the files; none where there are no indices
/// @throws InputError for an unwritable folder, or when gnuplot is not installed
std::vector<std::filesystem::path> draw_study(const StudyFound& found,
                                              const std::filesystem::path& folder);

}  // namespace limpet::study
