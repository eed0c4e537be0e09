// SPDX-License-Identifier: Apache-2.0
// Record a flight and read it back; any recording of `limpet fly` reads alike.
#include <algorithm>
#include <iostream>
#include <limpet/limpet.hpp>

int main(int count, char** arguments) {
    const std::string file = count > 1 ? arguments[1] : "08_flight.mcap";
    if (count <= 1) {
        limpet::Flight flight(limpet::load("perch_concrete"));
        flight.record(file);
        flight.fly();
    }
    const limpet::Recording recording(file);
    for (const std::string& topic : recording.topics()) {
        std::cout << topic << ": " << recording.columns(topic).size() << " columns\n";
    }
    for (const limpet::PastEvent& event : recording.events()) {
        std::cout << event.time_s << " s  " << event.name << '\n';
    }
    const limpet::Series pressure = recording.series("/cup", "pressure_Pa");
    const auto lowest = std::min_element(pressure.values.begin(), pressure.values.end());
    std::cout << "lowest pressure " << *lowest / 100.0 << " hPa at "
              << pressure.time_s[static_cast<std::size_t>(lowest - pressure.values.begin())]
              << " s of " << pressure.values.size() << " samples\n";
}
