// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/message_definitions.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/record/schema.hpp"

namespace limpet::record {
namespace {

constexpr MessageDefinition kDefinitions[] = {
#include "message_definitions.inc"  // a row for each file below msg/, by CMake
};

const MessageDefinition& definition_of(std::string_view type) {
    const MessageDefinition* found = find_by(kDefinitions, &MessageDefinition::type, type);
    require(found != nullptr, "every message type used has a definition");
    return *found;
}

void collect(std::string_view type, std::vector<const MessageDefinition*>& found) {
    const MessageDefinition& definition = definition_of(type);
    if (std::find(found.begin(), found.end(), &definition) != found.end()) {
        return;
    }
    found.push_back(&definition);
    const MessageType parsed = parse_message_type(std::string(type), std::string(definition.text));
    for (const Field& field : parsed.fields) {
        if (!field.nested_type.empty()) {
            collect(field.nested_type, found);
        }
    }
}

/// In the files below msg/ a vehicle has four rotors: nothing else there comes in fours.
std::string with_rotors(std::string text, std::size_t rotors) {
    constexpr std::string_view kFour = "float64[4]";
    for (auto at = text.find(kFour); at != std::string::npos; at = text.find(kFour, at + 1)) {
        text.replace(at, kFour.size(), "float64[" + std::to_string(rotors) + "]");
    }
    return text;
}

/// Of what another message depends on.
std::string part_of(const MessageDefinition& definition) {
    return std::string(80, '=') + "\nMSG: " + short_type_name(definition.type) + "\n" +
           std::string(definition.text);
}

}  // namespace

std::span<const MessageDefinition> message_definitions() {
    return kDefinitions;
}

std::string ros2msg_schema(std::string_view type, std::size_t rotors) {
    std::vector<const MessageDefinition*> parts;
    collect(type, parts);
    std::string text(parts.front()->text);
    for (std::size_t i = 1; i < parts.size(); ++i) {
        text += part_of(*parts[i]);
    }
    return with_rotors(std::move(text), rotors);
}

std::string column_schema(std::span<const std::string_view> columns) {
    std::string text = "builtin_interfaces/Time stamp\n";
    for (const std::string_view column : columns) {
        text += "float64 ";
        std::transform(column.begin(), column.end(), std::back_inserter(text),
                       [](unsigned char c) { return std::tolower(c); });
        text += "\n";
    }
    return text + part_of(definition_of("builtin_interfaces/msg/Time"));
}

}  // namespace limpet::record
