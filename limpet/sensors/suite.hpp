// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <tuple>

#include "limpet/sensors/registry.hpp"

namespace limpet::sensors {

/// The vehicle's sensors: what they are and where they sit.
struct SensorsModel {
    SensorParameters parameters;
    bool has_cup = true;  ///< LiDARs, force and pressure belong to the perching mechanism
    SensorMounts mounts = {};
    double altitude_m = 0.0;  ///< of W's origin above sea level
};

/// All units of a registry's sensors.
template <class List>
struct UnitsOf;
template <class... All>
struct UnitsOf<TypeList<All...>> {
    std::tuple<std::array<SensorUnit<All>, All::kStreams.size()>...> units;

    template <class Self, class Each>
    static void visit_members(Self& self, Each&& each) {
        std::apply(each, self.units);
    }
};

/// Everything that changes while they measure. Each sensor draws from a stream of its own, and as
/// many numbers a sample whatever its parameters: changing one leaves the others' readings as they
/// were.
struct SensorsState {
    UnitsOf<Sensors> sensors;
    Readings readings;  ///< what has arrived so far

    /// Both units of LiDARs, the one of any other.
    template <class Sensor>
    [[nodiscard]] const auto& units() const {
        return std::get<std::array<SensorUnit<Sensor>, Sensor::kStreams.size()>>(sensors.units);
    }
};

/// Switches the sensors on: draws the biases of this flight. No reading yet.
/// @param truth  at the start, the first end of the IMU's first interval
/// @param noise  in the seed's place, if any
[[nodiscard]] SensorsState start(const SensorsModel& model, const Truth& truth, std::uint64_t seed,
                                 std::uint32_t run, const NoiseBlend& noise = {});

/// Takes the samples that are due and hands out those that arrive. Once every base tick, in order.
/// @param truth  of this tick
/// @param plant  for the LiDARs' rays, at the same instant as `truth`
/// @param earth  of W, at that instant
void sense(const SensorsModel& model, SensorsState& state, const Truth& truth,
           const plant::Plant& plant, Tick tick, const EarthMotion& earth = EarthMotion::kStill);

}  // namespace limpet::sensors
