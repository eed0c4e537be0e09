// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/scenario/yaml_tree.hpp"
#include "limpet/suction/surface.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::scenario {

// A scenario's parts that live in files of their own: vehicles/*.yaml and the rows of
// surfaces.yaml. In a scenario each is a name, or a section that changes one:
//
//   vehicle: perching_uav
//   vehicle: {base: perching_uav, slider: {stiffness_N_m: 400}}
//
// A section without `base` starts from the struct's defaults, those that `limpet params` prints.
// All of them throw InputError.

/// @param wanted  name in root/vehicles, or a path
/// @param root    data_root()
[[nodiscard]] vehicle::Airframe load_vehicle(const std::string& wanted,
                                             const std::filesystem::path& root);
/// @param name  key of root/surfaces.yaml
[[nodiscard]] suction::Surface load_surface(const std::string& name,
                                            const std::filesystem::path& root);
/// @return all of them, in the file's order
[[nodiscard]] std::vector<suction::Surface> load_surfaces(const std::filesystem::path& root);

/// @param folder  of the scenario, from which a vehicle's relative path counts
[[nodiscard]] vehicle::Airframe vehicle_from(const YamlNode& node,
                                             const std::filesystem::path& root,
                                             const std::filesystem::path& folder);
[[nodiscard]] suction::Surface surface_from(const YamlNode& node,
                                            const std::filesystem::path& root);

}  // namespace limpet::scenario
