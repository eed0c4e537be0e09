// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// Writes gnuplot's commands for one picture; positions are in pixels from its top left corner.
class Sketch {
public:
    /// @param font_px  of the tics
    Sketch(const Canvas& canvas, double font_px);

    /// A place as gnuplot takes it.
    [[nodiscard]] std::string at(double x_px, double y_px) const;

    /// Commands as they are; texts that come from elsewhere go through gnuplot::literal() first.
    template <class... Values>
    void add(const char* format, const Values&... values) {
        text_ += fmt::vformat(format, fmt::make_format_args(values...));
    }

    /// Commands that come before the first plot.
    template <class... Values>
    void prepare(const char* format, const Values&... values) {
        preparation_ += fmt::vformat(format, fmt::make_format_args(values...));
    }

    /// @param options  "left", "center" or "right", and what else `set label` takes
    void label(double x_px, double y_px, std::string_view text, double size_px, const char* colour,
               const char* options = "left");
    void line(double x0_px, double y0_px, double x1_px, double y1_px, const char* colour,
              double width, const char* options = "back");
    void box(double x0_px, double y0_px, double x1_px, double y1_px, const char* colour,
             const char* options = "behind");
    /// Where the next plot's axes are.
    void frame(const Box& box);
    /// Labels, lines and boxes so far belong to the plots so far.
    void forget();

    /// @return a script that draws STEM.png and STEM.svg with STEM.txt as DATA; sizes of
    /// marks are in units of MARK, rows of a key KEY_ROW apart (the terminals' letters differ)
    /// @param stem  of letters, digits, '_' and '-'
    [[nodiscard]] std::string script(const std::string& stem, bool svg = true) const;

private:
    Canvas canvas_;
    double font_px_;
    std::string preparation_;
    std::string text_;
};

/// Runs a sketch in `folder`, with `data` as STEM.txt there.
/// @param svg  false: of photographs only a PNG is made
/// @return STEM.png and STEM.svg
/// @throws InputError when the folder cannot be written or gnuplot is not installed
[[nodiscard]] std::vector<std::filesystem::path> draw(const Sketch& sketch, const std::string& data,
                                                      const std::string& stem,
                                                      const std::filesystem::path& folder,
                                                      bool svg = true);

}  // namespace limpet::draw
