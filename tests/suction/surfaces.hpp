// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <ostream>

#include "limpet/suction/surface.hpp"

namespace limpet::suction {

/// Table II of the paper, written down once more so that a slip in surfaces.yaml cannot hide.
struct TableTwo {
    const char* name;
    double vacuum_Pa, tau_1_s, tau_2_s;
    double time_to_880_s;  ///< facts.md section 3
};
inline constexpr std::array kTableTwo = {
    TableTwo{"porous_concrete", 65000.0, 0.33, 0.40, 0.151},
    TableTwo{"cinder_block", 27500.0, 0.35, 7.5, 0.070},
    TableTwo{"turbine_blade", 26500.0, 0.25, 8.0, 0.049},
    TableTwo{"metal", 27500.0, 0.25, 16.0, 0.050},
};

inline void PrintTo(const TableTwo& row, std::ostream* out) {
    *out << row.name;
}

inline Surface surface_of(const TableTwo& row) {
    Surface surface;
    surface.vacuum_pressure_Pa = row.vacuum_Pa;
    surface.sealing_time_constant_s = row.tau_1_s;
    surface.unsealing_time_constant_s = row.tau_2_s;
    return surface;
}

}  // namespace limpet::suction
