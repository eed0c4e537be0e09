// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <optional>
#include <string>
#include <vector>

#include "ros/src/setup.hpp"

namespace limpet::ros {

/// Where a simulated vehicle tells what it flies, so that nodes fly nothing else.
inline constexpr const char* kFlightParameter = "/limpet/flight";
/// As a parameter: all of it in one, so that nobody reads a half.
[[nodiscard]] XmlRpc::XmlRpcValue flight_value(const SetupArguments& flight);
/// @return nullopt if it is none
[[nodiscard]] std::optional<SetupArguments> flight_from(const XmlRpc::XmlRpcValue& value);
/// @param flight  a path in it is of this program's folder
void tell_flight(SetupArguments flight);

/// A node's private parameters, read once when it starts. All of it throws InputError: one line
/// that names the parameter, its value and what is allowed.
class NodeParameters {
public:
    NodeParameters() : node_("~") {}

    [[nodiscard]] std::string text(const std::string& name, const std::string& otherwise = {});
    [[nodiscard]] bool flag(const std::string& name, bool otherwise);
    [[nodiscard]] double number(const std::string& name, double otherwise, double minimum,
                                double maximum);
    /// ~scenario, ~vehicle, ~surface, ~mission, ~seed, and ~set: a list of texts, or one text
    /// "KEY=VALUE; KEY=VALUE". With ~as_vehicle the simulated vehicle's own, for which it waits;
    /// then only ~mission and ~set may change them.
    [[nodiscard]] SetupArguments setup();
    /// Refuses parameters that nobody has read: they would mean nothing.
    void refuse_others() const;

private:
    [[nodiscard]] SetupArguments own_setup();
    [[nodiscard]] const XmlRpc::XmlRpcValue* find(const std::string& name);
    [[noreturn]] void fail(const std::string& name, const std::string& why) const;

    ::ros::NodeHandle node_;
    std::vector<std::string> known_;
    XmlRpc::XmlRpcValue value_;
};

/// Runs a node: an InputError becomes one line on stderr and exit code 2.
[[nodiscard]] int run_node(int argc, char** argv, const char* name, void (*node)());

}  // namespace limpet::ros
