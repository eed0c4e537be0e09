// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>

#include <string>
#include <utility>
#include <vector>

namespace limpet::ros {

/// How one part of a node is.
struct Diagnosis {
    enum class Level : std::uint8_t {
        ok,
        warn,
        error,
        stale
    };

    std::string name;  ///< of the part
    Level level = Level::ok;
    std::string message = {};                                      ///< a line for people
    std::vector<std::pair<std::string, std::string>> values = {};  ///< units in the names
};

/// A node's parts on /diagnostics, where rqt_robot_monitor and diagnostic_aggregator look.
class Diagnostics {
public:
    static constexpr int kRate_Hz = 1;  ///< of messages

    /// @param node_name  parts are called "NODE: PART"
    Diagnostics(::ros::NodeHandle& node, std::string node_name);

    void publish(const std::vector<Diagnosis>& parts, const ::ros::Time& now) const;

private:
    std::string name_;
    ::ros::Publisher out_;
};

/// @return as DiagnosticArray has it
[[nodiscard]] diagnostic_msgs::DiagnosticStatus status_message(const std::string& node_name,
                                                               const Diagnosis& part);

}  // namespace limpet::ros
