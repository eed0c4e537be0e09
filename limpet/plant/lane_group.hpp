// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "limpet/plant/lane_bodies.hpp"

namespace limpet::plant {

/// Missions of one thread side by side: each runs on a stack of its own until its plant is to step,
/// and when all have come there they step together (LaneBodies). The missions know nothing of it:
/// while they run, plants of the reduced engine are lanes.
///
/// Calls `missions` once a lane, where memory is short in fewer; returns when all have returned.
/// Each flies as many missions one after the other as it likes; where none is in the air its lane
/// is idle.
/// @throws whatever `missions` throws, when all are over; std::bad_alloc before one has begun
void fly_side_by_side(const std::function<void()>& missions, const LaneKind& kind = widest_lanes());

/// A lane for a plant of this thread's running mission; null: there is none, or it has one.
[[nodiscard]] std::unique_ptr<Plant> free_lane(const std::shared_ptr<const ReducedModel>& model);

}  // namespace limpet::plant
