// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "limpet/core/errors.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/core/random.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/core/time.hpp"

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
// or, where no station reads them, to the recording alone:
//
//   kTopic, kMessage    "/sensors/NAME", "limpet_msgs/msg/Name"
//   kColumns            names of the numbers, with their units
//   numbers(Reading)    as many

/// One step of a bias that wanders and forgets: b <- keep b + kick n, n standard normal.
struct GaussMarkov {
    double keep = 1.0;
    double kick = 0.0;
};

/// Exact solution of db = -b / tau dt + walk dW over a step.
/// @param walk   density of the driving noise [unit of b / s / rtHz], >= 0
/// @param tau_s  correlation time, > 0; for dt << tau this is a random walk of walk * sqrt(t)
[[nodiscard]] inline GaussMarkov gauss_markov(double walk, double tau_s, double dt_s) {
    return {.keep = std::exp(-dt_s / tau_s),
            .kick = walk * std::sqrt(-0.5 * tau_s * std::expm1(-2.0 * dt_s / tau_s))};
}

/// @param step  of the reading, >= 0; 0 leaves the value as it is
[[nodiscard]] inline double quantised(double value, double step) {
    return step > 0.0 ? step * std::round(value / step) : value;
}

/// due() for a rate that comes from a parameter; one below 1 Hz is never due.
[[nodiscard]] inline bool sampled(Tick tick, int rate_Hz) {
    constexpr auto kSecond = static_cast<std::uint32_t>(kTicksPerSecond);
    const auto within = static_cast<std::uint32_t>(tick % kTicksPerSecond);  // one for all sensors
    const auto rate = static_cast<std::uint32_t>(rate_Hz);
    return rate_Hz >= 1 && within * rate % kSecond < rate;
}

/// Samples that can be under way at once; the parameter table's limits stay below it.
inline constexpr std::size_t kDelayLineCapacity = 64;

/// Samples on their way from the sensor to the reader: first in, first out, no heap.
template <class T>
class DelayLine {
public:
    /// @param arrival  tick at which deliver() hands it out, never before that of an earlier sample
    void send(const Sample<T>& sample, Tick arrival) {
        require(count_ < kDelayLineCapacity, "a sensor's delay line has space");
        slots_[(first_ + count_) % kDelayLineCapacity] = {.sample = sample, .arrival = arrival};
        ++count_;
    }

    /// Overwrites `latest` with the newest sample that has arrived by `now`; leaves it when none
    /// has.
    void deliver(Tick now, Sample<T>& latest) {
        while (count_ > 0 && slots_[first_].arrival <= now) {
            latest = slots_[first_].sample;
            first_ = (first_ + 1) % kDelayLineCapacity;
            --count_;
        }
    }

    template <class Self, class Each>
    static void visit_members(Self& self, Each&& each) {
        each(self.slots_, self.first_, self.count_);
    }

private:
    struct Slot {
        Sample<T> sample;
        Tick arrival = 0;
    };
    std::array<Slot, kDelayLineCapacity> slots_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
};

/// @return the tick at which a sample of `tick` arrives, to the nearest tick
[[nodiscard]] inline Tick arrival(Tick tick, double latency_s) {
    return tick + std::llround(latency_s / kTick_s);
}

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
    std::conditional_t<kIsRead<Sensor>, Nothing, Sample<Reading>> heard =
        {};  ///< that no station reads
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
