// SPDX-License-Identifier: Apache-2.0
#include "limpet/sensors/suite.hpp"

#include "limpet/core/machines.hpp"

namespace limpet::sensors {
namespace {

/// Calls `visit(Type<Sensor>{}, unit, k)` for every sensor's k-th unit.
template <class Visit, class... All>
void for_each_unit(UnitsOf<TypeList<All...>>& sensors, Visit visit) {
    const auto of_one = [&](auto sensor, auto& units) {
        for (std::size_t k = 0; k < units.size(); ++k) {
            visit(sensor, units[k], k);
        }
    };
    std::apply([&](auto&... units) { (of_one(Type<All>{}, units), ...); }, sensors.units);
}

}  // namespace

SensorsState start(const SensorsModel& model, const Truth& truth, std::uint64_t seed,
                   std::uint32_t run, const NoiseBlend& noise) {
    SensorsState state;
    for_each_unit(state.sensors, [&](auto type, auto& unit, std::size_t k) {
        using Sensor = typename decltype(type)::type;
        unit = start_unit<Sensor>(model.parameters,
                                  RandomStream(seed, run, Sensor::kStreams[k], noise), truth);
    });
    return state;
}

LIMPET_FOR_MACHINES void sense(const SensorsModel& model, SensorsState& state, const Truth& truth,
                               const plant::Plant& plant, Tick tick, const EarthMotion& earth) {
    SensorView view{.truth = truth,
                    .mounts = model.mounts,
                    .plant = &plant,
                    .altitude_m = model.altitude_m,
                    .earth = earth};
    for_each_unit(state.sensors, [&](auto type, auto& unit, std::size_t k) {
        using Sensor = typename decltype(type)::type;
        if (Sensor::kOnCup && !model.has_cup) {
            return;
        }
        view.unit = k;
        if constexpr (kIsRead<Sensor>) {
            sense(model.parameters, unit, view, tick, state.readings.*Sensor::kReadings[k]);
        } else {
            sense(model.parameters, unit, view, tick, unit.heard);
        }
    });
}

}  // namespace limpet::sensors
