// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/sensors/sensor.hpp"

namespace limpet::sensors {

/// The power module. Its own error is far below what anybody decides on: none is added.
struct BatterySensor {
    using Reading = BatteryReading;
    struct Parameters {
        int battery_rate_Hz = 10;
    };
    using State = BiasedSensor;
    static constexpr std::array kStreams = {Stream::battery};
    static constexpr std::array kReadings = {&Readings::battery};
    static constexpr bool kOnCup = false;
    static constexpr auto kRate_Hz = &Parameters::battery_rate_Hz;
    // clang-format off
    [[nodiscard]] static const ParameterTable<Parameters>& table() {
        using P = Parameters;
        static const ParameterTable<P> table = {
            {"battery_rate_Hz", "Hz", 0.0, 1000.0, &P::battery_rate_Hz, "samples a second, whole; 0: not fitted", "assumed: a power module"},
        };
        return table;
    }
    // clang-format on

    [[nodiscard]] static std::optional<Reading> measure(const Parameters& /*p*/, State& /*state*/,
                                                        const SensorView& view) {
        const BatteryStatus& battery = view.truth.battery;
        return Reading{.voltage_V = battery.voltage_V,
                       .current_A = battery.current_A,
                       .remaining = battery.remaining};
    }
};

}  // namespace limpet::sensors
