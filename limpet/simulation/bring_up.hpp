// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "limpet/autopilot/external.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/simulation/outside.hpp"
#include "limpet/simulation/snapshot.hpp"

namespace limpet::simulation {

struct BringUp {
    std::uint32_t run = 0;
    double speed = 0.0;          ///< times real time; 0: as fast as it goes
    double limit_s = 120.0;      ///< of simulated time
    double stand_below_m = 0.3;  ///< the stand, under the scenario's start
    double steady_s = 2.0;       ///< how long it must stand still at the start
    const std::atomic<bool>* stop = nullptr;
    /// What is being waited for, whenever that changes.
    std::function<void(const std::string& obstacle)> on_obstacle;
};

/// Scenarios begin in the air; an autopilot behind a wire boots, aligns its estimator, arms and
/// takes off first. The vehicle rests on a stand, which holds its attitude and lets go for good
/// once the rotors carry the weight; then it flies to the scenario's start, by its own estimate,
/// which is set right by where it stands: with GPS it is where that settles. Nothing of this is
/// recorded, and the flight's clock, sensors, battery and guidance begin when it is done. With
/// guidance elsewhere that is when it leaves the stand: where it hovers then is not ours to say.
/// @param outside  has an autopilot
/// @return the flight's first state: time 0, the plant as it flies
/// @throws InputError when it is not there in time or fails, with what it waited for
/// @throws Interrupted on options.stop
[[nodiscard]] Snapshot bring_up(const FlightModel& model, const Outside& outside,
                                const BringUp& options);

}  // namespace limpet::simulation
