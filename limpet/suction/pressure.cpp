// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/pressure.hpp"

#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::suction {
namespace {

constexpr double kValve_mm2 = kPi;  ///< of valve_time_constant_s: 2 mm across

/// Every airflow is dP/dt = (target - P) / tau.
struct Law {
    double target_Pa;
    double time_constant_s;
};

Law law(const Surface& surface, const FirstOrderParameters& cup, Airflow flow, double ambient_Pa) {
    switch (flow) {
        case Airflow::sealing: return {surface.vacuum_pressure_Pa, surface.sealing_time_constant_s};
        case Airflow::unsealing: return {ambient_Pa, surface.unsealing_time_constant_s};
        case Airflow::venting:
            return {ambient_Pa, 1.0 / (1.0 / surface.unsealing_time_constant_s +
                                       1.0 / cup.valve_time_constant_s)};
        case Airflow::open: return {ambient_Pa, cup.open_time_constant_s};
    }
    throw InternalError("airflow out of range");
}

/// Two flows at once: rates add, targets weigh by them.
Law beside_hole(const Law& flow, const FirstOrderParameters& cup, double hole_mm2,
                double ambient_Pa) {
    const double rate_1_s = 1.0 / flow.time_constant_s;
    const double hole_1_s = hole_mm2 / kValve_mm2 / cup.valve_time_constant_s;
    const double both_1_s = rate_1_s + hole_1_s;
    return {(rate_1_s * flow.target_Pa + hole_1_s * ambient_Pa) / both_1_s, 1.0 / both_1_s};
}

}  // namespace

double pressure_after(const Surface& surface, const FirstOrderParameters& cup, Airflow flow,
                      double pressure_Pa, double dt_s, double hole_mm2, double ambient_Pa) {
    Law first_order = law(surface, cup, flow, ambient_Pa);
    if (hole_mm2 > 0.0) {
        first_order = beside_hole(first_order, cup, hole_mm2, ambient_Pa);
    }
    if (pressure_Pa == first_order.target_Pa) {
        return pressure_Pa;  // an open cup, most of a flight
    }
    return first_order.target_Pa +
           (pressure_Pa - first_order.target_Pa) * std::exp(-dt_s / first_order.time_constant_s);
}

const ParameterTable<FirstOrderParameters>& FirstOrder::table() {
    using P = FirstOrderParameters;
    static const ParameterTable<P> table = {
        {"valve_time_constant_s", "s", 1e-4, 1e3, &P::valve_time_constant_s,
         "pressure rises with it through the open valve", "facts.md item 20: 2 mm on 60 cm^3"},
        {"open_time_constant_s", "s", 1e-4, 1e3, &P::open_time_constant_s,
         "pressure rises with it in a cup off the wall", "assumed"},
        {"pump_stop_band_Pa", "Pa", 0.0, 1e5, &P::pump_stop_band_Pa,
         "a cycling pump stops this close to the steady vacuum", "assumed"},
        {"pump_restart_band_Pa", "Pa", 0.0, 1e5, &P::pump_restart_band_Pa,
         "and starts again this far from it", "assumed"},
    };
    return table;
}

bool FirstOrder::pump_rests(const Parameters& parameters, const SealedAir& air) {
    const double above_Pa = air.pressure_Pa - air.surface.vacuum_pressure_Pa;
    return air.surface.pump_cycles &&
           (above_Pa < parameters.pump_stop_band_Pa ||
            (air.pump_resting && above_Pa < parameters.pump_restart_band_Pa));
}

double FirstOrder::next_Pa(const Parameters& parameters, const SealedAir& air, double dt_s) {
    const Airflow flow = air.valve_open     ? Airflow::venting
                         : air.pump_running ? Airflow::sealing
                                            : Airflow::unsealing;
    // What the seal leaks more is a hole of as much: the fresh leak's rate is 1 / tau_2.
    const double hole_mm2 = air.leak_growth > 0.0
                                ? air.hole_mm2 + air.leak_growth /
                                                     air.surface.unsealing_time_constant_s *
                                                     parameters.valve_time_constant_s * kValve_mm2
                                : air.hole_mm2;
    return pressure_after(air.surface, parameters, flow, air.pressure_Pa, dt_s, hole_mm2,
                          air.ambient_Pa);
}

}  // namespace limpet::suction
