// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "command_line.hpp"

namespace limpet::app {

/// Every verb of the program, in the order of --help; apps/limpet/CMakeLists.txt lists them.
[[nodiscard]] std::vector<Verb> all_verbs();

}  // namespace limpet::app
