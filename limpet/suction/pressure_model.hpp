// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "limpet/core/type_list.hpp"
#include "limpet/suction/pneumatics.hpp"
#include "limpet/suction/pressure.hpp"

namespace limpet::suction {

// How the pressure in a sealed cup goes on is a model's; when it is sealed is cup.hpp's, and off
// the wall every cup fills by FirstOrder's open_time_constant_s. A model is a file with a struct:
//
//   kName           as suction.pressure_model names it
//   Parameters      its numbers, with their defaults; names differ from all others of `suction:`
//   table()         their rows
//   pump_rests()    (Parameters, SealedAir) whether the pump of an attached cup rests between two
//                   refills
//   next_Pa()       (Parameters, SealedAir, dt_s) the pressure after a step, no heap
//
// and its place here. The first is the default.
using PressureModels = TypeList<FirstOrder, Pneumatic>;

struct PressureParameters : ParametersOf<PressureModels> {};

/// A model without its type.
struct PressureModel {
    std::string_view name;
    bool (*pump_rests)(const PressureParameters& parameters, const SealedAir& air);
    double (*next_Pa)(const PressureParameters& parameters, const SealedAir& air, double dt_s);
};

/// All, in the registry's order.
[[nodiscard]] std::span<const PressureModel> pressure_models();

}  // namespace limpet::suction
