// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "limpet/paper/evidence.hpp"
#include "limpet/draw/chart.hpp"
#include "limpet/report/page.hpp"

namespace limpet {

/// One reproduction as it goes: where it writes, how thorough it is, what it has found so far.
struct Study {
    std::filesystem::path folder;  ///< of the page; figures/, flights/ and campaigns/ lie in it
    bool quick = false;            ///< fewer runs and coarser maps, the same experiments
    int jobs = 1;
    std::function<void(const std::string& what)> tell = {};  ///< long work, as it goes
    const std::atomic<bool>* stop = nullptr;

    Evidence evidence;
    std::vector<PageSection> sections;

    /// Draws a chart into figures/ and gives it back as a figure of the page.
    [[nodiscard]] PageFigure figure(const Chart& chart, const std::string& id,
                                    const std::string& caption, const std::string& alt) const;
    /// Copies a picture of a flight, FOLDER/flights/FLIGHT/PICTURE.png and .svg if there is one,
    /// into figures/.
    [[nodiscard]] PageFigure flight_figure(const std::string& flight, const std::string& picture,
                                           PageFigure figure) const;
    /// Tells what comes next; before that it stops where it was asked to.
    /// @throws Interrupted
    void say(const std::string& what) const;
};

/// A part of the paper that can be reproduced by itself: `limpet reproduce --only NAME`.
struct StudyPart {
    std::string name;   ///< "rotors"
    std::string title;  ///< of its section
    void (*run)(Study& study);
};

// The parts, in the paper's order; each adds its section and its evidence.
void study_rotors(Study& study);       ///< Table I
void study_suction(Study& study);      ///< Table II, Fig. 2
void study_trials(Study& study);       ///< Fig. 3
void study_flights(Study& study);      ///< Figs. 9 to 15
void study_oscillation(Study& study);  ///< the open question
void study_beyond(Study& study);       ///< valve, energy, break-off loads
[[nodiscard]] const std::vector<StudyPart>& parts();

}  // namespace limpet
