// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Where things go on a picture, in pixels from its top left corner.
namespace limpet::draw {

struct Canvas {
    int width_px = 0;
    int height_px = 0;
    /// gnuplot's screen coordinates: 0..1 from the bottom left corner.
    [[nodiscard]] double x(double from_left_px) const { return from_left_px / width_px; }
    [[nodiscard]] double y(double from_top_px) const { return 1.0 - from_top_px / height_px; }
};

/// Moves marks on a line apart: as little as possible in the sense of least squares, in their
/// order.
/// @param wanted  ascending
/// @param gap     between neighbours, at least; less when they do not fit
/// @return between low and high
[[nodiscard]] std::vector<double> spread(const std::vector<double>& wanted, double gap, double low,
                                         double high);

/// About how wide a text is in DejaVu Sans; a little more than less.
/// @param size_px  height of the font
[[nodiscard]] double text_width_px(std::string_view text, double size_px);

/// A part of a picture, in pixels from its top left corner.
struct Box {
    double left_px = 0.0;
    double top_px = 0.0;
    double right_px = 0.0;
    double bottom_px = 0.0;
    [[nodiscard]] double width_px() const { return right_px - left_px; }
    [[nodiscard]] double height_px() const { return bottom_px - top_px; }
};

/// Breaks a text at spaces into lines that fit; a word that is longer than a line stays whole.
/// @return at least one line
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, double size_px,
                                               double width_px);

}  // namespace limpet::draw
