// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/report/panels.hpp"
#include "limpet/report/sketch.hpp"
#include "limpet/report/story.hpp"

namespace limpet {

/// Everything that one figure shows.
struct Figure {
    std::string title;
    std::string subtitle;
    std::string warning;  ///< printed in red behind the subtitle; may be empty
    Window window;
    std::vector<Panel> panels;          ///< top to bottom, at least one
    std::vector<RecordedEvent> events;  ///< inside the window, in time
    std::vector<Phase> phases;          ///< those that reach into the window
};

/// The curves as gnuplot reads them: a block each, panel after panel, two empty lines between; an
/// empty line where a curve has a gap. Times and values to 10 digits.
[[nodiscard]] std::string figure_data(const Figure& figure);

/// The picture whose DATA is figure_data().
[[nodiscard]] Sketch figure_sketch(const Figure& figure);

}  // namespace limpet
