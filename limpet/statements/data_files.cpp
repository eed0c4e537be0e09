// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "limpet/scenario/suggestion.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "limpet/statements/claims.hpp"
#include "limpet/statements/study.hpp"

namespace limpet::statements {
namespace {

double number(const scenario::YamlNode& node) {
    const std::optional<double> value = number_in(node);
    if (!value) {
        fail(node, "must be a number");
    }
    return *value;
}

draw::Range range(const scenario::YamlNode& node) {
    const auto& ends = read_list(node, "a range, as in [0.8, 1.4]", 2, 2);
    const draw::Range read{number(ends[0]), number(ends[1])};
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
    std::string text;
    read_given(map, key, text);
    return text;
}

/// @throws InputError when it is none of `names`
template <class Names>
void check_name(const scenario::YamlNode& node, const std::string& text, const Names& names,
                std::string_view otherwise) {
    if (std::find(names.begin(), names.end(), text) == names.end()) {
        fail(node, fmt::format("\"{}\" {}{}", scenario::shown(text), otherwise,
                               scenario::hint(text, {names.begin(), names.end()})));
    }
}

std::string one_of(const scenario::YamlNode& node, const std::vector<std::string_view>& names,
                   std::string_view otherwise) {
    const std::string text = read_text(node);
    check_name(node, text, names, otherwise);
    return text;
}

std::vector<std::string> texts(const scenario::YamlNode& list) {
    std::vector<std::string> read;
    for (const scenario::YamlNode& item : read_list(list, "a list of texts")) {
        read.push_back(read_text(item));
    }
    return read;
}

/// The keys that say what bears a statement out, or none of them.
void read_evidence(const scenario::YamlNode& map, const std::vector<std::string_view>& measured,
                   PaperStatement& statement) {
    const scenario::YamlNode* evidence = map.find("evidence");
    if (evidence == nullptr) {
        for (const char* key : {"unit", "accepted", "at_least", "basis", "assumes", "same_as"}) {
            if (const scenario::YamlNode* node = map.find(key)) {
                fail(*node, "stands without evidence");
            }
        }
        (void)needed(map, "note");  // why not
        return;
    }
    statement.evidence = one_of(*evidence, measured, "is measured by no part");
    statement.claim.basis =
        one_of(needed(map, "basis"), {kBases.begin(), kBases.end()}, "is no basis");
    const bool rests = statement.claim.basis == "fitted" || statement.claim.basis == "measured";
    if (const scenario::YamlNode* assumes = map.find("assumes")) {
        if (!rests) {
            fail(*assumes, "stands with what is neither fitted nor measured");
        }
        statement.claim.assumes = texts(*assumes);
    } else if (rests) {
        (void)needed(map, "assumes");
    }
    const scenario::YamlNode* least = map.find("at_least");
    if (least != nullptr && map.find("accepted") != nullptr) {
        fail(*least, "excludes accepted: give one of the two");
    }
    statement.accepted = least == nullptr
                             ? range(needed(map, "accepted"))
                             : draw::Range{number(*least), std::numeric_limits<double>::infinity()};
}

/// A text whose numbers will be there.
std::string paragraph(const scenario::YamlNode& node, const std::vector<std::string>& measured) {
    const std::string text = read_text(node);
    try {
        (void)filled(text, [&](const std::string& name) {
            check_name(node, name, measured, "is measured by no part");
            return 0.0;
        });
    } catch (const fmt::format_error& error) {
        fail(node, fmt::format("has a format that is none: {}", error.what()));
    }
    return text;
}

report::PageBlock read_block(const scenario::YamlNode& node, const StudyPart& part) {
    if (node.kind == scenario::YamlNode::Kind::scalar) {
        return paragraph(node, part.measures);
    }
    check_name(node, node.key, part.shows, "is shown by no part");
    const std::string title = read_text(needed(node, "title"));
    const scenario::YamlNode* under = node.find("caption");
    const std::string caption = under == nullptr ? "" : paragraph(*under, part.measures);
    if (const scenario::YamlNode* columns = node.find("columns")) {
        check_keys(node, {"title", "columns", "caption"});
        return report::PageTable{
            .id = node.key, .title = title, .columns = texts(*columns), .caption = caption};
    }
    check_keys(node, {"title", "caption", "alt", "wide"});
    const scenario::YamlNode* wide = node.find("wide");
    return report::PageFigure{.id = node.key,
                              .title = title,
                              .caption = caption,
                              .alt = read_text(needed(node, "alt")),
                              .png = "figures/" + node.key + ".png",
                              .svg = "figures/" + node.key + ".svg",
                              .wide = wide != nullptr && read_flag(*wide)};
}

/// Statements of one evidence are the same; all but the first name it in same_as.
void check_same(const scenario::YamlNode& root, const std::vector<PaperStatement>& statements) {
    for (std::size_t i = 0; i < statements.size(); ++i) {
        const PaperStatement& one = statements[i];
        const scenario::YamlNode& map = root.children[i];
        const auto named = [&](const PaperStatement& other) {
            return other.claim.id == one.claim.same_as;
        };
        if (!one.claim.same_as.empty() &&
            std::none_of(statements.begin(), statements.end(), named)) {
            fail(*map.find("same_as"), "names no statement");
        }
        for (std::size_t k = 0; k < i && !one.evidence.empty(); ++k) {
            if (statements[k].evidence == one.evidence &&
                one.claim.same_as != statements[k].claim.id) {
                fail(map, fmt::format("has the evidence of {}: same_as is missing",
                                      statements[k].claim.id));
            }
        }
    }
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
                         "basis", "assumes", "same_as", "note", "figure", "flight"});
        PaperStatement& statement = statements.emplace_back();
        const std::string unit = text_or_nothing(map, "unit"),
                          flight = text_or_nothing(map, "flight");
        statement.yes_no = unit == "yes/no";
        statement.claim = {
            .id = map.key,
            .section = read_text(needed(map, "section")),
            .statement = read_text(needed(map, "says")),
            .paper = quantity(needed(map, "paper")),
            .unit = statement.yes_no ? "" : unit,
            .same_as = text_or_nothing(map, "same_as"),
            .note = text_or_nothing(map, "note"),
            .figure = text_or_nothing(map, "figure"),
            .recording = flight.empty() ? "" : fmt::format("flights/{}/flight.mcap", flight)};
        read_evidence(map, names, statement);
    }
    check_same(root, statements);
    return statements;
}

PageText load_page_text(const std::filesystem::path& file, const std::vector<StudyPart>& parts) {
    const scenario::YamlNode root = scenario::parse_yaml_file(file);
    std::vector<std::string_view> keys = {"title", "subtitle", "summary"};
    for (const StudyPart& part : parts) {
        keys.push_back(part.name);
    }
    check_keys(root, keys);
    PageText page{.title = read_text(needed(root, "title")),
                  .subtitle = read_text(needed(root, "subtitle")),
                  .summary = texts(needed(root, "summary"))};
    for (const scenario::YamlNode& node : needed(root, "summary").children) {
        (void)paragraph(node, kSummaryCounts);
    }
    for (const StudyPart& part : parts) {
        const scenario::YamlNode& section = needed(root, part.name);
        for (const std::string& id : part.shows) {
            (void)needed(section, id);
        }
        for (const scenario::YamlNode& node : section.children) {
            page.blocks[part.name].push_back(read_block(node, part));
        }
    }
    return page;
}

std::string filled(std::string_view text,
                   const std::function<double(const std::string& name)>& number) {
    std::string out;
    while (true) {
        const std::size_t open = text.find('{'), close = text.find('}', open);
        if (open == text.npos) {
            return out += text;
        }
        if (close == text.npos) {
            throw fmt::format_error("a { without its }");
        }
        const std::string_view place = text.substr(open + 1, close - open - 1);
        const std::size_t colon = std::min(place.find(':'), place.size());
        const double value = number(std::string(place.substr(0, colon)));
        out += text.substr(0, open);
        out +=
            fmt::vformat(fmt::format("{{{}}}", place.substr(colon)), fmt::make_format_args(value));
        text.remove_prefix(close + 1);
    }
}

}  // namespace limpet::statements
