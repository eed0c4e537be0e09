// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/frames.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/core/random.hpp"

namespace limpet::suction {

/// What a cup meets, in numbers: a row of surfaces.yaml without its texts. Defaults: porous
/// concrete. Pressures and time constants are Table II of the paper; the rest is assumed, see
/// surfaces.yaml.
struct Surface {
    double vacuum_pressure_Pa = 65000.0;    ///< P_vac of eqs. (5), (6), absolute
    double sealing_time_constant_s = 0.33;  ///< tau_1
    double sealing_time_tolerance_s = 0.03;
    double unsealing_time_constant_s = 0.40;  ///< tau_2
    double unsealing_time_tolerance_s = 0.03;
    double friction = 0.8;                  ///< mu of the lip
    double seal_threshold_median_N = 31.5;  ///< press force that seals, log-normal
    double seal_threshold_sigma = 0.30;     ///< of its logarithm
    double seal_tilt_median_deg = 14.0;     ///< tilt at which half of the touches fail to seal
    double seal_tilt_sigma_deg = 3.0;
    bool pump_cycles = false;       ///< tight enough for the pump to switch off
    double pump_ripple_Pa = 600.0;  ///< amplitude while the pump runs
    double pump_ripple_Hz = 8.0;
    double pore_volume_cm3 = 78.6;          ///< of the wall, pumped out with the cup (pneumatic)
    double leak_conductance_cm3_s = 347.0;  ///< at 100 N of clamping (pneumatic)
    double leak_clamping_exponent = 0.425;  ///< it falls with this power of the clamping force
};

[[nodiscard]] const ParameterTable<Surface>& surface_table();

/// What a pressure model (pressure_model.hpp) receives of a sealed cup, each step.
struct SealedAir {
    const Surface& surface;     ///< of the spot under the cup
    double radius_m = 0.0;      ///< sealed
    double press_N = 0.0;       ///< presses the lip beyond the vacuum, < 0: the vehicle pulls
    double peel_N_m = 0.0;      ///< moment that presses one side of the lip more than the other
    double pressure_Pa = 0.0;   ///< absolute, mean over the pump's strokes
    bool pump_resting = false;  ///< so far
    bool pump_running = false;
    bool valve_open = false;
    double hole_mm2 = 0.0;               ///< to the atmosphere, beyond the lip's own leak
    double ambient_Pa = kAtmosphere_Pa;  ///< of the air around
    double leak_growth = 0.0;     ///< what the seal leaks more than when it was fresh, over that
    double press_before_N = 0.0;  ///< as press_N, a step ago; that of a fresh seal now
};

/// What this touch needs in order to seal: drawn when the lip meets the wall, because roughness and
/// the spot that is hit differ from touch to touch (paper, section II.D).
struct SealDemand {
    double threshold_N = 0.0;     ///< press force to pass
    double tilt_limit_rad = 0.0;  ///< tilt to stay below
};

[[nodiscard]] SealDemand draw_seal_demand(const Surface& surface, RandomStream& random);

/// @param press_N   force that presses the cup on the wall through its mechanism, > 0 presses [N]
/// @param tilt_rad  angle between the lip's plane and the wall, >= 0 [rad]
[[nodiscard]] bool seals(const SealDemand& demand, double press_N, double tilt_rad);

}  // namespace limpet::suction
