// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/suction_cup_plugin.hpp"

namespace limpet::gazebo11 {

GZ_REGISTER_MODEL_PLUGIN(SuctionCupPlugin)

}  // namespace limpet::gazebo11
