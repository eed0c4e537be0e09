// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "limpet/plant/plant.hpp"
#include "limpet/simulation/observe.hpp"
#include "limpet/simulation/state.hpp"

namespace limpet::simulation {

/// A run cut at a tick boundary: state, plant, and what has been seen of it.
struct Snapshot {
    FlightState state;
    plant::PlantState plant;
    Observations seen;
};

/// As bytes for a file or another process of the same build; allocates.
[[nodiscard]] std::vector<std::byte> to_bytes(const Snapshot& snapshot);
/// The same again, bit by bit.
/// @throws InputError when the bytes are damaged, or of a Limpet whose state is another
[[nodiscard]] Snapshot snapshot_from(std::span<const std::byte> bytes);

/// Where the state's real numbers are, in the order of the walk. They hold until the state is
/// assigned to, and a step may exchange what a ring's places mean (RotorsState).
[[nodiscard]] std::vector<double*> numbers_of(FlightState& state);

}  // namespace limpet::simulation
