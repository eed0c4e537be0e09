// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/study.hpp"

namespace limpet {
void study_rotors(Study& study) {
    study.sections.push_back({.id = "rotors", .blocks = {std::string("wip")}});
}
}  // namespace limpet
