// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "limpet/paper/claims.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::paper {
namespace {

const scenario::YamlNode& wanted(const scenario::YamlNode& map, std::string_view key) {
    const scenario::YamlNode* node = map.find(key);
    if (node == nullptr) {
        fail(map, fmt::format("has no {}", key));
    }
    return *node;
}

double number(const scenario::YamlNode& node) {
    const std::optional<double> value = number_in(node);
    if (!value) {
        fail(node, "must be a number");
    }
    return *value;
}

draw::Range range(const scenario::YamlNode& node) {
    if (node.kind != scenario::YamlNode::Kind::list || node.children.size() != 2) {
        fail(node, "must be a range, as in [0.8, 1.4]");
    }
    const draw::Range read{number(node.children[0]), number(node.children[1])};
    if (!(read.low <= read.high)) {
        fail(node, "must begin with its lower end");
    }
    return read;
}

report::Quantity quantity(const scenario::YamlNode& node) {
    if (node.kind == scenario::YamlNode::Kind::list) {
        return range(node);
    }
    const std::optional<double> value = number_in(node);
    return value ? report::Quantity(*value) : report::Quantity(read_text(node));
}

std::string text_or_nothing(const scenario::YamlNode& map, std::string_view key) {
    const scenario::YamlNode* node = map.find(key);
    return node == nullptr ? "" : read_text(*node);
}

/// @throws InputError when it is none of `names`
std::string one_of(const scenario::YamlNode& node, const std::vector<std::string_view>& names,
                   std::string_view otherwise) {
    const std::string text = read_text(node);
    if (std::find(names.begin(), names.end(), text) == names.end()) {
        fail(node, fmt::format("\"{}\" {}{}", scenario::shown(text), otherwise,
                               scenario::hint(text, names)));
    }
    return text;
}

/// The keys that say what bears a statement out, or none of them.
void read_evidence(const scenario::YamlNode& map, const std::vector<std::string_view>& measured,
                   PaperStatement& statement) {
    const scenario::YamlNode* evidence = map.find("evidence");
    if (evidence == nullptr) {
        for (const char* key : {"unit", "accepted", "at_least", "basis"}) {
            if (const scenario::YamlNode* node = map.find(key)) {
                fail(*node, "stands without evidence");
            }
        }
        (void)wanted(map, "note");  // why not
        return;
    }
    statement.evidence = one_of(*evidence, measured, "is measured by no part");
    statement.basis = one_of(wanted(map, "basis"),
                             {"as set", "recovered", "by the method", "measured"}, "is no basis");
    const scenario::YamlNode* least = map.find("at_least");
    if (least != nullptr && map.find("accepted") != nullptr) {
        fail(*least, "stands beside accepted, one of the two");
    }
    statement.accepted = least == nullptr
                             ? range(wanted(map, "accepted"))
                             : draw::Range{number(*least), std::numeric_limits<double>::infinity()};
}

}  // namespace

std::vector<PaperStatement> load_statements(const std::filesystem::path& file,
                                            const std::vector<std::string>& measured) {
    const scenario::YamlNode root = scenario::parse_yaml_file(file);
    const std::vector<std::string_view> names(measured.begin(), measured.end());
    std::vector<PaperStatement> statements;
    if (!is_section(&root)) {
        return statements;
    }
    for (const scenario::YamlNode& map : root.children) {
        if (!is_section(&map)) {
            fail(map, "is empty");
        }
        check_keys(map, {"section", "says", "paper", "unit", "evidence", "accepted", "at_least",
                         "basis", "note", "figure", "flight"});
        PaperStatement& statement = statements.emplace_back();
        statement.id = map.key;
        statement.section = read_text(wanted(map, "section"));
        statement.text = read_text(wanted(map, "says"));
        statement.paper = quantity(wanted(map, "paper"));
        statement.unit = text_or_nothing(map, "unit");
        statement.note = text_or_nothing(map, "note");
        statement.figure = text_or_nothing(map, "figure");
        statement.flight = text_or_nothing(map, "flight");
        read_evidence(map, names, statement);
    }
    return statements;
}

}  // namespace limpet::paper
