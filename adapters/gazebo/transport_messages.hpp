// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/algorithm/string/replace.hpp>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/Model.hh>
#include <string>
#include <string_view>

namespace limpet::gazebo11 {

[[nodiscard]] inline gazebo::msgs::Any number_message(double value) {
    gazebo::msgs::Any message;
    message.set_type(gazebo::msgs::Any::DOUBLE);
    message.set_double_value(value);
    return message;
}
[[nodiscard]] inline gazebo::msgs::GzString text_message(std::string_view text) {
    gazebo::msgs::GzString message;
    message.set_data(std::string(text));
    return message;
}

/// How a plugin is called on topics: MODEL/PLUGIN, of a nested model OUTER/INNER/PLUGIN.
[[nodiscard]] inline std::string name_on_topics(const gazebo::physics::Model& model,
                                                const std::string& plugin) {
    return boost::replace_all_copy(model.GetScopedName(), "::", "/") + "/" + plugin;
}

}  // namespace limpet::gazebo11
