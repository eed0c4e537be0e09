// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "limpet/stability/level_on_cup.hpp"

namespace limpet::stability {

/// `--set` texts that make a scenario another case.
using Overrides = std::vector<std::string>;

/// Growth and frequency of the pitch mode on the cup, by the linearised loop.
/// @throws InputError when the overrides do not make a scenario, or one without what is linearised:
///         a free vehicle with a cup before a wall, flown by the cascade at a rate that divides
///         1 kHz
/// @return none when the vehicle has no rest, or no swing in pitch
[[nodiscard]] std::optional<Mode> linear_swing(const std::string& scenario,
                                               const Overrides& overrides);
/// Such a function: linear_swing(), or one that a test puts in its place.
using SwingOf = std::function<std::optional<Mode>(const std::string&, const Overrides&)>;

struct Axis {
    std::vector<std::string> keys = {};  ///< that take each value together
    std::vector<double> values = {};     ///< in the keys' unit
};

/// Growth of the pitch mode over two numbers of a scenario.
struct StabilityMap {
    std::string scenario = {};  ///< all that is not on the axes
    Overrides changes = {};     ///< likewise
    Axis across = {}, up = {};
    std::vector<double> growth_1_s = {};  ///< [up * across.values.size() + across]

    [[nodiscard]] std::size_t size() const { return across.values.size() * up.values.size(); }
    [[nodiscard]] double at(std::size_t up_place, std::size_t across_place) const {
        return growth_1_s[up_place * across.values.size() + across_place];
    }
    /// All that makes the i-th point of it.
    [[nodiscard]] Overrides point(std::size_t i) const;
};

/// linear_swing() at the map's i-th point.
[[nodiscard]] std::optional<Mode> swing_at(const StabilityMap& map, std::size_t i);

}  // namespace limpet::stability
