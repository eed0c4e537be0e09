// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/scenario/scenario.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::scenario {

/// What no single row of a table can say: values that must fit each other.
/// @param root  the text with its overrides, for the place in the message
/// @throws InputError for the first that does not fit
void check(const Scenario& scenario, const YamlNode& root);

}  // namespace limpet::scenario
