// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml.h>

#include <algorithm>
#include <unordered_set>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/one_line.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/scenario/data_folder.hpp"

namespace limpet::scenario {
namespace {

constexpr FileBound kYamlFile = {"YAML file of ours", 1};
// Every node knows its path: a long way down to many of them would fill the memory.
constexpr std::size_t kMostValues = 50'000;
constexpr std::size_t kMostDepth = 32;
constexpr std::size_t kLongestKey = 100;
constexpr std::size_t kLongestShown = 60;

/// A command line has no lines worth counting.
std::string place_of(const std::string& name, const yaml_mark_t& mark) {
    return name.rfind(kSet, 0) == 0 ? name : fmt::format("{}:{}", name, mark.line + 1);
}

std::string text_of(const yaml_char_t* text) {
    return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
}

/// What stands where a value is, and means none.
bool is_null(std::string_view plain) {
    return plain.empty() || plain == "~" || plain == "null" || plain == "Null" || plain == "NULL";
}

/// Builds the tree from libyaml's events, which keep duplicate keys and marks apart.
class TreeBuilder {
public:
    explicit TreeBuilder(std::string name) : name_(std::move(name)) {}

    void take(const yaml_event_t& event) {
        const yaml_mark_t& mark = event.start_mark;
        switch (event.type) {
            case YAML_DOCUMENT_START_EVENT:
                if (documents_++ > 0) {
                    refuse(mark, "holds more than one document");
                }
                break;
            case YAML_ALIAS_EVENT: refuse(mark, "aliases (*name) are not supported");
            case YAML_SCALAR_EVENT: take_scalar(mark, event.data.scalar); break;
            case YAML_SEQUENCE_START_EVENT: {
                const auto& list = event.data.sequence_start;
                refuse_anchor(mark, list.anchor);
                enter(mark, open(mark, YamlNode::Kind::list, text_of(list.tag)));
                break;
            }
            case YAML_MAPPING_START_EVENT: {
                const auto& map = event.data.mapping_start;
                refuse_anchor(mark, map.anchor);
                enter(mark, open(mark, YamlNode::Kind::map, text_of(map.tag)));
                break;
            }
            case YAML_SEQUENCE_END_EVENT:
            case YAML_MAPPING_END_EVENT: close_top(); break;
            case YAML_NO_EVENT:
            case YAML_STREAM_START_EVENT:
            case YAML_STREAM_END_EVENT:
            case YAML_DOCUMENT_END_EVENT: break;
        }
    }

    [[nodiscard]] YamlNode take() { return std::move(root_); }

private:
    void take_scalar(const yaml_mark_t& mark, const decltype(yaml_event_t{}.data.scalar) & scalar) {
        refuse_anchor(mark, scalar.anchor);
        std::string value(reinterpret_cast<const char*>(scalar.value), scalar.length);
        const bool quoted = scalar.style != YAML_PLAIN_SCALAR_STYLE;
        if (expects_key() && (quoted || !is_null(value))) {
            take_key(mark, value);
            return;
        }
        const bool null = !quoted && scalar.tag == nullptr && is_null(value);
        YamlNode node =
            open(mark, null ? YamlNode::Kind::null : YamlNode::Kind::scalar, text_of(scalar.tag));
        if (!null) {
            node.text = std::move(value);
            node.quoted = quoted;
        }
        close(std::move(node));
    }

    void refuse_anchor(const yaml_mark_t& mark, const yaml_char_t* anchor) const {
        if (anchor != nullptr) {
            refuse(mark, "anchors (&name) are not supported");
        }
    }
    [[noreturn]] void refuse(const yaml_mark_t& mark, std::string_view what) const {
        throw InputError(fmt::format("{}: {}", place_of(name_, mark), what));
    }

    [[nodiscard]] bool expects_key() const {
        return !stack_.empty() && stack_.back().kind == YamlNode::Kind::map && key_.empty();
    }

    void take_key(const yaml_mark_t& mark, const std::string& key) {
        const YamlNode& map = stack_.back();
        if (key.empty()) {
            refuse(mark, "a key is empty");
        }
        if (key.size() > kLongestKey) {
            refuse(mark, fmt::format("a key of {} characters, allowed 1..{}: {}", key.size(),
                                     kLongestKey, shown(key)));
        }
        if (!keys_.back().insert(key).second) {
            const YamlNode& first = *map.find(key);
            refuse(mark,
                   fmt::format("{}: is given twice, first at {}", shown(first.path), first.place));
        }
        key_ = key;
        key_place_ = place_of(name_, mark);
    }

    YamlNode open(const yaml_mark_t& mark, YamlNode::Kind kind, const std::string& tag) {
        if (expects_key()) {
            refuse(mark, "a key must be a plain word, not a list or a section");
        }
        if (!tag.empty()) {
            refuse(mark, fmt::format("tags ({}) are not supported", shown(tag)));
        }
        if (++values_ > kMostValues) {
            refuse(mark, fmt::format("more than {} values and sections", kMostValues));
        }
        YamlNode node;
        node.kind = kind;
        node.place = place_of(name_, mark);
        if (!stack_.empty() && stack_.back().kind == YamlNode::Kind::map) {
            const std::string& parent = stack_.back().path;
            node.key = key_;
            node.path = parent.empty() ? key_ : parent + "." + key_;
            node.place = key_place_;
            key_.clear();
        } else if (!stack_.empty()) {
            node.path = fmt::format("{}[{}]", stack_.back().path, stack_.back().children.size());
        }
        return node;
    }

    void enter(const yaml_mark_t& mark, YamlNode node) {
        if (stack_.size() >= kMostDepth) {
            refuse(mark,
                   fmt::format("more than {} sections and lists within each other", kMostDepth));
        }
        stack_.push_back(std::move(node));
        keys_.emplace_back();
    }

    void close(YamlNode node) {
        if (stack_.empty()) {
            root_ = std::move(node);
        } else {
            stack_.back().children.push_back(std::move(node));
        }
    }

    void close_top() {
        YamlNode node = std::move(stack_.back());
        stack_.pop_back();
        keys_.pop_back();
        close(std::move(node));
    }

    std::string name_;
    std::string key_;
    std::string key_place_;
    std::vector<YamlNode> stack_;
    std::vector<std::unordered_set<std::string>> keys_;  ///< of every map in the stack
    std::size_t values_ = 0;
    YamlNode root_;
    int documents_ = 0;
};

/// libyaml's parser and the event that it is at.
class Parser {
public:
    /// @param text  outlives it
    explicit Parser(const std::string& text) {
        require(yaml_parser_initialize(&parser_) != 0, "memory for a YAML parser");
        yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
        yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()),
                                     text.size());
    }
    ~Parser() {
        yaml_event_delete(&event_);
        yaml_parser_delete(&parser_);
    }
    Parser(const Parser&) = delete;
    Parser& operator=(const Parser&) = delete;

    /// @return null at the end
    /// @throws InputError for what is not YAML
    [[nodiscard]] const yaml_event_t* next(const std::string& name) {
        if (event_.type == YAML_STREAM_END_EVENT) {
            return nullptr;
        }
        yaml_event_delete(&event_);
        if (yaml_parser_parse(&parser_, &event_) == 0) {
            throw InputError(fmt::format("{}: is not valid YAML: {} (column {})",
                                         place_of(name, parser_.problem_mark),
                                         parser_.problem != nullptr ? parser_.problem : "not read",
                                         parser_.problem_mark.column + 1));
        }
        return &event_;
    }

private:
    yaml_parser_t parser_{};
    yaml_event_t event_{};
};

/// Control characters, among them the zeros of a binary file, are in no text that a human wrote.
bool is_text(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x20 ? byte != 0x7f : c == '\n' || c == '\r' || c == '\t';
    });
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view name) const {
    return kind == Kind::map ? find_by(children, &YamlNode::key, name) : nullptr;
}

YamlNode parse_yaml(const std::string& text, const std::string& name) {
    if (!is_text(text)) {
        throw InputError(name + ": is not a text file");
    }
    if (!is_utf8(text)) {
        throw InputError(name + ": is not UTF-8 text");
    }
    if (text.size() > kYamlFile.most_MB * 1'000'000) {  // that of a recording came another way
        throw InputError(name + ": is larger than 1 MB, which no YAML file of ours is");
    }
    if (const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
        first != text.npos && text[first] == '<' && text.compare(first, 2, "<<") != 0) {
        throw InputError(name +
                         ":1: is XML, not YAML; a URDF or MJCF is named in a vehicle's file, under "
                         "`model` (docs/own_vehicle.md)");
    }
    TreeBuilder builder(name);
    Parser parser(text);
    while (const yaml_event_t* event = parser.next(name)) {
        builder.take(*event);
    }
    YamlNode root = builder.take();
    if (root.kind == YamlNode::Kind::null) {
        throw InputError(name + ": is empty");
    }
    root.place = name;  // what is wrong with the whole is in no line
    return root;
}

std::string read_yaml_text(const std::filesystem::path& path) {
    if (const std::string name = shipped_name_of(path); !name.empty() && !is_there(path)) {
        throw InputError(fmt::format("{}: no such file; {} ships, and goes by that name alone",
                                     shown_path(path), name));
    }
    return read_file(path, kYamlFile, shown_path(path));
}

YamlNode parse_yaml_file(const std::filesystem::path& path) {
    return parse_yaml(read_yaml_text(path), shown_path(path));
}

std::string shown_path(const std::filesystem::path& path) {
    std::error_code error;
    const auto relative = std::filesystem::proximate(path, error);
    const bool outside = error || relative.empty() || *relative.begin() == "..";
    return one_line(outside ? path.string() : relative.string());
}

std::string shown(std::string_view text) {
    if (text.size() <= kLongestShown) {
        return one_line(std::string(text));
    }
    std::size_t cut = kLongestShown;
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0U) == 0x80U) {
        --cut;  // not within a character of UTF-8
    }
    return one_line(std::string(text.substr(0, cut))) + "...";
}

void fail(const YamlNode& node, std::string_view what) {
    const bool stated =
        node.path.empty() || node.place.rfind(std::string(kSet) + node.path + "=", 0) == 0;
    throw InputError(stated ? fmt::format("{}: {}", node.place, what)
                            : fmt::format("{}: {}: {}", node.place, shown(node.path), what));
}

}  // namespace limpet::scenario
