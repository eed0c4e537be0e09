// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/facts.hpp"

#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/px4/data.hpp"

namespace limpet::px4 {
namespace {

using Facts = std::map<std::string, Px4Fact, std::less<>>;

Facts read_facts() {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    Facts facts;
    const auto file = nlohmann::json::parse(kParametersJson);
    for (const auto& row : file.at("parameters")) {
        const std::string type = row.at("type");
        require(type == "Int32" || type == "Float", "a parameter of PX4 is Int32 or Float");
        const Px4Fact fact{.type = type == "Int32" ? Px4Type::int32 : Px4Type::real32,
                           .default_value = row.at("default"),
                           .minimum = row.value("min", -kNone),
                           .maximum = row.value("max", kNone)};
        require(facts.emplace(row.at("name").get<std::string>(), fact).second,
                "a parameter of PX4 stands once");
    }
    return facts;
}

}  // namespace

const Px4Fact* find_px4_fact(std::string_view name) {
    static const Facts facts = read_facts();
    const auto found = facts.find(name);
    return found == facts.end() ? nullptr : &found->second;
}

}  // namespace limpet::px4
