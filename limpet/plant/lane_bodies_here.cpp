// SPDX-License-Identifier: Apache-2.0
//
// Compiled once for every kind of machine (limpet_for_machines), which says LIMPET_LANES, how many
// numbers a vector holds, and LIMPET_LANES_HERE, what the function is called.
#include "limpet/plant/lane_bodies_of.hpp"

namespace limpet::plant {

extern "C" LaneBodies* LIMPET_LANES_HERE(const ReducedModel& model) {
    return new LaneBodiesOf<LIMPET_LANES>(model);  // NOLINT(*-owning-memory)
}

}  // namespace limpet::plant
