// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "limpet/autopilot/external.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/guidance/perching.hpp"
#include "limpet/suction/cup.hpp"

namespace limpet::simulation {

/// Events that guidance elsewhere reports in one tick at most; the cup may have some of its own.
inline constexpr std::size_t kMostEvents = 4;

/// Guidance elsewhere, in place of ours.
class ExternalGuidance {
public:
    virtual ~ExternalGuidance() = default;

    /// Once a base tick; never waits.
    /// @param time_s    of the flight, may start anew
    /// @param guidance  its set-point, state and ending are set; with an autopilot behind a wire
    ///                  only pump and valve of the set-point, for it flies that itself
    /// @param events    what has happened is added; reasons live as long as this
    virtual void exchange(const Readings& readings, const Estimate& estimate, double time_s,
                          guidance::PerchingMemory& guidance, guidance::EventList& events) = 0;
    /// What keeps it from flying, for people; empty when nothing does.
    [[nodiscard]] virtual std::string obstacle() const = 0;
};

/// The cup's seal and pressure elsewhere, in place of suction::step; never waits.
class ExternalCup {
public:
    virtual ~ExternalCup() = default;

    /// As suction's step(): load at this state, then pressure over `dt_s`; once a step of the
    /// plant.
    virtual suction::CupOutput step(const suction::CupModel& model, suction::CupState& state,
                                    const suction::Surface& surface, const Kinematics& cup,
                                    const suction::CupInput& input, double dt_s) = 0;
};

/// Stations that are not ours in this flight; null: ours. All outlive it.
struct Outside {
    autopilot::ExternalAutopilot* autopilot = nullptr;
    ExternalGuidance* guidance = nullptr;
    ExternalCup* cup = nullptr;

    /// It is met at every tick; an autopilot where ours would be, at its rate.
    [[nodiscard]] bool wants_every_tick() const { return guidance != nullptr || cup != nullptr; }
};

}  // namespace limpet::simulation
