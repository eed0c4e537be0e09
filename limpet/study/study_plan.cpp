// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/study/study.hpp"

namespace limpet::study {
double StudyFigure::value(const campaign::RunRow& row) const {
    if (row.outcome == campaign::kFault) {
        return kNaN;
    }
    return is_event ? (event.happened(row) ? 1.0 : 0.0) : event.value(row);
}

StudyFigure parse_figure(const std::string& text) {
    constexpr const char* kOption = "--of";
    if (rare::is_figure(text)) {
        StudyFigure figure;
        figure.event.text = figure.event.figure = text;
        return figure;
    }
    if (const auto outcome = outcome_from(text)) {
        StudyFigure figure{.event = {}, .is_event = true};
        figure.event.text = text;
        figure.event.outcome = outcome;
        return figure;
    }
    return {.event = rare::parse_rare_event(text, {}, kOption), .is_event = true};
}

StudyPlan plan_of(const campaign::Campaign& campaign, std::uint32_t samples) {
    return {.seed = campaign.seed, .inputs = drawn_keys(campaign.keys), .samples = samples};
}

rare::RarePoint point_of(const StudyPlan& plan, std::uint32_t run) {
    const std::uint32_t block = run / plan.samples;
    RandomStream random(plan.seed, run % plan.samples, Stream::scenario);
    std::vector<double> a(plan.inputs), b(plan.inputs);
    std::generate(a.begin(), a.end(), [&] { return random.normal(); });
    std::generate(b.begin(), b.end(), [&] { return random.normal(); });
    const std::uint64_t noise_a = campaign::noise_seed(random),
                        noise_b = campaign::noise_seed(random);
    constexpr std::uint32_t kFirst = 0, kSecond = 1;
    if (block == kSecond) {
        return {std::move(b), {{.seed = noise_b}}};
    }
    if (block != kFirst && block - 2 < plan.inputs) {
        a[block - 2] = b[block - 2];
    }
    return {std::move(a), {{.seed = block - 2 == plan.inputs ? noise_b : noise_a}}};
}

void require_drawn(const campaign::Campaign& campaign) {
    require_no_grid(campaign.keys, "a study");
    if (drawn_keys(campaign.keys) == 0) {
        throw InputError(campaign.name +
                         ": nothing is drawn: a study varies inputs, as in --vary "
                         "guidance.dock_speed_m_s=0.8..1.2");
    }
}

}  // namespace limpet::study
