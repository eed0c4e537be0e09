// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "limpet/core/frames.hpp"

namespace limpet {

/// A sealed cup at the beginning of a step.
struct CupPressureInput {
    double pressure_Pa = kAtmosphere_Pa;  ///< absolute
    bool pump_running = false;            ///< switched on, fed and not broken
    bool valve_open = false;
    double press_N = 0.0;                    ///< on the wall, < 0 pulled off
    double radius_m = 0.0;                   ///< of the sealed area
    double vacuum_pressure_Pa = 0.0;         ///< what pump and surface come to, P_vac of the paper
    double sealing_time_constant_s = 0.0;    ///< tau_1, towards P_vac
    double unsealing_time_constant_s = 0.0;  ///< tau_2, towards the atmosphere
    double dt_s = 0.0;                       ///< length of the step
    double ambient_Pa = kAtmosphere_Pa;      ///< of the air around
    double peel_N_m = 0.0;     ///< moment that presses one side of the lip more than the other
    double hole_mm2 = 0.0;     ///< to the atmosphere, beyond the lip's own leak: a torn lip or hose
    double leak_growth = 0.0;  ///< what the seal leaks more than when it was fresh, over that
};

/// How the pressure in a sealed cup goes on, in place of the built-in models; when it is sealed,
/// what it bears and when it lets go stay as they are. It has no state of its own: what it
/// remembers are numbers of the flight.
class CupPressure {
public:
    virtual ~CupPressure() = default;

    /// How many numbers it remembers; they begin as zeros.
    [[nodiscard]] virtual std::size_t memory_size() const { return 0; }
    /// Once a step of the plant, 0.25 to 1 ms, while the cup is sealed.
    /// @return the pressure after the step [Pa], 0..ambient_Pa
    [[nodiscard]] virtual double next_Pa(const CupPressureInput& air,
                                         std::span<double> memory) const = 0;
};

}  // namespace limpet
