// SPDX-License-Identifier: Apache-2.0
// A pressure model of your own: an ejector that runs out of air. Does the vehicle still perch?
#include <iostream>
#include <limpet/limpet.hpp>

class Ejector final : public limpet::CupPressure {
public:
    explicit Ejector(double charge_s) : charge_s_(charge_s) {}

    [[nodiscard]] std::size_t memory_size() const override { return 1; }

    [[nodiscard]] double next_Pa(const limpet::CupPressureInput& air,
                                 std::span<double> memory) const override {
        double& used_s = memory[0];
        const bool sucks = air.pump_running && !air.valve_open && used_s < charge_s_;
        used_s += sucks ? air.dt_s : 0.0;
        const double towards_Pa = sucks ? air.vacuum_pressure_Pa : air.ambient_Pa;
        const double tau_s = sucks ? air.sealing_time_constant_s : air.unsealing_time_constant_s;
        return air.pressure_Pa + (towards_Pa - air.pressure_Pa) * air.dt_s / tau_s;
    }

private:
    double charge_s_;
};

int main() {
    for (const double charge_s : {60.0, 4.0}) {
        limpet::Flight flight(limpet::load("perch_concrete"),
                              {.cup = std::make_shared<Ejector>(charge_s)});
        const limpet::Result result = flight.fly();
        std::cout << "air for " << charge_s << " s: " << to_string(result.outcome) << ", "
                  << result.reason << '\n';
    }
}
