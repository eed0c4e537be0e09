// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"

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

constexpr std::array<std::pair<std::string_view, Primitive>, 15> kPrimitives = {{
    {"bool", Primitive::boolean},
    {"int8", Primitive::int8},
    {"uint8", Primitive::uint8},
    {"byte", Primitive::uint8},
    {"char", Primitive::uint8},
    {"int16", Primitive::int16},
    {"uint16", Primitive::uint16},
    {"int32", Primitive::int32},
    {"uint32", Primitive::uint32},
    {"int64", Primitive::int64},
    {"uint64", Primitive::uint64},
    {"float32", Primitive::float32},
    {"float64", Primitive::float64},
    {"string", Primitive::string},
    {"builtin_interfaces/msg/Time", Primitive::time},
}};

std::optional<Primitive> primitive_from(std::string_view name) {
    for (const auto& [candidate, primitive] : kPrimitives) {
        if (candidate == name) {
            return primitive;
        }
    }
    return std::nullopt;
}

std::string_view package_of(std::string_view type) {
    return type.substr(0, type.find('/'));
}

/// "float64[9]" -> "float64" and the shape; "string<=10[<=3]" -> "string", dynamic.
void read_shape(std::string& type, Field& field) {
    if (const auto bracket = type.find('['); bracket != std::string::npos) {
        const std::string inside = type.substr(bracket + 1, type.find(']') - bracket - 1);
        type.resize(bracket);
        if (inside.empty() || inside[0] == '<') {
            field.shape = Field::Shape::dynamic_array;
        } else {
            field.shape = Field::Shape::fixed_array;
            const char* end = inside.data() + inside.size();
            const auto result = std::from_chars(inside.data(), end, field.count);
            if (result.ec != std::errc{} || result.ptr != end || field.count == 0) {
                throw InputError("array length is not a positive number: " + inside);
            }
        }
    }
    type.resize(std::min(type.size(), type.find("<=")));
}

Field read_field(std::string type, std::string name, std::string_view package) {
    Field field;
    field.name = std::move(name);
    read_shape(type, field);
    if (type == "Header") {
        type = "std_msgs/msg/Header";
    }
    const auto basic = primitive_from(type);
    if (basic) {
        field.primitive = *basic;
        return field;
    }
    if (type == "wstring") {
        throw NotTaken("wstring");
    }
    if (type.find('/') == std::string::npos) {
        type = fmt::format("{}/{}", package, type);
    }
    type = full_type_name(type);
    if (const auto time = primitive_from(type)) {
        field.primitive = *time;
    }
    field.nested_type = type;
    return field;
}

}  // namespace

std::string short_type_name(std::string_view full) {
    const auto middle = full.find("/msg/");
    return middle == std::string_view::npos
               ? std::string(full)
               : std::string(full.substr(0, middle)) + std::string(full.substr(middle + 4));
}

std::string full_type_name(std::string_view name) {
    const auto slash = name.find('/');
    // With two of them it says msg, srv or action itself.
    if (slash == std::string_view::npos || name.find('/', slash + 1) != std::string_view::npos) {
        return std::string(name);
    }
    return std::string(name.substr(0, slash)) + "/msg" + std::string(name.substr(slash));
}

MessageType parse_message_type(const std::string& name, const std::string& text) {
    MessageType type;
    type.name = full_type_name(name);
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::istringstream words(line.substr(0, line.find('#')));
        std::string first, second, third;
        words >> first >> second >> third;
        if (first.empty()) {
            continue;
        }
        if (second.empty()) {
            throw InputError(fmt::format("{} line {}: no field name: {}", type.name, number, line));
        }
        const bool constant = second.find('=') != std::string::npos || third.rfind('=', 0) == 0;
        if (constant) {
            continue;
        }
        try {
            type.fields.push_back(read_field(first, second, package_of(type.name)));
        } catch (const NotTaken& problem) {
            throw NotTaken(fmt::format("{} line {}: {}", type.name, number, problem.what()));
        } catch (const InputError& problem) {
            throw InputError(fmt::format("{} line {}: {}", type.name, number, problem.what()));
        }
    }
    return type;
}

std::vector<MessageType> parse_ros2msg(const std::string& name, const std::string& text) {
    static const std::string kSeparator(80, '=');
    std::vector<MessageType> types;
    std::istringstream lines(text);
    std::string part_name = name;
    std::string part;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind(kSeparator, 0) != 0) {
            part += line + "\n";
            continue;
        }
        types.push_back(parse_message_type(part_name, part));
        part.clear();
        std::string keyword;
        if (!std::getline(lines, line) || !(std::istringstream(line) >> keyword >> part_name) ||
            keyword != "MSG:") {
            throw InputError(name + ": a separator is not followed by \"MSG: package/Type\"");
        }
    }
    types.push_back(parse_message_type(part_name, part));
    return types;
}

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
