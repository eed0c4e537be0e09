// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "limpet/draw/chart.hpp"
#include "limpet/paper/evidence.hpp"
#include "limpet/report/page.hpp"

namespace limpet::paper {

/// One reproduction as it goes: where it writes, how thorough it is, what it has found so far.
struct Study {
    std::filesystem::path folder;  ///< of the page; figures/, flights/ and campaigns/ lie in it
    bool quick = false;            ///< fewer runs and coarser maps, the same experiments
    int jobs = 1;
    std::function<void(const std::string& what)> tell = {};  ///< long work, as it goes
    const std::atomic<bool>* stop = nullptr;

    Evidence evidence;
    std::vector<report::PageSection> sections;

    /// Draws a chart into figures/ and gives it back as a figure of the page.
    [[nodiscard]] report::PageFigure figure(const draw::Chart& chart, const std::string& id,
                                            const std::string& caption,
                                            const std::string& alt) const;
    /// Copies a picture of a flight, FOLDER/flights/FLIGHT/PICTURE.png and .svg if there is one,
    /// into figures/.
    [[nodiscard]] report::PageFigure flight_figure(const std::string& flight,
                                                   const std::string& picture,
                                                   report::PageFigure figure) const;
    /// Tells what comes next; before that it stops where it was asked to.
    /// @throws Interrupted
    void say(const std::string& what) const;
};

/// A part of the paper that can be reproduced by itself: `limpet reproduce --only NAME`.
struct StudyPart {
    std::string name;   ///< "rotors"
    std::string title;  ///< of its section
    void (*run)(Study& study);
    /// Names of the evidence that it will have measured: statements are held to them before
    /// anything flies.
    std::vector<std::string> measures;
};

// Each adds its section and its evidence.
[[nodiscard]] StudyPart rotors_part();       ///< Table I
[[nodiscard]] StudyPart suction_part();      ///< Table II, Fig. 2
[[nodiscard]] StudyPart trials_part();       ///< Fig. 3
[[nodiscard]] StudyPart flights_part();      ///< Figs. 9 to 15
[[nodiscard]] StudyPart oscillation_part();  ///< the open question
[[nodiscard]] StudyPart beyond_part();       ///< valve, energy, break-off loads
/// In the paper's order.
[[nodiscard]] const std::vector<StudyPart>& parts();

}  // namespace limpet::paper
