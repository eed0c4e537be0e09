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

/// A correlation and how each of the pairs bears on it.
struct Correlation {
    double value = kNaN;
    std::vector<double> influence;
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
    Correlation found{.value = 0.0, .influence = {}};
    for (std::size_t i = 0; i < x.size(); ++i) {
        found.value += standard(x[i], of_x) * standard(y[i], of_y) / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = standard(x[i], of_x), v = standard(y[i], of_y);
        found.influence.push_back(u * v - 0.5 * found.value * (u * u + v * v));
    }
    return found;
}

double dot(const std::vector<double>& x, const std::vector<double>& y) {
    return std::inner_product(x.begin(), x.end(), y.begin(), 0.0);
}

/// Less what another correlation, whose truth is 0, happens to be: as much of it as both go
/// together; where that halves the error at least, for how much that is is an estimate, too.
Correlation controlled(const Correlation& one, const Correlation& none) {
    const double squares = dot(none.influence, none.influence);
    if (!std::isfinite(one.value) || !(squares > 0.0)) {
        return one;
    }
    const double share = dot(one.influence, none.influence) / squares;
    Correlation less = one;
    less.value -= share * none.value;
    for (std::size_t i = 0; i < less.influence.size(); ++i) {
        less.influence[i] -= share * none.influence[i];
    }
    const bool pays =
        dot(less.influence, less.influence) < 0.25 * dot(one.influence, one.influence);
    return pays && std::abs(less.value) < 1.0 ? less : one;
}

struct WithInterval {
    double value;
    statistics::Interval interval;
};

/// In Fisher's z.
WithInterval with_interval(const Correlation& correlation) {
    if (!std::isfinite(correlation.value)) {
        return {kNaN, {kNaN, kNaN}};
    }
    // Beyond it Fisher's z has no number: two samples that are one.
    constexpr double kMost = 1.0 - 1e-12;
    const double r = std::clamp(correlation.value, -kMost, kMost);
    const double z = std::atanh(r);
    const double half = statistics::kNormal95 *
                        std::sqrt(dot(correlation.influence, correlation.influence)) /
                        static_cast<double>(correlation.influence.size()) / (1.0 - r * r);
    return {r, {std::tanh(z - half), std::tanh(z + half)}};
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const PickFreeze& figure) {
    require(figure.a.size() > 1 && figure.b.size() == figure.a.size(), "two samples alike");
    const Correlation of_none = correlation(figure.a, figure.b);
    std::vector<SobolIndex> indices;
    for (const std::vector<double>& mixed : figure.mixed) {
        require(mixed.size() == figure.a.size(), "a mixed sample for each input");
        const WithInterval with_b =
            with_interval(controlled(correlation(figure.b, mixed), of_none));
        const WithInterval with_a = with_interval(correlation(figure.a, mixed));
        indices.push_back({.first = with_b.value,
                           .first_95 = with_b.interval,
                           .total = 1.0 - with_a.value,
                           .total_95 = {1.0 - with_a.interval.high, 1.0 - with_a.interval.low}});
    }
    return indices;
}

}  // namespace limpet::study
