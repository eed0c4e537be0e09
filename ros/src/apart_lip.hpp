// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "limpet/core/time.hpp"
#include "limpet/suction/cup.hpp"

namespace limpet::ros {

/// What the simulator tells of the lip, once a tick at most.
struct LipReport {
    std::uint32_t number = 0;
    std::uint32_t touch = 0;
    double time_s = 0.0;
    double press_N = 0.0;  ///< the largest since the last report, of those while the lip lies still
    suction::LipContact contact;  ///< of that instant
};

/// What it is told of seal and pressure.
struct LipAnswer {
    std::uint32_t contact = 0;  ///< number of the report that is answered
    CupPhase phase = CupPhase::free;
    double pressure_Pa = kAtmosphere_Pa;
    double mean_pressure_Pa = kAtmosphere_Pa;
    double seal_threshold_N = 0.0;
    bool pump_running = false;
    bool valve_open = false;
};

/// The half of the cup that is at the wall (SuctionCup is the other): forces at each step of
/// physics with the pressure told last. A lip that cannot hold opens at once; from then on only
/// answers count that know of it.
class ApartLip {
public:
    /// In place of suction's step(). Status and pressure in `state` are as told.
    [[nodiscard]] suction::CupOutput step(const suction::CupModel& model, suction::CupState& state,
                                          const suction::Surface& surface, const Kinematics& cup,
                                          const suction::CupInput& input);
    /// @return the report of the ticks that are over, when one is due
    [[nodiscard]] std::optional<LipReport> take_report();
    /// An answer to a report that was never made is none.
    void hear(const LipAnswer& answer);

private:
    void collect(const suction::LipContact& contact, double press_N, CupPhase phase, double time_s);
    [[nodiscard]] std::optional<Event> obey(suction::CupState& state, double time_s);

    LipAnswer answer_;
    std::uint32_t next_ = 1;     ///< number of the next report
    std::uint32_t barrier_ = 0;  ///< answers to older reports do not know that the seal has opened
    LipReport gathered_;
    bool anything_ = false;  ///< is in gathered_
    Tick tick_ = -1;         ///< of which it is
    bool near_ = false;
    std::optional<LipReport> due_;
};

}  // namespace limpet::ros
