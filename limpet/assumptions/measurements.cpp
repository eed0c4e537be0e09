// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "limpet/assumptions/assumptions.hpp"

namespace limpet::assumptions {
namespace {

constexpr std::string_view kChoice = "nothing: a choice, known for a vehicle of your own";

/// Beginnings of keys, the longer ones first.
constexpr std::array kMeasurements = {
    Measurement{"vehicle.inertia_kg_m2.", "a bifilar pendulum"},
    Measurement{"vehicle.rotor.", "a thrust stand, or motor speeds over steps of the command"},
    Measurement{"vehicle.slider.", "a spring balance and a ruler on the slider; its swing filmed"},
    Measurement{"vehicle.cup.", "a spring balance on the cup, turned; its swing filmed"},
    Measurement{"vehicle.legs.friction", "a spring balance on a leg along the wall"},
    Measurement{"vehicle.battery.", "a log of voltage and current over a flight"},
    Measurement{"vehicle.payload.", "a spring balance and a ruler on the cable"},
    Measurement{"wall.surface.friction", "a spring balance along the wall, pump on"},
    Measurement{"wall.surface.seal_", "a spring balance: the press that seals, on the wall"},
    Measurement{"wall.surface.pump_ripple", "a pressure log of a hold on the wall"},
    Measurement{"suction.open_time_constant_s", "a pressure log of one release"},
    Measurement{"suction.pump_", "a pressure log of one pump-down into the closed cup"},
    Measurement{"suction.shear_", "a spring balance on the cup along the wall; its swing filmed"},
    Measurement{"suction.t", "a spring balance on the cup, tilted and turned; its swing filmed"},
    Measurement{"sensors.", "a log of the sensor at rest, beside a second one"},
    Measurement{"environment.", "an anemometer, and a log of a hover near the wall"},
    Measurement{"guidance.", kChoice},
};

/// In metres, not in newtons or kilograms by, or times, metres.
bool is_length(std::string_view key) {
    constexpr std::array<std::string_view, 4> kOthers = {"_N_m", "_s_m", "_kg_m", "_V_m"};
    return key.ends_with("_m") &&
           std::none_of(kOthers.begin(), kOthers.end(),
                        [key](std::string_view other) { return key.ends_with(other); });
}

}  // namespace

std::span<const Measurement> measurements() {
    return kMeasurements;
}

bool is_measured(std::string_view by) {
    return !by.empty() && by != kChoice;
}

std::string_view measurement_of(std::string_view key) {
    if (key.ends_with("mass_kg")) {
        return "scales";
    }
    const bool of_a_part = key.starts_with("vehicle.") || key.starts_with("wall.");
    if (of_a_part && is_length(key)) {
        return "a ruler";
    }
    if (key.starts_with("sensors.") && key.ends_with("_Hz")) {
        return "its data sheet";
    }
    for (const auto& [of, by] : kMeasurements) {
        if (key.starts_with(of)) {
            return by;
        }
    }
    return {};
}

}  // namespace limpet::assumptions
