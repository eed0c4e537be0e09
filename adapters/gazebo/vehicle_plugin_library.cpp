// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/vehicle_plugin.hpp"

namespace limpet::gazebo11 {

GZ_REGISTER_MODEL_PLUGIN(VehiclePlugin)

}  // namespace limpet::gazebo11
