// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "adapters/ros/src/convert.hpp"
#include "limpet/core/time.hpp"
#include "limpet/suction/cup.hpp"

namespace limpet::ros {

/// The half of the cup that is at the wall (SuctionCup is the other): forces at each step of
/// physics with the latest pressure received. A lip that cannot hold opens at once; answers to
/// earlier reports no longer count.
class ApartLip {
public:
    /// In place of suction's step(). Status and pressure in `state` are those received.
    [[nodiscard]] suction::CupOutput step(const suction::CupModel& model, suction::CupState& state,
                                          const suction::Surface& surface, const Kinematics& cup,
                                          const suction::CupInput& input);
    /// The simulator's report of the lip, once a tick at most.
    /// @return the report of the ticks that are over, when one is due; stamped in flight time. Its
    ///         press force is the largest since the last one, of those while the lip lies still,
    ///         the rest is of that instant
    [[nodiscard]] std::optional<limpet_ros::CupContact> take_report();
    /// Seal and pressure as received. An answer to a report that was never made is ignored.
    /// @param answer  sound, see phase_from()
    void receive(const limpet_ros::CupState& answer);

private:
    void collect(const limpet_ros::CupContact& now, CupPhase phase, double time_s);
    [[nodiscard]] std::optional<Event> obey(suction::CupState& state, double time_s);

    limpet_ros::CupState answer_ = cup_message({});
    std::uint32_t next_ = 1;     ///< number of the next report
    std::uint32_t barrier_ = 0;  ///< answers to older reports do not know that the seal has opened
    limpet_ros::CupContact gathered_;
    bool anything_ = false;  ///< is in gathered_
    Tick tick_ = -1;         ///< of which it is
    bool near_ = false;
    std::optional<limpet_ros::CupContact> due_;
};

}  // namespace limpet::ros
