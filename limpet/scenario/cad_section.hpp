// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/scenario/yaml_tree.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::scenario {

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

}  // namespace limpet::scenario
