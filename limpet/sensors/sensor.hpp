// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "limpet/core/parameters.hpp"
#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"
#include "limpet/sensors/delay_line.hpp"
#include "limpet/sensors/noise.hpp"

namespace limpet::plant {
class Plant;
}

namespace limpet::sensors {

// A sensor is a file with a struct and its place in registry.hpp. The struct says
//
//   Reading             what it measures
//   kStreams            its random numbers, one stream a unit that is fitted (core/random.hpp:
//                       10..29 are the sensors')
//   kOnCup              whether it belongs to the perching mechanism: without a cup there is none
//   Parameters          its numbers with their defaults, named apart from all other sensors'. Noise
//                       and bias are standard deviations
//   table()             their rows in the YAML section `sensors`
//   kRate_Hz            which of them is its rate, an int; 0: not fitted
//   kLatency_s          which of them says how late it arrives, if it does
//   State               of one unit, plain and copyable: BiasedSensor where that is enough
//   kBias               which number is the bias, to be drawn at the start, if there is one;
//                       start() in its place, (Parameters, RandomStream, Truth), where it is more
//   measure()           (Parameters, State, SensorView) the reading of now; nothing when lost.
//                       Draws as many numbers whatever happens, so that a dropout moves nothing
//                       else
//
// and where its samples go: to those who read them by name,
//
//   kReadings           the fields of Readings, one a unit
//
// or, with nobody in the loop to read them, to the recording alone:
//
//   kTopic, kMessage    "/sensors/NAME", "limpet_msgs/msg/Name"
//   kColumns            names of the numbers, with their units
//   numbers(Reading)    as many

/// Where sensors sit that are not at B's origin: known to the vehicle, not to `sensors:`.
struct SensorMounts {
    std::array<Vector3, 2> lidar_p_B_m = {Vector3{0.205, -0.205, 0.0}, Vector3{0.205, 0.205, 0.0}};
};

/// Of W against the earth, where W goes along with a hull: for what measures against the earth.
struct EarthMotion {
    Vector3 p_EW_W_m = Vector3::Zero();  ///< since the beginning
    Vector3 v_EW_W_m_s = Vector3::Zero();
    static const EarthMotion kStill;
};
inline const EarthMotion EarthMotion::kStill = {};

/// What a unit looks at, at one instant.
struct SensorView {
    const Truth& truth;
    const SensorMounts& mounts;
    const plant::Plant* plant = nullptr;  ///< for rays
    std::size_t unit = 0;                 ///< which one looks
    double altitude_m = 0.0;              ///< of W's origin above sea level
    const EarthMotion& earth = EarthMotion::kStill;
};

/// What a unit of most sensors remembers.
struct BiasedSensor {
    RandomStream random;
    double bias = 0.0;  ///< of this flight, in the reading's unit
};

/// A place for what is not there.
struct Nothing {
    template <class Self, class Each>
    static void visit_members(Self& /*self*/, Each&& /*each*/) {}
};

template <class Sensor>
inline constexpr bool kIsLate = requires {
    Sensor::kLatency_s;
};
template <class Sensor>
inline constexpr bool kIsRead = requires {
    Sensor::kReadings;
};

/// All of one unit that changes.
template <class Sensor>
struct SensorUnit {
    using Reading = typename Sensor::Reading;
    typename Sensor::State state;
    std::conditional_t<kIsLate<Sensor>, DelayLine<Reading>, Nothing> line = {};
    std::conditional_t<kIsRead<Sensor>, Nothing, Sample<Reading>> heard = {};  ///< by nobody
};

/// Switches a unit on: draws the biases of this flight.
/// @param truth  at the start
template <class Sensor>
[[nodiscard]] SensorUnit<Sensor> start_unit(const typename Sensor::Parameters& parameters,
                                            const RandomStream& random, const Truth& truth) {
    SensorUnit<Sensor> unit{.state = {.random = random}};
    if constexpr (requires { Sensor::start(parameters, random, truth); }) {
        unit.state = Sensor::start(parameters, random, truth);
    } else if constexpr (requires { Sensor::kBias; }) {
        unit.state.bias = parameters.*Sensor::kBias * unit.state.random.normal();
    }
    return unit;
}

/// Takes the sample that is due and hands out what arrives.
/// @param latest  stays as it is when nothing arrives
template <class Sensor>
void sense(const typename Sensor::Parameters& parameters, SensorUnit<Sensor>& unit,
           const SensorView& view, Tick tick, Sample<typename Sensor::Reading>& latest) {
    if (sampled(tick, parameters.*Sensor::kRate_Hz)) {
        if (const auto measured = Sensor::measure(parameters, unit.state, view)) {
            if constexpr (kIsLate<Sensor>) {
                unit.line.send({.time_s = view.truth.time_s, .value = *measured},
                               arrival(tick, parameters.*Sensor::kLatency_s));
            } else {
                latest = {.time_s = view.truth.time_s, .value = *measured};
            }
        }
    }
    if constexpr (kIsLate<Sensor>) {
        unit.line.deliver(tick, latest);
    }
}

}  // namespace limpet::sensors
