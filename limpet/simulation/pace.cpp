// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/pace.hpp"

#include <thread>

namespace limpet::simulation {

double Pace::elapsed_s() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
}

void Pace::wait_until(double simulated_s) {
    if (speed_ <= 0.0) {
        return;
    }
    const double due_s = simulated_s / speed_ + lost_s_;
    const double late_s = elapsed_s() - due_s;
    if (late_s > kSlack_s) {
        lost_s_ += late_s - kSlack_s;
    } else if (late_s < 0.0) {
        std::this_thread::sleep_until(begin_ + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(due_s)));
    }
}

}  // namespace limpet::simulation
