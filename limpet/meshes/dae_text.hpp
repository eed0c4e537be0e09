// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <unordered_map>

#include "limpet/core/user_text.hpp"
#include "limpet/core/words.hpp"
#include "limpet/meshes/mesh.hpp"

namespace limpet::meshes {

using DaeNumbers = std::vector<double>;

/// The attributes that ids are looked up by.
class DaeIds : public pugi::xml_tree_walker {
public:
    bool for_each(pugi::xml_node& node) override {
        if (const auto id = node.attribute("id")) {
            nodes_.emplace(id.value(), node);
        }
        return true;
    }
    [[nodiscard]] pugi::xml_node find(const std::string& id) const {
        const auto found = nodes_.find(id);
        return found == nodes_.end() ? pugi::xml_node() : found->second;
    }

private:
    std::unordered_map<std::string, pugi::xml_node> nodes_;
};

/// A COLLADA file's elements, ids and numbers, for dae_reader.cpp.
class DaeText {
public:
    DaeText(std::string name, std::string text)
        : mesh_(std::move(name), "DAE", [this](std::size_t offset) { return line_of(offset); }),
          text_(std::move(text)) {}

protected:
    /// The root of the file, parsed.
    pugi::xml_node open() {
        if (xml_marks(text_) > kMostMarks) {
            mesh_.fail(fmt::format("more than {} elements and attributes", kMostMarks));
        }
        const auto parsed = document_.load_buffer(text_.data(), text_.size());
        if (!parsed) {
            at(parsed.offset);
            mesh_.fail(parsed.description());
        }
        const auto root = document_.child("COLLADA");
        if (!root) {
            mesh_.fail("no DAE: there is no <COLLADA>");
        }
        document_.traverse(ids_);
        return root;
    }

    /// What comes next stands in this element.
    void at(pugi::xml_node node) { at(node.offset_debug()); }
    void at(std::ptrdiff_t offset) {
        mesh_.at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 1)));
    }
    [[noreturn]] void fail(pugi::xml_node node, const std::string& what) {
        at(node);
        mesh_.fail(what);
    }

    /// The element that an attribute names: "#ID".
    pugi::xml_node target(pugi::xml_node node, const char* key, const char* wanted) {
        const std::string url = node.attribute(key).value();
        const auto found = url.rfind('#', 0) == 0 ? ids_.find(url.substr(1)) : pugi::xml_node();
        if (!found || std::string_view(found.name()) != wanted) {
            fail(node, fmt::format("<{}> {}={}: must be the # and id of a <{}> of this file",
                                   node.name(), key, in_quotes(url), wanted));
        }
        return found;
    }
    /// What stands in an element, also before and after a comment within it. A geometry that is
    /// placed often is read as often.
    /// @param joined  keeps the text where it is of several pieces
    Words words_of(pugi::xml_node node, std::string& joined) {
        std::string_view text = node.child_value();
        if (node.first_child() != node.last_child()) {
            joined.clear();
            for (const auto piece : node.children()) {
                joined.append(piece.value()).push_back(' ');
            }
            text = joined;
        }
        scanned_ += text.size();
        if (scanned_ > kMostScanned) {
            fail(node, fmt::format("<{}> is placed so often that more than {} MB would be read",
                                   node.name(), kMostScanned / 1'000'000));
        }
        return Words(text);
    }
    DaeNumbers numbers(pugi::xml_node node, std::size_t most) {
        DaeNumbers values;
        std::string joined;
        Words words = words_of(node, joined);
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const auto value = number_of(word);
            if (!value) {
                fail(node, fmt::format("<{}> {}: must be numbers", node.name(), in_quotes(word)));
            }
            if (values.size() == most) {
                fail(node, fmt::format("<{}>: more than {} numbers", node.name(), most));
            }
            values.push_back(*value);
        }
        return values;
    }
    DaeNumbers numbers_of(pugi::xml_node node, std::size_t count) {
        DaeNumbers values = numbers(node, count);
        if (values.size() != count) {
            fail(node, fmt::format("<{}>: must be {} numbers", node.name(), count));
        }
        return values;
    }
    std::size_t whole(pugi::xml_node node, const char* key, std::size_t otherwise,
                      std::size_t most) {
        const auto attribute = node.attribute(key);
        if (!attribute) {
            return otherwise;
        }
        const auto value = integer_of(attribute.value());
        if (!value || *value < 0 || static_cast<std::size_t>(*value) > most) {
            fail(node, fmt::format("<{}> {}={}: must be from 0 to {}", node.name(), key,
                                   in_quotes(attribute.value()), most));
        }
        return static_cast<std::size_t>(*value);
    }

    MeshBuilder mesh_;

private:
    static constexpr std::size_t kMostScanned = 500'000'000;
    /// As in a <p> for each of a million polygons.
    static constexpr std::size_t kMostMarks = 4'000'000;

    [[nodiscard]] std::size_t line_of(std::size_t offset) const {
        const auto end =
            text_.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text_.size()));
        return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
    }

    std::string text_;
    pugi::xml_document document_;
    DaeIds ids_;
    std::size_t scanned_ = 0;  ///< bytes
};

}  // namespace limpet::meshes
