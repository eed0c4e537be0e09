// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/surface.hpp"

#include <algorithm>

namespace limpet::suction {

const ParameterTable<Surface>& surface_table() {
    using S = Surface;
    static const ParameterTable<S> table = {
        {"vacuum_pressure_Pa", "Pa", 1000.0, 101324.0, &S::vacuum_pressure_Pa,
         "steady pressure inside the sealed cup, pump running (P_vac), at sea level",
         "paper, Table II"},
        {"sealing_time_constant_s", "s", 1e-3, 1e3, &S::sealing_time_constant_s,
         "pressure falls with it while the pump runs (tau_1)", "paper, Table II"},
        {"sealing_time_tolerance_s", "s", 0.0, 1e3, &S::sealing_time_tolerance_s,
         "measured spread of tau_1", "paper, Table II"},
        {"unsealing_time_constant_s", "s", 1e-3, 1e4, &S::unsealing_time_constant_s,
         "pressure rises with it once the pump is off (tau_2)", "paper, Table II"},
        {"unsealing_time_tolerance_s", "s", 0.0, 1e4, &S::unsealing_time_tolerance_s,
         "measured spread of tau_2", "paper, Table II"},
        {"friction", "-", 0.0, 3.0, &S::friction, "Coulomb friction of the lip",
         "assumed: rubber on masonry"},
        {"seal_threshold_median_N", "N", 0.0, 1e4, &S::seal_threshold_median_N,
         "press force that seals half of the touches", "assumed: fits Fig. 3's limits"},
        {"seal_threshold_sigma", "-", 0.0, 2.0, &S::seal_threshold_sigma,
         "spread of the threshold's logarithm from touch to touch (roughness)",
         "assumed: fits Fig. 3's limits"},
        {"seal_tilt_median_deg", "deg", 0.0, 90.0, &S::seal_tilt_median_deg,
         "tilt between lip and wall at which half of the touches fail to seal", "assumed"},
        {"seal_tilt_sigma_deg", "deg", 0.0, 45.0, &S::seal_tilt_sigma_deg,
         "spread of that tilt from touch to touch", "assumed"},
        {"pump_cycles", "switch", 0.0, 1.0, &S::pump_cycles,
         "tight enough for the pump to switch off between refills", "paper, section V.B"},
        {"pump_ripple_Pa", "Pa", 0.0, 1e4, &S::pump_ripple_Pa,
         "amplitude of the pressure ripple while the pump runs", "assumed"},
        {"pump_ripple_Hz", "Hz", 0.0, 400.0, &S::pump_ripple_Hz,
         "frequency of that ripple as the pressure sensor sees it", "assumed"},
        {"pore_volume_cm3", "cm^3", 0.0, 1e5, &S::pore_volume_cm3,
         "pneumatic: air in the wall that is pumped out with the cup's", "fitted to Table II"},
        {"leak_conductance_cm3_s", "cm^3/s", 0.0, 1e6, &S::leak_conductance_cm3_s,
         "pneumatic: leak over the vacuum, at 100 N between lip and wall", "fitted to Table II"},
        {"leak_clamping_exponent", "-", 0.0, 0.95, &S::leak_clamping_exponent,
         "pneumatic: the leak falls with this power of the force between lip and wall",
         "fitted to Table II"},
    };
    return table;
}

SealDemand draw_seal_demand(const Surface& surface, RandomStream& random) {
    SealDemand demand;
    demand.threshold_N =
        random.lognormal(surface.seal_threshold_median_N, surface.seal_threshold_sigma);
    demand.tilt_limit_rad = radians(std::max(
        0.0, surface.seal_tilt_median_deg + surface.seal_tilt_sigma_deg * random.normal()));
    return demand;
}

bool seals(const SealDemand& demand, double press_N, double tilt_rad) {
    return press_N > demand.threshold_N && tilt_rad < demand.tilt_limit_rad;
}

}  // namespace limpet::suction
