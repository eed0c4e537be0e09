// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/faults/fault.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::scenario {

// The table `faults:`, a list; a single one may stand for itself, so that its keys can be set and
// spread (`--set faults.fault=motor_lost`):
//
//   faults:
//     - {fault: motor_weak, unit: 2, size: 0.6, phase: approaching, after_s: 0.2, for_s: 1.5}
//     - {fault: pressure_stuck, at_s: 5}

/// @param rotors  that the vehicle has
/// @throws InputError in a line
[[nodiscard]] std::vector<faults::Fault> read_faults(const YamlNode& node, std::size_t rotors);

/// @return one row as YAML reads it back to the same bits: "{fault: motor_lost, unit: 2, at_s: 5}"
[[nodiscard]] std::string fault_text(const faults::Fault& fault);

/// All kinds, with size and unit.
[[nodiscard]] std::vector<CatalogueEntry> list_faults();

/// Sensors had fault keys of their own once; recordings of then carry them, set to never.
/// @param sensors  the section, or null
/// @throws InputError that names the row to write instead
void refuse_fault_keys(const YamlNode* sensors);
inline constexpr std::array<std::string_view, 5> kFormerFaultKeys = {
    "lidar_left_fails_at_s", "lidar_right_fails_at_s", "mocap_fails_at_s", "force_fails_at_s",
    "pressure_stuck_at_s"};

}  // namespace limpet::scenario
