// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "limpet/companion/session.hpp"

namespace limpet::ros {

/// The manoeuvres of perching_node, by service or as actions.
enum class Manoeuvre {
    perch,
    take_off,
    abort
};
/// "perch", as services and actions are called.
[[nodiscard]] std::string_view to_string(Manoeuvre manoeuvre);

/// How a goal came to its end.
struct GoalEnd {
    bool success = false;
    bool canceled = false;  ///< a cancel request ended it
    std::string outcome;    ///< of the mission; empty: none
    std::string reason;
};

/// A manoeuvre from its beginning to its end, as the session shows it; without ROS.
///
///   perch     at rest on the wall (a mission that takes off by itself: back before it)
///   take_off  back before the wall
///   abort     at rest on the wall, or control handed back
class ManoeuvreGoal {
public:
    /// The session has just accepted it.
    explicit ManoeuvreGoal(Manoeuvre manoeuvre) : manoeuvre_(manoeuvre) {}

    /// It is to stop: the session aborts.
    void cancel() { canceled_ = true; }

    /// After each tick of the session, or a word to it.
    /// @return once, its end
    [[nodiscard]] std::optional<GoalEnd> look(const companion::PerchingSession& session);

private:
    Manoeuvre manoeuvre_;
    bool begun_ = false;
    bool canceled_ = false;
};

/// As the service of that name.
[[nodiscard]] companion::Answer request(companion::PerchingSession& session, Manoeuvre manoeuvre,
                                        double time_s);

}  // namespace limpet::ros
