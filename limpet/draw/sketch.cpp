// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/sketch.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

#include "limpet/core/errors.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/draw/gnuplot.hpp"

namespace limpet::draw {

std::vector<double> spread(const std::vector<double>& wanted, double gap, double low, double high) {
    const std::size_t count = wanted.size();
    if (count == 0) {
        return {};
    }
    const auto gaps = static_cast<double>(count - 1);
    const double step = gaps > 0.0 ? std::min(gap, (high - low) / gaps) : 0.0;
    // With the gaps taken out the marks have only to ascend: neighbours that do not are pooled at
    // their mean (isotonic regression, pool adjacent violators).
    struct Pool {
        double sum = 0.0;
        std::size_t size = 0;
        [[nodiscard]] double mean() const { return sum / static_cast<double>(size); }
    };
    std::vector<Pool> pools;
    for (std::size_t i = 0; i < count; ++i) {
        pools.push_back({wanted[i] - static_cast<double>(i) * step, 1});
        while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
            const Pool last = pools.back();
            pools.pop_back();
            pools.back().sum += last.sum;
            pools.back().size += last.size;
        }
    }
    std::vector<double> placed;
    for (const Pool& pool : pools) {
        for (std::size_t i = 0; i < pool.size; ++i) {
            const double free = std::clamp(pool.mean(), low, std::max(low, high - gaps * step));
            placed.push_back(free + static_cast<double>(placed.size()) * step);
        }
    }
    return placed;
}

double text_width_px(std::string_view text, double size_px) {
    constexpr double kMeanWidth = 0.64;  // of a letter, as a share of the font's height
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;  // UTF-8: counts first bytes
    });
    return kMeanWidth * size_px * static_cast<double>(letters);
}

std::vector<std::string> wrapped(std::string_view text, double size_px, double width_px) {
    std::vector<std::string> lines(1);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string word(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (word.empty()) {
            continue;
        }
        const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
        if (lines.back().empty() || text_width_px(longer, size_px) <= width_px) {
            lines.back() = longer;
        } else {
            lines.push_back(word);
        }
    }
    return lines;
}

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
