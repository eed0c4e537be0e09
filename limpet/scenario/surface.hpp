// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/suction/surface.hpp"

namespace limpet::scenario {

/// A row of surfaces.yaml with its texts.
struct Surface : suction::Surface {
    std::string name = "porous_concrete";
    std::string description;
    std::string source;
};

}  // namespace limpet::scenario
