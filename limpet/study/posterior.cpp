// SPDX-License-Identifier: Apache-2.0
#include "limpet/study/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "limpet/core/errors.hpp"

namespace limpet::study {
namespace {

std::vector<std::size_t> order_of(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t k) { return values[i] < values[k]; });
    return order;
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

double Weighted::evidence() const {
    return sum_of(weights) / static_cast<double>(weights.size());
}

double Weighted::effective() const {
    const double squares = std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
    const double sum = sum_of(weights);
    return squares > 0.0 ? sum * sum / squares : 0.0;
}

double Weighted::mean(const std::vector<double>& values) const {
    require(values.size() == weights.size(), "a value a draw");
    return std::inner_product(weights.begin(), weights.end(), values.begin(), 0.0) /
           sum_of(weights);
}

double Weighted::quantile(const std::vector<double>& values, double share) const {
    require(values.size() == weights.size() && !values.empty(), "a value a draw");
    const double wanted = share * sum_of(weights);
    double sum = 0.0;
    const std::vector<std::size_t> order = order_of(values);
    for (const std::size_t i : order) {
        sum += weights[i];
        if (sum >= wanted) {
            return values[i];
        }
    }
    return values[order.back()];
}

double information_bits(const std::vector<std::size_t>& kinds, const std::vector<double>& measured,
                        const std::vector<double>& weights, std::size_t bins) {
    require(kinds.size() == measured.size() && kinds.size() == weights.size() && !kinds.empty(),
            "a kind, a measurement and a weight a draw");
    const std::size_t count = 1 + *std::max_element(kinds.begin(), kinds.end());
    std::vector<double> table(count * bins, 0.0), of_kind(count, 0.0), of_bin(bins, 0.0);
    const double all = sum_of(weights);
    double below = 0.0;
    for (const std::size_t i : order_of(measured)) {
        const auto bin =
            std::min(bins - 1, static_cast<std::size_t>(static_cast<double>(bins) * below / all));
        const double share = weights[i] / all;
        table[kinds[i] * bins + bin] += share;
        of_kind[kinds[i]] += share;
        of_bin[bin] += share;
        below += weights[i];
    }
    double bits = 0.0;
    for (std::size_t kind = 0; kind < count; ++kind) {
        for (std::size_t bin = 0; bin < bins; ++bin) {
            const double both = table[kind * bins + bin];
            if (both > 0.0) {
                bits += both * std::log2(both / (of_kind[kind] * of_bin[bin]));
            }
        }
    }
    return bits;
}

}  // namespace limpet::study
