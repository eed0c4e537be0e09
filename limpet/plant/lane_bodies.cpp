// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/lane_bodies.hpp"

#include <algorithm>

namespace limpet::plant {

extern "C" {
LaneBodies* limpet_lane_bodies_anywhere(const ReducedModel& model);
#if defined(LIMPET_LANES_X86)
LaneBodies* limpet_lane_bodies_avx2(const ReducedModel& model);
LaneBodies* limpet_lane_bodies_avx512(const ReducedModel& model);
#endif
}

std::span<const LaneKind> lane_kinds() {
    static const LaneKind kKinds[] = {
#if defined(LIMPET_LANES_X86)
        {"avx512", 8, &limpet_lane_bodies_avx512,
         __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl")},
        {"avx2", 4, &limpet_lane_bodies_avx2, __builtin_cpu_supports("avx2") != 0},
#endif
        {"anywhere", 2, &limpet_lane_bodies_anywhere, true},
    };
    return kKinds;
}

const LaneKind& widest_lanes() {
    const auto kinds = lane_kinds();
    return *std::find_if(kinds.begin(), kinds.end(),
                         [](const LaneKind& kind) { return kind.runs_here; });
}

}  // namespace limpet::plant
