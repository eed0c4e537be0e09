// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/yaml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "limpet/core/words.hpp"
#include "limpet/scenario/suggestion.hpp"

namespace limpet::scenario {
namespace {

/// What a node is, for "must be a number, is ...".
std::string what_it_is(const YamlNode& node) {
    switch (node.kind) {
        case YamlNode::Kind::null: return "empty";
        case YamlNode::Kind::scalar: return fmt::format("\"{}\"", shown(node.text));
        case YamlNode::Kind::list: return "a list";
        case YamlNode::Kind::map: return "a section";
    }
    return "";
}

[[noreturn]] void fail_type(const YamlNode& node, std::string_view wanted) {
    fail(node, fmt::format("must be {}, is {}", wanted, what_it_is(node)));
}

bool is_plain(const YamlNode& node) {
    return node.kind == YamlNode::Kind::scalar && !node.quoted;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// .nan, -.inf and how else people write them.
bool is_not_finite(const std::string& text) {
    std::string word = lower(text);
    word.erase(0, word.find_first_not_of("+-."));
    return word == "nan" || word == "inf" || word == "infinity";
}

}  // namespace

bool is_section(const YamlNode* section) {
    if (section == nullptr || section->kind == YamlNode::Kind::null) {
        return false;
    }
    if (section->kind != YamlNode::Kind::map) {
        fail_type(*section, "a section (key: value)");
    }
    return true;
}

void check_keys(const YamlNode& map, const std::vector<std::string_view>& allowed,
                std::string_view where) {
    for (const YamlNode& child : map.children) {
        if (std::find(allowed.begin(), allowed.end(), child.key) == allowed.end()) {
            fail(child, "unknown key" + hint(child.key, allowed, where));
        }
    }
}

const YamlNode& needed(const YamlNode& map, std::string_view key) {
    const YamlNode* node = map.find(key);
    if (node == nullptr) {
        fail(map, fmt::format("{}: is missing", key));
    }
    return *node;
}

std::optional<double> number_in(const YamlNode& node) {
    return is_plain(node) ? number_of(node.text) : std::nullopt;
}

double read_number(const YamlNode& node, const BoundParameter& row) {
    const auto value = number_in(node);
    if (row.value.is_switch() && value != 0.0 && value != 1.0) {
        return read_flag(node) ? 1.0 : 0.0;
    }
    if (is_plain(node) && is_not_finite(node.text)) {
        fail(node, fmt::format("{} is not a finite number, allowed {}", shown(node.text),
                               allowed_text(row)));
    }
    if (!value) {
        fail(node, fmt::format("must be a number, is {}, allowed {}", what_it_is(node),
                               allowed_text(row)));
    }
    if (row.value.is_count() && *value != std::floor(*value)) {
        fail(node, fmt::format("{} is not a whole number, allowed {}", shown(node.text),
                               allowed_text(row)));
    }
    if (!(*value >= row.minimum && *value <= row.maximum)) {
        fail(node,
             fmt::format("{} is out of range, allowed {}", shown(node.text), allowed_text(row)));
    }
    return *value;
}

std::string read_text(const YamlNode& node) {
    if (node.kind != YamlNode::Kind::scalar) {
        fail_type(node, "text");
    }
    return node.text;
}

bool read_flag(const YamlNode& node) {
    const std::string word = is_plain(node) ? lower(node.text) : "";
    if (word != "true" && word != "false") {
        fail_type(node, "true or false");
    }
    return word == "true";
}

std::uint64_t read_count(const YamlNode& node) {
    return read_count_within(node, 0, std::numeric_limits<std::uint64_t>::max());
}

std::uint64_t read_count_within(const YamlNode& node, std::uint64_t from, std::uint64_t to) {
    std::uint64_t value = 0;
    const char* end = node.text.data() + node.text.size();
    const auto result = std::from_chars(node.text.data(), end, value);
    if (!is_plain(node) || result.ec != std::errc{} || result.ptr != end) {
        fail_type(node, fmt::format("a whole number {}..{}", from, to));
    }
    if (value < from || value > to) {
        fail(node, fmt::format("{} is out of range, allowed {}..{}", value, from, to));
    }
    return value;
}

std::size_t read_one_of(const YamlNode& node, const std::vector<std::string_view>& words) {
    const std::string word = read_text(node);
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) {
        fail(node, fmt::format("\"{}\" is none of {}", shown(word), fmt::join(words, ", ")));
    }
    return static_cast<std::size_t>(found - words.begin());
}

const std::vector<YamlNode>& read_list(const YamlNode& node, std::string_view wanted,
                                       std::size_t least, std::size_t most) {
    if (node.kind != YamlNode::Kind::list || node.children.size() < least ||
        node.children.size() > most) {
        fail(node, fmt::format("must be {}", wanted));
    }
    return node.children;
}

void read_rows(const YamlNode* section, const std::vector<BoundParameter>& rows,
               const std::vector<std::string_view>& others) {
    if (!is_section(section)) {
        return;
    }
    std::vector<std::string_view> allowed = others;
    for (const BoundParameter& row : rows) {
        allowed.push_back(row.name);
    }
    const std::string part = section->path.substr(0, section->path.find('.'));
    check_keys(*section, allowed,
               part.empty() ? "" : fmt::format("`limpet params {}` lists what there is", part));
    read_given(*section, rows);
}

void read_given(const YamlNode& map, const std::vector<BoundParameter>& rows) {
    for (const BoundParameter& row : rows) {
        if (const YamlNode* node = map.find(row.name)) {
            row.value.set(read_number(*node, row));
        }
    }
}

std::string number_text(double value) {
    return fmt::format("{}", value);
}

std::string value_text(const ParameterValue& value) {
    return value.is_switch()  ? (value.get() != 0.0 ? "true" : "false")
           : value.is_count() ? fmt::format("{:.0f}", value.get())
                              : number_text(value.get());
}

std::string allowed_text(const BoundParameter& row) {
    const bool bare = row.unit == "-" || row.unit == "count";
    return fmt::format("{}..{}{}{}", number_text(row.minimum), number_text(row.maximum),
                       bare ? "" : " ", bare ? "" : row.unit);
}

}  // namespace limpet::scenario
