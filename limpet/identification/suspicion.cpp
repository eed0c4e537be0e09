// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/suspicion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace limpet::identification {
namespace {

/// The value below which a share of them lies.
double quantile(std::vector<double> values, double share) {
    const auto last = static_cast<double>(values.size() - 1);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * last);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Where the atmosphere lies in a unit, from 9 km up down to a deep valley.
struct Unit {
    const char* name;
    double pascals;
};
constexpr std::array<Unit, 4> kPressureUnits = {
    {{"hPa", 100.0}, {"kPa", 1e3}, {"psi", 6895.0}, {"bar", 1e5}}};
constexpr double kLowestAtmosphere_Pa = 30e3, kHighestAtmosphere_Pa = 115e3;

}  // namespace

std::string suspected_pressure_unit(const std::vector<double>& pressure_Pa, double atmosphere_Pa) {
    constexpr double kFewSamples = 0.02;  ///< of all, that may be wild
    constexpr double kNearZero = 0.03;  ///< of the most: no pump of a cup comes so near to nothing
    constexpr double kNearAtmosphere = 0.9;
    if (pressure_Pa.empty()) {
        return {};
    }
    const double low = quantile(pressure_Pa, kFewSamples);
    const double high = quantile(pressure_Pa, 1.0 - kFewSamples);
    const std::string runs = fmt::format("pressure_Pa runs from {:.4g} to {:.4g}", low, high);
    if (low < -kNearZero * std::max(high, -low)) {
        return runs + ": gauge pressure? It must be absolute, in Pa: add the atmosphere's";
    }
    if (high >= kNearAtmosphere * atmosphere_Pa) {
        return {};
    }
    if (low <= kNearZero * high) {
        return runs +
               ": vacuum as a positive gauge pressure? It must be absolute, in Pa: the "
               "atmosphere's less it";
    }
    for (const Unit& unit : kPressureUnits) {
        if (high * unit.pascals >= kLowestAtmosphere_Pa &&
            high * unit.pascals <= kHighestAtmosphere_Pa) {
            return fmt::format("{}: {}? It must be in Pa: times {:g}", runs, unit.name,
                               unit.pascals);
        }
    }
    return {};
}

double median_step_s(const std::vector<double>& t_s) {
    if (t_s.size() < 2) {
        return 0.0;
    }
    std::vector<double> steps(t_s.size() - 1);
    std::transform(t_s.begin() + 1, t_s.end(), t_s.begin(), steps.begin(), std::minus<>());
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

std::string suspected_time_unit(const std::vector<double>& t_s) {
    constexpr double kSlowest_s = 1.0;  ///< a sample a second: slower shows nothing of a cup
    const double step = median_step_s(t_s);
    if (step < kSlowest_s) {
        return {};
    }
    const auto& [unit, factor] = step < 1e3   ? std::pair("milliseconds", 1e-3)
                                 : step < 1e6 ? std::pair("microseconds", 1e-6)
                                              : std::pair("nanoseconds", 1e-9);
    return fmt::format("t_s steps by {:.4g} from sample to sample: {}? It must be in s: times {:g}",
                       step, unit, factor);
}

}  // namespace limpet::identification
