// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
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

const SampledValue& choose(const VariedKey& key, double uniform) {
    const auto count = static_cast<double>(key.values.size());
    const auto index = static_cast<std::size_t>(count * uniform);
    return key.values[std::min(index, key.values.size() - 1)];
}

/// A standard normal moved into the bounds, in standard deviations: to where its probability is the
/// same share of what lies between them.
double moved_into(double low, double high, double normal) {
    if (std::isinf(low) && std::isinf(high)) {
        return normal;
    }
    if (low > 0.0) {  // probabilities near 1 have fewer digits than those near 0
        return -moved_into(-high, -low, -normal);
    }
    const double below = normal_probability(low);
    const double share = normal_probability(normal) * (normal_probability(high) - below);
    return std::clamp(normal_quantile(std::clamp(below + share, 1e-300, 1.0 - 1e-16)), low, high);
}

double at_normal(const VariedKey& key, double normal) {
    if (key.spread == Spread::uniform) {
        return key.first + (key.second - key.first) * normal_probability(normal);
    }
    if (key.spread == Spread::normal) {
        const double z = moved_into((key.from - key.first) / key.second,
                                    (key.to - key.first) / key.second, normal);
        return std::clamp(key.first + key.second * z, key.from, key.to);
    }
    const auto z_of = [&key](double end) {
        return end > 0.0 ? std::log(end / key.first) / key.second
                         : -std::numeric_limits<double>::infinity();
    };
    const double z = moved_into(z_of(key.from), z_of(key.to), normal);
    return std::clamp(key.first * std::exp(key.second * z), key.from, key.to);
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

std::string uneven_runs(const std::vector<VariedKey>& keys, std::uint64_t runs) {
    const std::uint64_t points = grid_points(keys);
    if (runs % points == 0) {
        return {};
    }
    constexpr const char* kInstead = "`repeats: N` in the place of `runs` flies each N times";
    if (runs < points) {
        return fmt::format(
            "runs: {} is fewer than the grids' {} points: {} of them are not flown; {}", runs,
            points, points - runs, kInstead);
    }
    return fmt::format(
        "runs: {} is no multiple of the grids' {} points: the first {} are flown once "
        "more than the others; {}",
        runs, points, runs % points, kInstead);
}

double share_within(const VariedKey& key) {
    if (key.spread == Spread::normal) {
        return normal_probability((key.to - key.first) / key.second) -
               normal_probability((key.from - key.first) / key.second);
    }
    if (key.spread == Spread::lognormal) {
        const auto below = [&key](double end) {
            return end <= 0.0 ? 0.0 : normal_probability(std::log(end / key.first) / key.second);
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
            case Spread::choice: sample.push_back(choose(key, random.uniform())); break;
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

std::size_t drawn_keys(const std::vector<VariedKey>& keys) {
    return static_cast<std::size_t>(std::count_if(
        keys.begin(), keys.end(), [](const VariedKey& key) { return key.spread != Spread::grid; }));
}

std::vector<SampledValue> sample_at(const std::vector<VariedKey>& keys,
                                    const std::vector<double>& normals) {
    require(normals.size() == drawn_keys(keys), "every drawn key has its normal");
    std::vector<SampledValue> sample;
    auto normal = normals.begin();
    for (const VariedKey& key : keys) {
        if (key.spread == Spread::grid) {
            sample.push_back(key.values.front());
        } else if (key.spread == Spread::choice) {
            sample.push_back(choose(key, normal_probability(*normal++)));
        } else {
            sample.emplace_back(at_normal(key, *normal++));
        }
    }
    return sample;
}

void require_no_grid(const std::vector<VariedKey>& keys, const char* what) {
    for (const VariedKey& key : keys) {
        if (key.spread == Spread::grid && key.values.size() > 1) {
            throw InputError(fmt::format(
                "{}: parameters.{}: a grid has no probabilities: for {} write choice or uniform in "
                "its place, or a single value",
                key.place, key.key, what));
        }
    }
}

std::uint64_t noise_seed(RandomStream& random) {
    return static_cast<std::uint64_t>(random.uniform() * 0x1.0p53);
}

std::string value_text(const SampledValue& value) {
    const double* number = std::get_if<double>(&value);
    return number != nullptr ? scenario::number_text(*number) : std::get<std::string>(value);
}

}  // namespace limpet::campaign
