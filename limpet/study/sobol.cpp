// SPDX-License-Identifier: Apache-2.0
#include "limpet/study/sobol.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::study {
namespace {

struct Moments {
    double mean = 0.0;
    double deviation = 0.0;
};

Moments moments_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    Moments of;
    of.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - of.mean) * (value - of.mean);
    }
    of.deviation = std::sqrt(squares / n);
    return of;
}

struct Correlation {
    double value = kNaN;
    campaign::Interval interval = {kNaN, kNaN};
};

Correlation correlation(const std::vector<double>& x, const std::vector<double>& y) {
    const auto n = static_cast<double>(x.size());
    const Moments of_x = moments_of(x), of_y = moments_of(y);
    if (!(of_x.deviation > 0.0) || !(of_y.deviation > 0.0)) {
        return {};
    }
    const auto standard = [](double value, const Moments& of) {
        return (value - of.mean) / of.deviation;
    };
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sum += standard(x[i], of_x) * standard(y[i], of_y);
    }
    // Beyond it Fisher's z has no number: two samples that are one.
    constexpr double kMost = 1.0 - 1e-12;
    const double r = std::clamp(sum / n, -kMost, kMost);
    double influence2 = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = standard(x[i], of_x), v = standard(y[i], of_y);
        const double influence = u * v - 0.5 * r * (u * u + v * v);
        influence2 += influence * influence;
    }
    const double z = std::atanh(r);
    const double half = campaign::kNormal95 * std::sqrt(influence2) / n / (1.0 - r * r);
    return {r, {std::tanh(z - half), std::tanh(z + half)}};
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const PickFreeze& figure) {
    require(figure.a.size() > 1 && figure.b.size() == figure.a.size(), "two samples alike");
    std::vector<SobolIndex> indices;
    for (const std::vector<double>& mixed : figure.mixed) {
        require(mixed.size() == figure.a.size(), "a mixed sample for each input");
        const Correlation with_b = correlation(figure.b, mixed);
        const Correlation with_a = correlation(figure.a, mixed);
        indices.push_back({.first = with_b.value,
                           .first_95 = with_b.interval,
                           .total = 1.0 - with_a.value,
                           .total_95 = {1.0 - with_a.interval.high, 1.0 - with_a.interval.low}});
    }
    return indices;
}

}  // namespace limpet::study
