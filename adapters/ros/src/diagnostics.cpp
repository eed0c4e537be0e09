// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/diagnostics.hpp"

#include "adapters/ros/src/topics.hpp"

namespace limpet::ros {

diagnostic_msgs::DiagnosticStatus status_message(const std::string& node_name,
                                                 const Diagnosis& part) {
    using Level = decltype(diagnostic_msgs::DiagnosticStatus::level);
    diagnostic_msgs::DiagnosticStatus status;
    status.level = static_cast<Level>(part.level);
    status.name = node_name + ": " + part.name;
    status.message = part.message;
    status.hardware_id = "limpet";
    for (const auto& [key, value] : part.values) {
        diagnostic_msgs::KeyValue& entry = status.values.emplace_back();
        entry.key = key;
        entry.value = value;
    }
    return status;
}

Diagnostics::Diagnostics(::ros::NodeHandle& node, std::string node_name)
    : name_(std::move(node_name)),
      out_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", kQueue)) {}

void Diagnostics::publish(const std::vector<Diagnosis>& parts, const ::ros::Time& now) const {
    diagnostic_msgs::DiagnosticArray message;
    for (const Diagnosis& part : parts) {
        message.status.push_back(status_message(name_, part));
    }
    send(out_, message, now);
}

}  // namespace limpet::ros
