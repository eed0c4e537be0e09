// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/facts.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/px4/data.hpp"

namespace limpet::px4 {
namespace {

using Json = nlohmann::json;

/// In the form of PX4's own parameters.json.
/// @throws Json::exception
Px4Facts read_facts(std::string_view text) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    Px4Facts facts;
    const auto file = Json::parse(text);
    for (const auto& row : file.at("parameters")) {
        const bool whole = row.at("type").get<std::string>() == "Int32";
        facts.insert_or_assign(row.at("name").get<std::string>(),
                               Px4Fact{.type = whole ? Px4Type::int32 : Px4Type::real32,
                                       .default_value = row.at("default"),
                                       .minimum = row.value("min", -kNone),
                                       .maximum = row.value("max", kNone),
                                       .gone = row.contains("gone")});
    }
    return facts;
}

}  // namespace

const Px4Fact* find_px4_fact(std::string_view name) {
    static const Px4Facts facts = read_facts(kParametersJson);
    const auto found = facts.find(name);
    return found == facts.end() ? nullptr : &found->second;
}

std::optional<Px4Facts> px4_facts_of(const std::filesystem::path& build) {
    const std::filesystem::path path = build / "parameters.json";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        return std::nullopt;
    }
    const std::string text = read_file(path, {"PX4's parameters", 16});
    try {
        return read_facts(text);
    } catch (const Json::exception& error) {
        throw InputError(
            fmt::format("{}: not PX4's list of its parameters: {}", path.string(), error.what()));
    }
}

}  // namespace limpet::px4
