// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace limpet::simulation {

/// Simulated time held back to wall time; the one clock of the simulation module.
class Pace {
public:
    /// @param speed  simulated seconds a real second; 0: holds nothing back
    explicit Pace(double speed) : speed_(speed), begin_(Clock::now()) {}

    /// Sleeps until wall time has come to simulated time; after falling behind it does not catch
    /// up by more than `kSlack_s`.
    void wait_until(double simulated_s);
    [[nodiscard]] double elapsed_s() const;

private:
    using Clock = std::chrono::steady_clock;
    static constexpr double kSlack_s = 0.1;

    double speed_;
    Clock::time_point begin_;
    double lost_s_ = 0.0;  ///< of wall time, never to be caught up
};

}  // namespace limpet::simulation
