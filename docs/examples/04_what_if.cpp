// SPDX-License-Identifier: Apache-2.0
// Save a flight at the moment of its impact, and go on from there on other walls.
#include <iostream>
#include <limpet/limpet.hpp>

int main() {
    const limpet::Scenario concrete = limpet::load("perch_concrete");
    limpet::Flight flight(concrete);
    const auto has_hit = [&] {
        for (const limpet::Event& event : flight.events()) {
            if (event.name == limpet::EventName::impact) {
                return true;
            }
        }
        return false;
    };
    while (!has_hit() && flight.tick()) {
    }
    const limpet::Moment impact = flight.save();
    std::cout << "impact after " << flight.time_s() << " s\n";

    for (const char* wall : {"wall.surface=porous_concrete", "wall.surface=metal"}) {
        limpet::Flight branch(concrete.with({wall}), impact);
        const limpet::Result result = branch.fly();
        std::cout << wall << ": " << to_string(result.outcome) << ", " << result.reason
                  << ", lowest pressure " << result.metric("pressure_min_Pa") / 100.0 << " hPa\n";
    }
    const bool same = flight.fly().state_hash == limpet::Flight(concrete).fly().state_hash;
    std::cout << "saving changes nothing: " << (same ? "same bits" : "OTHER BITS") << '\n';
}
