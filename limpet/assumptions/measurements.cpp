// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "limpet/assumptions/assumptions.hpp"

namespace limpet::assumptions {
namespace {

/// Beginnings of keys, the longer ones first.
struct Measurement {
    std::string_view of;
    std::string_view by;
};
constexpr std::array kMeasurements = {
    Measurement{"vehicle.slider.", "a spring balance and a ruler on the slider; its swing filmed"},
    Measurement{"vehicle.joint.", "a spring balance on the cup's joint; its swing filmed"},
    Measurement{"vehicle.cup.", "a spring balance on the cup, pressed, pulled and turned"},
    Measurement{"vehicle.rotor.",
                "a thrust stand, or a log of motor speeds over steps of the command"},
    Measurement{"vehicle.battery.", "a log of voltage and current over a flight"},
    Measurement{"vehicle.inertia", "a bifilar pendulum"},
    Measurement{"vehicle.legs", "a ruler; a spring balance against a leg"},
    Measurement{"vehicle.", "scales and a ruler"},
    Measurement{"suction.pump", "a pressure log of one pump-down into the closed cup"},
    Measurement{"suction.tau", "a pressure log of one pump-down and one release"},
    Measurement{"suction.release", "a pressure log of one release"},
    Measurement{"suction.leak", "a pressure log with the pump off, on the wall"},
    Measurement{"suction.threshold",
                "a spring balance: the press at which the cup seals, on the wall"},
    Measurement{"suction.friction", "a spring balance along the wall, pump on"},
    Measurement{"suction.", "a pressure log and a spring balance, cup on the wall"},
    Measurement{"wall.surface.friction", "a spring balance along the wall, pump on"},
    Measurement{"wall.surface.pump", "a pressure log of one pump-down into the closed cup"},
    Measurement{"guidance.", "nothing: a choice, known for a vehicle of your own"},
    Measurement{"wall.", "a spring balance and a pressure log on that wall"},
    Measurement{"sensors.", "a log of the sensor at rest and against a second one"},
    Measurement{"environment.", "an anemometer; a log of a hover"},
    Measurement{"autopilot.", "a log of a flight, by limpet calibrate"},
};

}  // namespace

std::string_view measurement_of(std::string_view key) {
    if (key.ends_with("mass_kg")) {
        return "scales";
    }
    const bool length = key.ends_with("_m") && !key.ends_with("N_m");
    if (length && key.starts_with("vehicle.")) {
        return "a ruler";
    }
    if (key.ends_with("_rate_Hz")) {
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
