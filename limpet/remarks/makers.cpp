// SPDX-License-Identifier: Apache-2.0
#include "limpet/remarks/makers.hpp"

#include <fmt/format.h>

#include "limpet/scenario/derived.hpp"

namespace limpet::remarks {
namespace {

struct MakersNote {
    bool warns = false;
    std::string text;
};

/// On the surface on which it is to rest.
MakersNote lateral(const scenario::Scenario& scenario) {
    const suction::Surface surface = surfaces_met(scenario).back();
    const double ambient_Pa = scenario.cup.ambient_Pa;
    const double has = lateral_safety(surface, scenario.cup.lip.radius_m,
                                      carried_mass_kg(scenario.airframe), ambient_Pa);
    const double asked = safety_factor_asked(surface, *scenario.wall.condition);
    return {has < asked,
            fmt::format("the cup carries {:.1f} times the weight along the wall (friction {:.3g}, "
                        "vacuum {:.0f} hPa); cup manufacturers ask for {:.2g}",
                        has, surface.friction,
                        hectopascals(ambient_Pa - surface.vacuum_pressure_Pa), asked)};
}

std::vector<MakersNote> notes(const scenario::Scenario& scenario) {
    if (!scenario.wall.present || !scenario.airframe.has_cup) {
        return {};
    }
    std::vector<MakersNote> all = {lateral(scenario)};
    const suction::LipParameters& lip = scenario.cup.lip;
    if (!follows(lip, scenario.wall.geometry)) {
        all.push_back(
            {true, fmt::format("the wall's radius of {:.3g} m is less than the {:.3g} m that "
                               "a cup of {:.0f} mm seals on (suction.least_radius_m): no "
                               "touch will seal",
                               scenario.wall.radius_m, least_radius_m(lip), 2e3 * lip.radius_m)});
    }
    return all;
}

std::vector<std::string> texts(const scenario::Scenario& scenario, bool warnings_alone) {
    std::vector<std::string> said;
    for (const MakersNote& note : notes(scenario)) {
        if (note.warns || !warnings_alone) {
            said.push_back(note.text);
        }
    }
    return said;
}

}  // namespace

std::vector<std::string> makers_notes(const scenario::Scenario& scenario) {
    return texts(scenario, false);
}

std::vector<std::string> makers_warnings(const scenario::Scenario& scenario) {
    return texts(scenario, true);
}

}  // namespace limpet::remarks
