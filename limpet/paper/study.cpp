// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/study.hpp"

#include "limpet/core/interrupted.hpp"

namespace limpet::paper {

report::PageFigure Study::figure(const draw::Chart& chart, const std::string& id,
                                 const std::string& caption, const std::string& alt) const {
    (void)draw_chart(chart, id, folder / "figures");
    return {.id = id,
            .title = chart.title,
            .caption = caption,
            .alt = alt,
            .png = std::filesystem::path("figures") / (id + ".png"),
            .svg = std::filesystem::path("figures") / (id + ".svg")};
}

void Study::say(const std::string& what) const {
    if (stop != nullptr && *stop) {
        throw Interrupted("interrupted");
    }
    if (tell && !what.empty()) {
        tell(what);
    }
}

report::PageFigure Study::flight_figure(const std::string& flight, const std::string& picture,
                                        report::PageFigure page_figure) const {
    namespace fs = std::filesystem;
    fs::create_directories(folder / "figures");
    for (const std::string ending : {".png", ".svg"}) {
        const fs::path from = folder / "flights" / flight / (picture + ending);
        const fs::path to = fs::path("figures") / (page_figure.id + ending);
        if (fs::exists(from)) {
            fs::copy_file(from, folder / to, fs::copy_options::overwrite_existing);
            (ending == ".png" ? page_figure.png : page_figure.svg) = to;
        }
    }
    page_figure.wide = true;
    return page_figure;
}

const std::vector<StudyPart>& parts() {
    static const std::vector<StudyPart> all = {
        rotors_part(),  suction_part(),     trials_part(),
        flights_part(), oscillation_part(), beyond_part(),
    };
    return all;
}

}  // namespace limpet::paper
