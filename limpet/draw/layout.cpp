// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/layout.hpp"

#include <algorithm>

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

}  // namespace limpet::draw
