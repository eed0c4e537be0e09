// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "limpet/core/random.hpp"

namespace limpet::campaign {

/// How the values of a varied key are spread.
enum class Spread {
    grid,       ///< each value in turn; grids of several keys multiply
    choice,     ///< one of the values, all alike
    uniform,    ///< between two ends
    normal,     ///< mean and sigma
    lognormal,  ///< median, and sigma of the logarithm
};

/// What a run sets a key to: a number, or a name (of a surface, a vehicle, a mission).
using SampledValue = std::variant<double, std::string>;

/// A key of a scenario that differs from run to run.
struct VariedKey {
    std::string key;  ///< as `--set` takes it: "guidance.dock_speed_m_s"
    Spread spread = Spread::grid;
    std::vector<SampledValue> values;  ///< of grid and choice: all numbers or all names
    double first = 0.0;                ///< low end, mean, median
    double second = 0.0;               ///< high end, sigma, sigma
    /// Of normal and lognormal: draws outside are drawn again.
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity();
    std::string place;  ///< where it is written, "campaigns/x.yaml:7"
};

/// Whether its values are names: such a key selects a whole part of the scenario.
[[nodiscard]] bool is_named(const VariedKey& key);

/// @return number of points of the grids together; 1 without any
[[nodiscard]] std::uint64_t grid_points(const std::vector<VariedKey>& keys);

/// @return which points of the grids so many runs leave out, or fly less often than others, in one
///         sentence; empty: all are flown alike
[[nodiscard]] std::string uneven_runs(const std::vector<VariedKey>& keys, std::uint64_t runs);

/// @return probability that a draw falls within from..to, 1 for other spreads than normal and
///         lognormal
[[nodiscard]] double share_within(const VariedKey& key);

/// What one run sets its keys to, in their order. Depends on nothing but its arguments, so neither
/// on the number of workers nor on their order. Run r flies the grid point r modulo grid_points():
/// a campaign that is cut short has gone as far everywhere. The last grid changes fastest.
[[nodiscard]] std::vector<SampledValue> draw(const std::vector<VariedKey>& keys, std::uint64_t seed,
                                             std::uint32_t run);

/// @return number of keys that are drawn, not set by a grid
[[nodiscard]] std::size_t drawn_keys(const std::vector<VariedKey>& keys);

/// What a run sets its keys to where each drawn one stands at a standard normal's place in its
/// spread: the inverse of the distribution at the normal's probability. Grids have one point.
/// @param normals  one a drawn key, in their order
[[nodiscard]] std::vector<SampledValue> sample_at(const std::vector<VariedKey>& keys,
                                                  const std::vector<double>& normals);

/// Checks before anything flies that no key is a grid of several values, which has no
/// probabilities.
/// @param what  is to be flown: "a study"
/// @throws InputError one line: the key and what is wrong with it
void require_no_grid(const std::vector<VariedKey>& keys, const char* what);

/// @return seed of a noise that nothing has drawn yet: a whole number that a double holds
[[nodiscard]] std::uint64_t noise_seed(RandomStream& random);

/// @return "1.1" or "porous_concrete", as YAML reads it back to the same bits
[[nodiscard]] std::string value_text(const SampledValue& value);

}  // namespace limpet::campaign
