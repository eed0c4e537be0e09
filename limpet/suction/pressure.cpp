// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/pressure.hpp"

#include <cmath>
#include <limits>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet {
namespace {

/// Every airflow is dP/dt = (target - P) / tau.
struct FirstOrder {
    double target_Pa;
    double time_constant_s;
};

FirstOrder law(const Surface& surface, const VentParameters& vent, Airflow flow) {
    switch (flow) {
        case Airflow::sealing: return {surface.vacuum_pressure_Pa, surface.sealing_time_constant_s};
        case Airflow::unsealing: return {kAtmosphere_Pa, surface.unsealing_time_constant_s};
        case Airflow::venting:
            return {kAtmosphere_Pa, 1.0 / (1.0 / surface.unsealing_time_constant_s +
                                           1.0 / vent.valve_time_constant_s)};
        case Airflow::open: return {kAtmosphere_Pa, vent.open_time_constant_s};
    }
    throw InternalError("airflow out of range");
}

}  // namespace

double pressure_after(const Surface& surface, const VentParameters& vent, Airflow flow,
                      double pressure_Pa, double dt_s) {
    const FirstOrder first_order = law(surface, vent, flow);
    if (pressure_Pa == first_order.target_Pa) {
        return pressure_Pa;  // an open cup, most of a flight
    }
    return first_order.target_Pa +
           (pressure_Pa - first_order.target_Pa) * std::exp(-dt_s / first_order.time_constant_s);
}

double time_to_pressure_s(const Surface& surface, const VentParameters& vent, Airflow flow,
                          double from_Pa, double to_Pa) {
    const FirstOrder first_order = law(surface, vent, flow);
    const double ratio = (from_Pa - first_order.target_Pa) / (to_Pa - first_order.target_Pa);
    if (from_Pa == to_Pa) {
        return 0.0;
    }
    if (!(ratio >= 1.0) || std::isinf(ratio)) {
        return std::numeric_limits<double>::infinity();
    }
    return first_order.time_constant_s * std::log(ratio);
}

}  // namespace limpet
