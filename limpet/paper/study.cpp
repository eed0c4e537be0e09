// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/study.hpp"

namespace limpet {

PageFigure Study::figure(const Chart& chart, const std::string& id, const std::string& caption,
                         const std::string& alt) const {
    (void)draw_chart(chart, id, folder / "figures");
    return {.id = id,
            .title = chart.title,
            .caption = caption,
            .alt = alt,
            .png = std::filesystem::path("figures") / (id + ".png"),
            .svg = std::filesystem::path("figures") / (id + ".svg")};
}

const std::vector<StudyPart>& parts() {
    static const std::vector<StudyPart> all = {
        {"rotors", "Rotors: Table I", study_rotors},
        {"suction", "Suction cup: Table II and Fig. 2", study_suction},
        {"trials", "Attachment against impact speed: Fig. 3", study_trials},
        {"flights", "Perching and take-off: Figs. 9 to 15", study_flights},
        {"oscillation", "The open question: why real flights swing", study_oscillation},
        {"beyond", "Beyond the paper", study_beyond},
    };
    return all;
}

}  // namespace limpet
