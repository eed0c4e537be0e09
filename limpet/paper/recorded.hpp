// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace limpet::paper {

/// A flight, or flights, of parts that are not at hand here, flown elsewhere and kept:
/// data/paper/recorded/NAME.json, by data/paper/record or tests/px4/real.
/// @throws InputError when it is none
[[nodiscard]] nlohmann::json read_recorded(const std::string& name);

}  // namespace limpet::paper
