// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/condition.hpp"

#include <array>

#include "limpet/suction/force_law.hpp"

namespace limpet::suction {
namespace {

constexpr SurfaceCondition kDry = {
    "dry", "friction 0.5, manufacturers' value for wood, metal, glass and stone", 0.5, 0.0};
constexpr SurfaceCondition kRough = {
    "rough", "friction 0.6, manufacturers' value for rough surfaces", 0.6, 2.0};
constexpr SurfaceCondition kWet = {"wet", "friction 0.25, manufacturers give 0.2 to 0.3", 0.25,
                                   2.0};
constexpr SurfaceCondition kDusty = {
    "dusty", "friction 0.2, assumed: as the lower wet, manufacturers recommend trials", 0.2, 2.0};
constexpr SurfaceCondition kOiled = {"oiled", "friction 0.1, manufacturers give 0.1 to 0.3", 0.1,
                                     2.0};

}  // namespace

const SurfaceCondition kAsGiven = {"as_given", "the surface's own friction", 0.0, 0.0};

std::span<const SurfaceCondition* const> surface_conditions() {
    static constexpr std::array kConditions = {&kAsGiven, &kDry, &kRough, &kWet, &kDusty, &kOiled};
    return kConditions;
}

Surface in_condition(Surface surface, const SurfaceCondition& condition) {
    if (condition.friction > 0.0) {
        surface.friction = condition.friction;
    }
    return surface;
}

double safety_factor_asked(const Surface& surface, const SurfaceCondition& condition) {
    constexpr double kSmooth = 1.5, kCritical = 2.0;
    if (condition.safety_factor > 0.0) {
        return condition.safety_factor;
    }
    return surface.pore_volume_cm3 > 0.0 ? kCritical : kSmooth;
}

double lateral_safety(const Surface& surface, double radius_m, double mass_kg, double ambient_Pa) {
    return surface.friction * vacuum_force_N(surface.vacuum_pressure_Pa, radius_m, ambient_Pa) /
           (mass_kg * kGravity_m_s2);
}

}  // namespace limpet::suction
