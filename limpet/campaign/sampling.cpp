// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/random.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::campaign {
namespace {

/// Draws until it falls within the key's bounds: the loader refuses those that are seldom met.
template <class Draw>
double draw_within(const VariedKey& key, const Draw& draw) {
    double value = draw();
    while (!(value >= key.from && value <= key.to)) {
        value = draw();
    }
    return value;
}

const SampledValue& choose(const VariedKey& key, RandomStream& random) {
    const auto count = static_cast<double>(key.values.size());
    const auto index = static_cast<std::size_t>(count * random.uniform());
    return key.values[std::min(index, key.values.size() - 1)];
}

/// Share of a standard normal below x.
double normal_below(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

}  // namespace

bool is_named(const VariedKey& key) {
    return !key.values.empty() && std::holds_alternative<std::string>(key.values.front());
}

std::uint64_t grid_points(const std::vector<VariedKey>& keys) {
    std::uint64_t points = 1;
    for (const VariedKey& key : keys) {
        points *= key.spread == Spread::grid ? key.values.size() : 1;
    }
    return points;
}

double share_within(const VariedKey& key) {
    if (key.spread == Spread::normal) {
        return normal_below((key.to - key.first) / key.second) -
               normal_below((key.from - key.first) / key.second);
    }
    if (key.spread == Spread::lognormal) {
        const auto below = [&key](double end) {
            return end <= 0.0 ? 0.0 : normal_below(std::log(end / key.first) / key.second);
        };
        return below(key.to) - below(key.from);
    }
    return 1.0;
}

std::vector<SampledValue> draw(const std::vector<VariedKey>& keys, std::uint64_t seed,
                               std::uint32_t run) {
    RandomStream random(seed, run, Stream::scenario);
    std::uint64_t stride = grid_points(keys);
    const std::uint64_t point = run % stride;
    std::vector<SampledValue> sample;
    sample.reserve(keys.size());
    for (const VariedKey& key : keys) {
        switch (key.spread) {
            case Spread::grid:
                stride /= key.values.size();
                sample.push_back(key.values[point / stride % key.values.size()]);
                break;
            case Spread::choice: sample.push_back(choose(key, random)); break;
            case Spread::uniform:
                sample.emplace_back(key.first + (key.second - key.first) * random.uniform());
                break;
            case Spread::normal:
                sample.emplace_back(
                    draw_within(key, [&] { return key.first + key.second * random.normal(); }));
                break;
            case Spread::lognormal:
                sample.emplace_back(
                    draw_within(key, [&] { return random.lognormal(key.first, key.second); }));
                break;
        }
    }
    return sample;
}

std::string value_text(const SampledValue& value) {
    const double* number = std::get_if<double>(&value);
    return number != nullptr ? scenario::number_text(*number) : std::get<std::string>(value);
}

}  // namespace limpet::campaign
