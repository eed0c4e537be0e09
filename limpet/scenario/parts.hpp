// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limpet/scenario/surface.hpp"
#include "limpet/scenario/yaml_tree.hpp"
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
/// @param at    where it is requested, to be named when there is none
[[nodiscard]] Surface load_surface(const std::string& name, const std::filesystem::path& root,
                                   const YamlNode* at = nullptr);
/// @return all of them, in the file's order
[[nodiscard]] std::vector<Surface> load_surfaces(const std::filesystem::path& root);

/// Reads a vehicle's `model`, bodies and looks from a URDF instead of made ones:
///
///   model:
///     urdf: cad/urdf/vehicle.urdf      # from this file's folder
///     links: {base: base_link, carriage: slider_link, cup_yoke: yoke_link, cup: cup_link}
///     joints: {slider: slider_joint, cup_pitch: pitch_joint, cup_yaw: yaw_joint}
///
/// What is not named is called as ours are. mass_kg, inertia_kg_m2, slider.mass_kg, cup.mass_kg,
/// cup.mass_offset_m, cup.joint_x_m and cup.joint_z_m follow from it; a vehicle that states them
/// must agree within 1 % (or 1 mm).
/// @param vehicle  the whole map; without `model` an airframe that has a model already is checked
/// @param folder   from which the URDF's path counts
/// @throws InputError "file:line: key: what", of the YAML file or of the URDF
void read_model(const YamlNode& vehicle, const std::filesystem::path& folder,
                vehicle::Airframe& airframe);

/// @param folder     of the scenario, from which a vehicle's relative path counts
/// @param inherited  null, or what becomes the keys that nobody gives
[[nodiscard]] vehicle::Airframe vehicle_from(const YamlNode& node,
                                             const std::filesystem::path& root,
                                             const std::filesystem::path& folder,
                                             std::vector<std::string>* inherited = nullptr);
[[nodiscard]] Surface surface_from(const YamlNode& node, const std::filesystem::path& root);

}  // namespace limpet::scenario
