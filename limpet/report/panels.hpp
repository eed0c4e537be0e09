// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limpet/record/recording.hpp"
#include "limpet/report/story.hpp"

/// The curves of the paper's Figs. 11 to 14, taken from a recording: numbers only, no drawing.
namespace limpet {

enum class Trace {
    measured,    ///< what a sensor said
    measured_2,  ///< what its twin said
    truth,       ///< what was so
    estimated,   ///< what the autopilot believed
};

/// A curve; NaN where there is a gap.
struct Curve {
    std::string label;
    Trace trace = Trace::truth;
    std::vector<double> time_s;
    std::vector<double> values;
};

/// A horizontal line that means something.
struct Level {
    std::string label;
    double value = 0.0;
};

struct Panel {
    std::string title;  ///< "cup pressure"
    std::string unit;   ///< "hPa"
    std::vector<Curve> curves = {};
    std::vector<Level> levels = {};
    double least_span = 1.0;  ///< the axis never shows less: noise shall not fill a panel
    bool from_zero = false;   ///< the axis begins at 0
};

/// @return pressure, pitch, force, thrust, distance; those that were recorded, over the window
[[nodiscard]] std::vector<Panel> panels(const Recording& recording, const Window& window);

/// Topics of the five panels that the recording lacks, a sentence each; what only a vehicle with a
/// cup has is not missed on one without.
[[nodiscard]] std::vector<std::string> missing_topics(const Recording& recording);

/// A curve with at most four points for each of `bins` equal stretches of the window: first,
/// lowest, highest, last, so that no peak and no gap is lost. Curves that have fewer points stay as
/// they are.
[[nodiscard]] Curve thinned(const Curve& curve, const Window& window, std::size_t bins);

/// Ends of an axis.
struct Range {
    double low = 0.0;
    double high = 1.0;
};
/// Holds every curve and level with some air above and below.
[[nodiscard]] Range axis_range(const Panel& panel);

}  // namespace limpet
