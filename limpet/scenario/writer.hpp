// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/scenario/scenario.hpp"

namespace limpet::scenario {

/// A scenario as YAML that stands for itself: vehicle and surfaces are spelled out, so that it
/// flies the same when their files have changed. Loading it gives the same numbers, bit by bit.
/// What derive() works out is left out, so that changing the mass of a replay changes its hover
/// thrust.
[[nodiscard]] std::string to_yaml(const Scenario& scenario);

}  // namespace limpet::scenario
