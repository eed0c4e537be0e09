// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/dds/parameters.hpp"

#include <rcl_interfaces/DescribeParameters.h>
#include <rcl_interfaces/GetParameterTypes.h>
#include <rcl_interfaces/GetParameters.h>
#include <rcl_interfaces/ListParameters.h>
#include <rcl_interfaces/SetParameters.h>
#include <rcl_interfaces/SetParametersAtomically.h>

#include <algorithm>
#include <charconv>

#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::ros2 {
namespace {

using rcl_interfaces::ParameterValue;
using scenario::YamlNode;

/// As ROS 2 reads YAML: what looks like a number is one, unless it is quoted.
ParameterValue value_of(const YamlNode& node) {
    ParameterValue value;
    if (node.kind == YamlNode::Kind::list) {
        value.type = ParameterValue::PARAMETER_STRING_ARRAY;
        for (const YamlNode& item : node.children) {
            value.string_array_value.push_back(item.text);
        }
        return value;
    }
    const std::string& text = node.text;
    const char* const end = text.data() + text.size();
    const auto number = node.quoted ? std::nullopt : scenario::number_in(node);
    if (!node.quoted && (text == "true" || text == "false")) {
        value.type = ParameterValue::PARAMETER_BOOL;
        value.bool_value = text == "true" ? 1 : 0;
    } else if (number && std::from_chars(text.data(), end, value.integer_value).ptr == end) {
        value.type = ParameterValue::PARAMETER_INTEGER;
    } else if (number) {
        value.type = ParameterValue::PARAMETER_DOUBLE;
        value.integer_value = 0;
        value.double_value = *number;
    } else {
        value.type = ParameterValue::PARAMETER_STRING;
        value.string_value = text;
    }
    return value;
}

/// @return not set where there is no such one
ParameterValue value_of(const Node& node, const std::string& name) {
    const YamlNode* const found = node.settings().parameters.find(name);
    return found != nullptr ? value_of(*found) : ParameterValue();
}

bool begins_with_one_of(const std::string& name, const std::vector<std::string>& prefixes) {
    return prefixes.empty() ||
           std::any_of(prefixes.begin(), prefixes.end(), [&name](const std::string& prefix) {
               return name == prefix || name.starts_with(prefix + ".");
           });
}

rcl_interfaces::SetParametersResult refusal() {
    rcl_interfaces::SetParametersResult result;
    result.reason = "parameters are read once, when the node starts";
    return result;
}

/// @param answer  (request, response)
template <class Service, class Answer>
Handle serve(Node& node, const std::string& name, Answer answer) {
    using Request = typename Service::Request;
    return node.serve(node.settings().full_name() + "/" + name, Request::kType,
                      Service::Response::kType,
                      [answer](const Bytes& bytes, const Node::Reply& reply) {
                          if (const auto request = decode<Request>(bytes)) {
                              typename Service::Response response;
                              answer(*request, response);
                              reply(encode(response));
                          }
                      });
}

}  // namespace

std::vector<Handle> serve_parameters(Node& node) {
    using namespace rcl_interfaces;
    return {
        serve<ListParameters>(node, "list_parameters",
                              [&node](const auto& request, auto& response) {
                                  for (const YamlNode& one : node.settings().parameters.children) {
                                      if (begins_with_one_of(one.key, request.prefixes)) {
                                          response.result.names.push_back(one.key);
                                      }
                                  }
                              }),
        serve<GetParameters>(node, "get_parameters",
                             [&node](const auto& request, auto& response) {
                                 for (const std::string& name : request.names) {
                                     response.values.push_back(value_of(node, name));
                                 }
                             }),
        serve<GetParameterTypes>(node, "get_parameter_types",
                                 [&node](const auto& request, auto& response) {
                                     for (const std::string& name : request.names) {
                                         response.types.push_back(value_of(node, name).type);
                                     }
                                 }),
        serve<DescribeParameters>(node, "describe_parameters",
                                  [&node](const auto& request, auto& response) {
                                      for (const std::string& name : request.names) {
                                          auto& descriptor = response.descriptors.emplace_back();
                                          descriptor.name = name;
                                          descriptor.type = value_of(node, name).type;
                                          descriptor.read_only = 1;
                                      }
                                  }),
        serve<SetParameters>(node, "set_parameters",
                             [](const auto& request, auto& response) {
                                 response.results.assign(request.parameters.size(), refusal());
                             }),
        serve<SetParametersAtomically>(
            node, "set_parameters_atomically",
            [](const auto&, auto& response) { response.result = refusal(); })};
}

}  // namespace limpet::ros2
