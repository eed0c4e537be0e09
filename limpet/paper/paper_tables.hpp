// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

/// What the paper prints in its tables, and nothing of ours.
namespace limpet::paper {

/// A column of Table I.
struct TableOne {
    const char* vehicle;  ///< name in vehicles/
    const char* name;
    double motor_constant_kg_m, moment_constant_m, drag_constant_kg;
};
inline constexpr std::array<TableOne, 2> kTableOne = {{
    {"perching_uav", "the perching UAV", 2.5e-5, 1.9e-2, 8e-4},
    {"iris", "the Iris", 5.84e-6, 6e-2, 1.75e-4},
}};

/// A column of Table II.
struct TableTwo {
    const char* scenario;  ///< of the press rig
    const char* name;
    double vacuum_hPa, tau_1_s, tau_1_tolerance_s, tau_2_s, tau_2_tolerance_s;
};
inline constexpr std::array<TableTwo, 4> kTableTwo = {{
    {"press_concrete", "porous concrete", 650.0, 0.33, 0.03, 0.40, 0.03},
    {"press_cinder_block", "cinder block", 275.0, 0.35, 0.03, 7.5, 0.5},
    {"press_turbine_blade", "wind turbine blade", 265.0, 0.25, 0.03, 8.0, 0.5},
    {"press_metal", "metallic surface", 275.0, 0.25, 0.03, 16.0, 1.0},
}};

}  // namespace limpet::paper
