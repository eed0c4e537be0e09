// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "limpet/scenario/scenario.hpp"

namespace limpet::lab {

/// Sections with rows and choices (Lab::schema()).
[[nodiscard]] nlohmann::json schema_of(scenario::Scenario scenario);

}  // namespace limpet::lab
