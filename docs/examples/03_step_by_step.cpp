// SPDX-License-Identifier: Apache-2.0
// Millisecond by millisecond: what is true, and what the autopilot believes.
#include <algorithm>
#include <iostream>
#include <limpet/limpet.hpp>

int main() {
    limpet::Flight flight(limpet::load("perch_concrete"));
    double largest_error_m = 0.0;
    double next_print_s = 0.0;
    while (flight.tick()) {
        const limpet::Truth& truth = flight.truth();
        largest_error_m =
            std::max(largest_error_m, (flight.estimate().p_WB_m - truth.base.p_WF_m).norm());
        if (flight.time_s() >= next_print_s) {
            const double pitch_rad = limpet::euler_from_quaternion(truth.base.q_WF).pitch_rad;
            std::cout << flight.time_s() << " s  " << flight.phase() << "  pitch "
                      << limpet::degrees(pitch_rad) << " deg  cup "
                      << truth.cup_status.pressure_Pa / 100.0 << " hPa\n";
            next_print_s += 2.0;
        }
    }
    std::cout << "estimate off by " << largest_error_m << " m at most\n";
}
