// SPDX-License-Identifier: Apache-2.0
// Fly a scenario to its end, as `limpet fly perch_concrete` does.
#include <iostream>
#include <limpet/limpet.hpp>

int main() {
    limpet::Flight flight(limpet::load("perch_concrete"));
    const limpet::Result result = flight.fly();
    for (const limpet::Event& event : result.events) {
        std::cout << event.time_s << " s  " << to_string(event.name) << "  " << event.reason
                  << '\n';
    }
    std::cout << to_string(result.outcome) << " after " << result.simulated_s << " s\n";
}
