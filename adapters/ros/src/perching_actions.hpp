// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <memory>

#include "limpet/companion/session.hpp"

namespace limpet::ros {

/// ~perch, ~take_off and ~abort as actions (Perching.action) next to the services: a goal is
/// accepted where the service would succeed, else rejected with its reason; feedback comes ten
/// times a second and with every change; to cancel a goal is an abort. One goal an action at a
/// time. Calls come in the thread that spins.
class PerchingActions {
public:
    /// @param own      the node's own names, "~"
    /// @param session  outlives it
    PerchingActions(const ::ros::NodeHandle& own, companion::PerchingSession& session);
    ~PerchingActions();

    /// After each tick of the session.
    void tick(double time_s);

private:
    struct Servers;
    std::unique_ptr<Servers> servers_;
};

}  // namespace limpet::ros
