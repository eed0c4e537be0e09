// SPDX-License-Identifier: Apache-2.0
#include "gazebo/suction_cup_plugin.hpp"

namespace limpet {

GZ_REGISTER_MODEL_PLUGIN(SuctionCupPlugin)

}  // namespace limpet
