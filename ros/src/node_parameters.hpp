// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "ros/src/setup.hpp"

namespace limpet::ros {

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
    /// "KEY=VALUE; KEY=VALUE".
    [[nodiscard]] SetupArguments setup();
    /// Refuses parameters that nobody has read: they would mean nothing.
    void refuse_others() const;

private:
    [[nodiscard]] const XmlRpc::XmlRpcValue* find(const std::string& name);
    [[noreturn]] void fail(const std::string& name, const std::string& why) const;

    ::ros::NodeHandle node_;
    std::vector<std::string> known_;
    XmlRpc::XmlRpcValue value_;
};

/// Runs a node: an InputError becomes one line on stderr and exit code 2.
[[nodiscard]] int run_node(int argc, char** argv, const char* name, void (*node)());

}  // namespace limpet::ros
