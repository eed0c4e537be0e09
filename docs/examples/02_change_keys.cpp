// SPDX-License-Identifier: Apache-2.0
// The same flight with other numbers: how hard is the impact, how long does the seal take?
// `limpet params` lists every key with its range; the names of all metrics are in Result::metrics.
#include <iostream>
#include <limpet/limpet.hpp>
#include <string>

int main() {
    const limpet::Scenario perch = limpet::load("perch_concrete", {"seed=3"});
    std::cout << "dock speed [m/s]   impact [N]   to P_land [s]   outcome\n";
    for (const char* speed : {"0.4", "0.8", "1.2"}) {
        limpet::Flight flight(perch.with({std::string("guidance.dock_speed_m_s=") + speed}));
        const limpet::Result result = flight.fly();
        std::cout << speed << "   " << result.metric("impact_force_N") << "   "
                  << result.metric("time_to_land_pressure_s") << "   " << to_string(result.outcome)
                  << '\n';
    }
    try {
        (void)limpet::load("perch_concrete", {"guidance.dock_sped_m_s=1"});
    } catch (const limpet::InputError& error) {
        std::cout << "a slip of the pen: " << error.what() << '\n';
    }
}
