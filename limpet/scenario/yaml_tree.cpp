// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>
#include <unordered_set>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"

namespace limpet::scenario {
namespace {

constexpr FileBound kYamlFile = {"YAML file of ours", 1};
// Every node knows its path: a long way down to many of them would fill the memory.
constexpr std::size_t kMostValues = 50'000;
constexpr std::size_t kMostDepth = 32;
constexpr std::size_t kLongestKey = 100;
constexpr std::size_t kLongestShown = 60;

/// A command line has no lines worth counting.
std::string place_of(const std::string& name, const YAML::Mark& mark) {
    return name.rfind(kSet, 0) == 0 ? name : fmt::format("{}:{}", name, std::max(mark.line, 0) + 1);
}

std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    return text;
}

/// Builds the tree from yaml-cpp's events, which keep duplicate keys and marks apart.
class TreeBuilder : public YAML::EventHandler {
public:
    explicit TreeBuilder(std::string name) : name_(std::move(name)) {}

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (documents_++ > 0) {
            refuse(mark, "holds more than one document");
        }
    }
    void OnDocumentEnd() override {}
    void OnAnchor(const YAML::Mark& mark, const std::string& /*anchor*/) override {
        refuse(mark, "anchors (&name) are not supported");
    }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
        refuse(mark, "aliases (*name) are not supported");
    }
    void OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
        close(open(mark, YamlNode::Kind::null));
    }
    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                  const std::string& value) override {
        if (expects_key()) {
            take_key(mark, value);
            return;
        }
        YamlNode node = open(mark, YamlNode::Kind::scalar, tag);
        node.text = value;
        node.quoted = tag == "!";
        close(std::move(node));
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                         YAML::EmitterStyle::value /*style*/) override {
        enter(mark, open(mark, YamlNode::Kind::list, tag));
    }
    void OnSequenceEnd() override { close_top(); }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                    YAML::EmitterStyle::value /*style*/) override {
        enter(mark, open(mark, YamlNode::Kind::map, tag));
    }
    void OnMapEnd() override { close_top(); }

    [[nodiscard]] YamlNode take() { return std::move(root_); }

private:
    [[noreturn]] void refuse(const YAML::Mark& mark, std::string_view what) const {
        throw InputError(fmt::format("{}: {}", place_of(name_, mark), what));
    }

    [[nodiscard]] bool expects_key() const {
        return !stack_.empty() && stack_.back().kind == YamlNode::Kind::map && key_.empty();
    }

    void take_key(const YAML::Mark& mark, const std::string& key) {
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

    YamlNode open(const YAML::Mark& mark, YamlNode::Kind kind, const std::string& tag = "?") {
        if (expects_key()) {
            refuse(mark, "a key must be a plain word, not a list or a section");
        }
        if (!tag.empty() && tag != "?" && tag != "!") {
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

    void enter(const YAML::Mark& mark, YamlNode node) {
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
    TreeBuilder builder(name);
    try {
        std::istringstream stream(text);
        YAML::Parser parser(stream);
        while (parser.HandleNextDocument(builder)) {
        }
    } catch (const YAML::Exception& error) {
        throw InputError(fmt::format("{}: is not valid YAML: {} (column {})",
                                     place_of(name, error.mark), error.msg,
                                     std::max(error.mark.column, 0) + 1));
    }
    YamlNode root = builder.take();
    if (root.kind == YamlNode::Kind::null) {
        throw InputError(name + ": is empty");
    }
    root.place = name;  // what is wrong with the whole is in no line
    return root;
}

std::string read_yaml_text(const std::filesystem::path& path) {
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
    const bool told =
        node.path.empty() || node.place.rfind(std::string(kSet) + node.path + "=", 0) == 0;
    throw InputError(told ? fmt::format("{}: {}", node.place, what)
                          : fmt::format("{}: {}: {}", node.place, shown(node.path), what));
}

}  // namespace limpet::scenario
