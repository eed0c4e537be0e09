// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/sketch.hpp"

#include <cctype>
#include <fstream>

#include "limpet/core/errors.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/draw/gnuplot.hpp"

namespace limpet::draw {

Sketch::Sketch(const Canvas& canvas, double font_px) : canvas_(canvas), font_px_(font_px) {
    add("set multiplot\nset encoding utf8\n");
    add("set tics scale 0.4 nomirror textcolor rgb '{}'\n", colours::kInk);
    add("set border 3 lc rgb '{}' lw 0.8\n", colours::kFaint);
}

std::string Sketch::at(double x_px, double y_px) const {
    return fmt::format("screen {:.5f}, screen {:.5f}", canvas_.x(x_px), canvas_.y(y_px));
}

void Sketch::label(double x_px, double y_px, std::string_view text, double size_px,
                   const char* colour, const char* options) {
    add("set label {} at {} {} noenhanced font 'DejaVu Sans,{}' textcolor rgb '{}' front\n",
        gnuplot::literal(text), at(x_px, y_px), options, size_px, colour);
}

void Sketch::line(double x0_px, double y0_px, double x1_px, double y1_px, const char* colour,
                  double width, const char* options) {
    add("set arrow from {} to {} nohead {} lc rgb '{}' lw {}\n", at(x0_px, y0_px), at(x1_px, y1_px),
        options, colour, width);
}

void Sketch::box(double x0_px, double y0_px, double x1_px, double y1_px, const char* colour,
                 const char* options) {
    add("set object rectangle from {} to {} {} fs solid noborder fc rgb '{}'\n", at(x0_px, y0_px),
        at(x1_px, y1_px), options, colour);
}

void Sketch::frame(const Box& box) {
    add("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n", canvas_.x(box.left_px),
        canvas_.x(box.right_px));
    add("set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n", canvas_.y(box.top_px),
        canvas_.y(box.bottom_px));
}

void Sketch::forget() {
    add("unset label\nunset arrow\nunset object\n");
}

std::string Sketch::script(const std::string& stem, bool svg) const {
    for (const char c : stem) {
        require(std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-',
                "a picture's name is of letters, digits, '_' and '-'");
    }
    const std::string size = fmt::format("size {},{} font 'DejaVu Sans,{}' background '#FFFFFF'",
                                         canvas_.width_px, canvas_.height_px, font_px_);
    const std::string body = text_ + "unset multiplot\nunset output\n";
    // Fonts are measured in points of 1/72 in at 96 dpi in a PNG, in pixels in an SVG, where marks
    // are larger as well.
    std::string script =
        fmt::format("DATA = '{}.txt'\nMARK = 1.0\nKEY_ROW = 1.2\n", stem) + preparation_ +
        fmt::format("set terminal pngcairo {} fontscale 0.75\nset output '{}.png'\n", size, stem) +
        body;
    if (svg) {
        script += "reset\nMARK = 0.65\nKEY_ROW = 0.95\n" +
                  fmt::format("set terminal svg {}\nset output '{}.svg'\n", size, stem) + body;
    }
    return script;
}

std::vector<std::filesystem::path> draw(const Sketch& sketch, const std::string& data,
                                        const std::string& stem,
                                        const std::filesystem::path& folder, bool svg) {
    const std::string script = sketch.script(stem, svg);
    std::ofstream file(folder / (stem + ".txt"), std::ios::binary);
    file << data;
    file.close();
    if (!file) {
        throw InputError(fmt::format("cannot write in {}: is the disk full?", folder.string()));
    }
    gnuplot::run(folder, script);
    std::vector<std::filesystem::path> drawn = {folder / (stem + ".png")};
    if (svg) {
        drawn.push_back(folder / (stem + ".svg"));
    }
    return drawn;
}

}  // namespace limpet::draw
