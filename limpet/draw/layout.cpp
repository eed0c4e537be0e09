// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/layout.hpp"

#include <algorithm>

namespace limpet::draw {
namespace {

/// Area that two boxes share.
double shared_px2(const Box& a, const Box& b) {
    const double wide = std::min(a.right_px, b.right_px) - std::max(a.left_px, b.left_px);
    const double high = std::min(a.bottom_px, b.bottom_px) - std::max(a.top_px, b.top_px);
    return std::max(0.0, wide) * std::max(0.0, high);
}

}  // namespace

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

Box beside(double x_px, double y_px, double width_px, double height_px, double gap_px,
           const std::vector<Box>& taken, const Box& page) {
    const double up = 0.5 * height_px, side = 0.5 * width_px;
    const Box places[] = {
        {x_px + gap_px, y_px - up, x_px + gap_px + width_px, y_px + up},
        {x_px - gap_px - width_px, y_px - up, x_px - gap_px, y_px + up},
        {x_px - side, y_px - gap_px - height_px, x_px + side, y_px - gap_px},
        {x_px - side, y_px + gap_px, x_px + side, y_px + gap_px + height_px},
    };
    const Box* best = nullptr;
    double least_px2 = 0.0;
    for (const Box& place : places) {
        double bad_px2 = width_px * height_px - shared_px2(place, page);
        for (const Box& other : taken) {
            bad_px2 += shared_px2(place, other);
        }
        if (best == nullptr || bad_px2 < least_px2 - 1e-6) {
            best = &place;
            least_px2 = bad_px2;
        }
    }
    return *best;
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

}  // namespace limpet::draw
