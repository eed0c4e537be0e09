// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/atmosphere.hpp"

#include <cmath>

#include "limpet/core/frames.hpp"

namespace limpet {
namespace {

constexpr double kSeaLevelTemperature_K = 288.15;
constexpr double kLapseRate_K_m = 0.0065;
constexpr double kGasConstant_J_kg_K = 287.05287;
constexpr double kExponent = kGravity_m_s2 / (kGasConstant_J_kg_K * kLapseRate_K_m);

}  // namespace

const ParameterTable<AirParameters>& air_table() {
    using A = AirParameters;
    static const ParameterTable<A> table = {
        {"altitude_m", "m", -200.0, 11000.0, &A::altitude_m,
         "of the place above mean sea level: pressure and density of the air, and by them thrust, "
         "drag and what the pump draws",
         "ICAO Doc 7488, troposphere; paper: says nothing, its P_atm is that of 0"},
        {"air_temperature_offset_K", "K", -60.0, 60.0, &A::air_temperature_offset_K,
         "warmer than the standard atmosphere there: the air is thinner, its pressure is the same",
         "ICAO Doc 7488: rho = P / (R T)"},
    };
    return table;
}

double standard_pressure_Pa(double altitude_m) {
    return kAtmosphere_Pa *
           std::pow(1.0 - kLapseRate_K_m * altitude_m / kSeaLevelTemperature_K, kExponent);
}

double standard_altitude_m(double pressure_Pa) {
    return kSeaLevelTemperature_K / kLapseRate_K_m *
           (1.0 - std::pow(pressure_Pa / kAtmosphere_Pa, 1.0 / kExponent));
}

Air air_at(const AirParameters& parameters) {
    Air air;
    air.pressure_Pa = standard_pressure_Pa(parameters.altitude_m);
    air.temperature_K = kSeaLevelTemperature_K - kLapseRate_K_m * parameters.altitude_m +
                        parameters.air_temperature_offset_K;
    air.pressure_ratio = air.pressure_Pa / kAtmosphere_Pa;
    air.density_ratio = air.pressure_ratio * kSeaLevelTemperature_K / air.temperature_K;
    return air;
}

}  // namespace limpet
