// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace limpet::ros {

/// Requests mode and arming of the autopilot, in a separate thread: MAVROS answers a call when the
/// autopilot does, and set-points must not wait for that. A request is repeated until nothing is
/// wanted any more.
class AutopilotCalls {
public:
    /// @param retry_s  of wall time, between two calls
    explicit AutopilotCalls(double retry_s);

    /// @param mode   "": none
    /// @param armed  nullopt: as it is
    void want(std::string mode, std::optional<bool> armed);

private:
    void work(const std::stop_token& over);
    /// Logs a call that fails.
    static void send(::ros::ServiceClient& client, auto& call, const char* name);
    void call(const std::string& mode, std::optional<bool> armed);

    double retry_s_;
    ::ros::ServiceClient mode_call_;
    ::ros::ServiceClient command_call_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::string mode_;
    std::optional<bool> armed_;
    std::jthread thread_;  ///< last: starts when all the rest is there, is over before it goes
};

}  // namespace limpet::ros
