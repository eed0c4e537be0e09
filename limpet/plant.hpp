// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Rigid bodies of your own under the loop: a PlantModel makes a Plant for every flight, the Plant
/// takes wrenches and answers where its bodies are. It saves and restores itself as numbers.
#include "limpet/plant/plant.hpp"

namespace limpet {

using plant::Body;
using plant::Plant;
using plant::PlantModel;
using plant::PlantState;
using plant::SliderMotion;
using plant::StepMode;

}  // namespace limpet
