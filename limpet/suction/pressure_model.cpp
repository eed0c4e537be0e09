// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/pressure_model.hpp"

#include <array>

namespace limpet::suction {
namespace {

template <class... Models>
constexpr std::array<PressureModel, sizeof...(Models)> rows(TypeList<Models...> /*list*/) {
    return {{{.name = Models::kName,
              .pump_rests = [](const PressureParameters& p,
                               const SealedAir& air) { return Models::pump_rests(p, air); },
              .next_Pa = [](const PressureParameters& p, const SealedAir& air,
                            double dt_s) { return Models::next_Pa(p, air, dt_s); }}...}};
}

constexpr auto kModels = rows(PressureModels{});

}  // namespace

std::span<const PressureModel> pressure_models() {
    return kModels;
}

}  // namespace limpet::suction
