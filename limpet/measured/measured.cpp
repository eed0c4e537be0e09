// SPDX-License-Identifier: Apache-2.0
#include "limpet/measured/measured.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "limpet/core/errors.hpp"
#include "limpet/statistics/success_curve.hpp"

namespace limpet::measured {
namespace {

std::vector<std::vector<double>> said_with(const Measurement& measurement,
                                           std::optional<double> fitted) {
    std::vector<std::vector<double>> said;
    for (const Series& series : measurement.series) {
        Numbers numbers = series.numbers;
        if (fitted) {
            numbers[std::string(measurement.law->fits)] = *fitted;
        }
        said.push_back(measurement.law->say(numbers, series.x));
    }
    return said;
}

double squares(const Measurement& measurement, const std::vector<std::vector<double>>& said) {
    double sum = 0.0;
    for (std::size_t k = 0; k < said.size(); ++k) {
        for (std::size_t i = 0; i < said[k].size(); ++i) {
            const double error = said[k][i] - measurement.series[k].y[i];
            sum += error * error;
        }
    }
    return sum;
}

/// The least of the squares over the logarithm of the number: a coarse scan, then Brent's search.
double best_fit(const Measurement& measurement) {
    constexpr int kScan = 24;
    const double from = std::log(measurement.law->fits_from);
    const double to = std::log(measurement.law->fits_to);
    const auto left = [&](double logarithm) {
        return squares(measurement, said_with(measurement, std::exp(logarithm)));
    };
    const double stride = (to - from) / kScan;
    double best = from;
    double least = left(from);
    for (int k = 1; k <= kScan; ++k) {
        const double at = from + k * stride;
        if (const double squared = left(at); squared < least) {
            least = squared;
            best = at;
        }
    }
    const double logarithm = boost::math::tools::brent_find_minima(
                                 left, std::max(from, best - stride), std::min(to, best + stride),
                                 std::numeric_limits<double>::digits / 2)
                                 .first;
    return std::exp(logarithm);
}

/// Of a sum of squares, against the measurement's scatter.
double chance(const Measurement& measurement, double squared, int degrees) {
    const double errors = std::sqrt(squared) / *measurement.scatter;  // whose square may be 0
    return statistics::chi_squared_beyond(errors * errors, degrees);
}

/// Of a law that says nothing at all.
double squares_without(const Measurement& measurement) {
    std::vector<std::vector<double>> said;
    for (const Series& series : measurement.series) {
        said.emplace_back(series.x.size(), *measurement.law->without);
    }
    return squares(measurement, said);
}

bool is_given(const Measurement& measurement) {
    return measurement.series.front().numbers.count(std::string(measurement.law->fits)) > 0;
}

}  // namespace

Comparison compare(const Measurement& measurement) {
    Comparison found;
    if (!measurement.law->fits.empty() && !is_given(measurement)) {
        found.fitted = best_fit(measurement);
    }
    found.said = said_with(measurement, found.fitted);
    int points = 0;
    for (std::size_t k = 0; k < found.said.size(); ++k) {
        points += static_cast<int>(found.said[k].size());
        for (std::size_t i = 0; i < found.said[k].size(); ++i) {
            found.largest =
                std::max(found.largest, std::abs(found.said[k][i] - measurement.series[k].y[i]));
        }
    }
    const double squared = squares(measurement, found.said);
    found.rms = std::sqrt(squared / points);
    require(std::isfinite(found.rms), "a law's answers are finite");
    const int degrees = points - (found.fitted ? 1 : 0);
    if (!measurement.scatter || degrees < 1) {
        return found;
    }
    found.p = chance(measurement, squared, degrees);
    if (*found.p < kRare) {
        found.verdict = Verdict::differs;
    } else if (!measurement.law->without ||
               chance(measurement, squares_without(measurement), points) < kRare) {
        found.verdict = Verdict::holds;
    }
    return found;
}

}  // namespace limpet::measured
