// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/manoeuvre_goal.hpp"

#include "limpet/core/enum_names.hpp"

namespace limpet::ros {

using companion::PerchingSession;
using companion::Place;
using companion::SessionPhase;

std::string_view to_string(Manoeuvre manoeuvre) {
    return name_of(manoeuvre);
}

companion::Answer request(PerchingSession& session, Manoeuvre manoeuvre, double time_s) {
    switch (manoeuvre) {
        case Manoeuvre::perch: return session.perch(time_s);
        case Manoeuvre::take_off: return session.take_off(time_s);
        case Manoeuvre::abort: return session.abort();
    }
    return {};
}

std::optional<GoalEnd> ManoeuvreGoal::look(const PerchingSession& session) {
    const bool flies = session.phase() == SessionPhase::flying;
    begun_ = begun_ || flies;
    const bool stops = canceled_ || manoeuvre_ == Manoeuvre::abort;
    const bool at_rest = session.place() == Place::at_rest;
    // Requested, and waiting for its beginning, as for OFFBOARD.
    const bool to_come = !begun_ && session.asked();
    if (to_come || (flies && !(stops && at_rest) && (stops || !session.outcome()))) {
        return std::nullopt;
    }
    const std::optional<Outcome>& outcome = session.outcome();
    GoalEnd end{.canceled = canceled_,
                .outcome = begun_ && outcome ? std::string(limpet::to_string(*outcome)) : "",
                .reason = begun_ ? session.reason() : "not begun any more"};
    if (end.reason.empty() && !stops) {
        end.reason = "the simulation began anew";
    }
    switch (manoeuvre_) {
        case Manoeuvre::perch:
            end.success = begun_ && (outcome == Outcome::perched || outcome == Outcome::released);
            break;
        case Manoeuvre::take_off: end.success = outcome == Outcome::released; break;
        case Manoeuvre::abort: end.success = true; break;
    }
    end.success = end.success && !canceled_;
    return end;
}

}  // namespace limpet::ros
