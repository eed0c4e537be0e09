// SPDX-License-Identifier: Apache-2.0
#include "limpet/statements/registers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "limpet/study/study.hpp"

namespace limpet::statements {
namespace {

constexpr std::size_t kMost = 5;

std::string settled_text(const std::vector<assumptions::Settled>& all, std::size_t k) {
    return k < all.size() ? fmt::format("{} ({:.2f})", all[k].by, all[k].share) : "-";
}

bool is_weighed(const std::string& figure) {
    try {
        return figure == assumptions::kSuccess || !study::parse_figure(figure).is_event;
    } catch (const InputError&) {
        return false;
    }
}

std::string flips_text(const assumptions::Register& all) {
    std::string text;
    std::size_t flights = 0;
    for (const assumptions::Weighed& weighed : all.values) {
        flights += weighed.flights;
        if (!weighed.flips.empty()) {
            text += fmt::format("{}{} = {:g}: {}", text.empty() ? "" : "; ", weighed.assumption.key,
                                weighed.assumption.value, flip_text(weighed));
        }
    }
    return text.empty() ? fmt::format("none of {}", flights) : text;
}

}  // namespace

TableRows moved_rows(const std::string& name, std::string_view figure,
                     const assumptions::Register& all) {
    TableRows rows;
    for (const assumptions::Weighed* weighed : that_move(all, figure, kMost)) {
        const assumptions::Effect& effect = effect_of(*weighed, figure);
        const assumptions::Assumption& of = weighed->assumption;
        rows.push_back({name, effect.base, of.key,
                        fmt::format("{:g}{}{}", of.value, of.unit.empty() ? "" : "\u00a0", of.unit),
                        fmt::format("{:+.3g}\u00a0±\u00a0{:.2g}", effect.change, effect.error),
                        of.measurement.empty() ? std::string("nothing simple") : of.measurement});
    }
    if (rows.empty()) {
        const std::string none = fmt::format("none of {} assumed values", all.values.size());
        const bool weighed = !all.values.empty() && effect_of(all.values.front(), figure).seeds > 0;
        rows.push_back({name,
                        weighed ? report::Quantity(effect_of(all.values.front(), figure).base)
                                : report::Quantity("-"),
                        none, "-", "-", "-"});
    }
    return rows;
}

TableRows::value_type settled_row(const std::string& name, std::string_view figure,
                                  const assumptions::Register& all) {
    const auto settled = settled_by(all, figure);
    return {name, settled_text(settled, 0), settled_text(settled, 1), flips_text(all)};
}

std::filesystem::path readme_claims_file() {
    return scenario::data_root() / "paper" / "readme.yaml";
}

std::vector<ReadmeClaim> load_readme_claims(const std::filesystem::path& file) {
    const scenario::YamlNode root = scenario::parse_yaml_file(file);
    if (!is_section(&root)) {
        fail(root, "is empty");
    }
    std::vector<ReadmeClaim> claims;
    for (const scenario::YamlNode& map : root.children) {
        if (!is_section(&map)) {
            fail(map, "is empty");
        }
        check_keys(map, {"says", "shown", "scenario", "set", "draws", "figure", "seeds"});
        ReadmeClaim& claim =
            claims.emplace_back(ReadmeClaim{.id = map.key,
                                            .says = read_text(needed(map, "says")),
                                            .shown = read_text(needed(map, "shown")),
                                            .scenario = read_text(needed(map, "scenario")),
                                            .figure = read_text(needed(map, "figure"))});
        if (!is_weighed(claim.figure)) {
            fail(needed(map, "figure"),
                 fmt::format("\"{}\" is no metric and not {}", scenario::shown(claim.figure),
                             assumptions::kSuccess));
        }
        read_given(map, "draws", claim.draws);
        if (const scenario::YamlNode* set = map.find("set")) {
            for (const scenario::YamlNode& item : read_list(*set, "a list of key=value")) {
                claim.set.push_back(read_text(item));
            }
        }
        if (const scenario::YamlNode* seeds = map.find("seeds")) {
            const auto number = number_in(*seeds);
            if (!number || *number < 1.0 || *number > 1000.0) {
                fail(*seeds, "must be a number from 1 to 1000");
            }
            claim.seeds = static_cast<int>(*number);
        }
    }
    return claims;
}

}  // namespace limpet::statements
