// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace limpet::scenario {
namespace {

constexpr std::size_t kHandful = 16;
constexpr std::size_t kShortestStem = 3;  ///< "a" is no hint at "attempts"

/// One slip in a short word, two letters swapped or a third of them in a longer one.
std::size_t farthest(std::string_view wrong) {
    return wrong.size() < kShortestStem       ? 0
           : wrong.size() < 2 + kShortestStem ? 1
                                              : std::max<std::size_t>(2, wrong.size() / 3);
}

bool begins_with(std::string_view text, std::string_view stem) {
    return stem.size() >= kShortestStem && text.substr(0, stem.size()) == stem;
}

/// Whether letters were left out of the name alone: likelier than a wrong one.
bool left_out_of(std::string_view name, std::string_view wrong) {
    for (const char letter : name) {
        wrong.remove_prefix(!wrong.empty() && wrong.front() == letter ? 1 : 0);
    }
    return wrong.empty();
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

std::string_view nearest(std::string_view wrong, const std::vector<std::string_view>& names) {
    std::string_view best;
    std::size_t best_distance = farthest(wrong) + 1;
    for (const std::string_view name : names) {
        const std::size_t distance = edit_distance(wrong, name);
        if (distance < best_distance || (distance == best_distance && !best.empty() &&
                                         left_out_of(name, wrong) && !left_out_of(best, wrong))) {
            best = name;
            best_distance = distance;
        }
    }
    if (!best.empty()) {
        return best;
    }
    const auto related = std::find_if(names.begin(), names.end(), [&](std::string_view name) {
        return begins_with(name, wrong) || begins_with(wrong, name);
    });
    return related == names.end() ? std::string_view{} : *related;
}

std::string hint(std::string_view wrong, const std::vector<std::string_view>& names,
                 std::string_view where) {
    if (const std::string_view name = nearest(wrong, names); !name.empty()) {
        return fmt::format(", did you mean {}?", name);
    }
    if (names.size() > kHandful && !where.empty()) {
        return fmt::format("; {}", where);
    }
    return names.empty() ? std::string("; there are none")
                         : fmt::format("; there are {}", fmt::join(names, ", "));
}

}  // namespace limpet::scenario
