// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/fault_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limpet/core/user_text.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {
namespace {

using faults::Fault;
using faults::KindRow;

constexpr double kLongest_s = 1e6;
constexpr double kNever_s = 1e9;  ///< what the former keys gave for never

double read_in(const YamlNode& node, std::string_view unit, double least, double most) {
    double value = 0.0;
    return read_number(node, {{}, unit, least, most, &value, {}, {}});
}

int read_unit(const YamlNode& node, const KindRow& row, std::size_t rotors) {
    if (row.units == 0) {
        fail(node, fmt::format("there is one alone of {}", to_string(row.kind)));
    }
    if (node.kind == YamlNode::Kind::scalar && node.text == "all") {
        return faults::kEveryUnit;
    }
    const int most = (row.units == faults::kRotors ? static_cast<int>(rotors) : row.units) - 1;
    int unit = 0;
    return static_cast<int>(
        read_number(node, {{}, "-", 0.0, static_cast<double>(most), &unit, {}, {}}));
}

/// An enumerator by its name, of more than a line lists.
template <class Enum>
Enum read_word(const YamlNode& node, std::string_view what, std::string_view where = {}) {
    const std::string word = read_text(node);
    const std::optional<Enum> found = enumerator_of<Enum>(word);
    if (!found) {
        const auto& names = kNamesOf<Enum>;
        fail(node, fmt::format("{} is no {}{}", in_quotes(word), what,
                               hint(word, {names.begin(), names.end()}, where)));
    }
    return *found;
}

Fault read_fault(const YamlNode& node, std::size_t rotors) {
    if (!is_section(&node)) {
        fail(node, "needs a fault, as in {fault: motor_lost, unit: 2, phase: approaching}");
    }
    check_keys(node, {"fault", "unit", "size", "phase", "at_s", "after_s", "for_s"});
    Fault fault;
    const YamlNode* named = node.find("fault");
    if (named == nullptr) {
        fail(node, "says no fault, as in {fault: motor_lost}; `limpet list faults`");
    }
    fault.kind =
        read_word<faults::FaultKind>(*named, "fault", "`limpet list faults` says which there are");
    const KindRow& row = kind_row(fault.kind);
    fault.size = row.size_usual;
    if (row.units == faults::kRotors) {
        fault.unit = 0;
    }
    read_given(node, "unit", fault.unit,
               [&](const YamlNode& unit) { return read_unit(unit, row, rotors); });
    if (const YamlNode* size = node.find("size")) {
        if (row.size_unit.empty()) {
            fail(*size, fmt::format("{} has no size", to_string(row.kind)));
        }
        fault.size = read_in(*size, row.size_unit, row.size_min, row.size_max);
    }
    const auto time_of = [](const YamlNode& time) { return read_in(time, "s", 0.0, kLongest_s); };
    const YamlNode* at = node.find("at_s");
    if (const YamlNode* phase = node.find("phase")) {
        if (at != nullptr) {
            fail(*at, "goes with no phase: write after_s, counted from the phase's beginning");
        }
        fault.phase = read_word<guidance::PerchingState>(*phase, "phase");
        read_given(node, "after_s", fault.after_s, time_of);
    } else if (const YamlNode* after = node.find("after_s")) {
        fail(*after,
             "needs a phase after whose beginning it counts; at_s counts from the flight's");
    }
    if (at != nullptr) {
        fault.after_s = time_of(*at);
    }
    read_given(node, "for_s", fault.for_s, time_of);
    return fault;
}

}  // namespace

std::vector<Fault> read_faults(const YamlNode& node, std::size_t rotors) {
    if (node.kind == YamlNode::Kind::null) {
        return {};
    }
    if (node.kind == YamlNode::Kind::map) {
        return {read_fault(node, rotors)};
    }
    std::vector<Fault> all;
    for (const YamlNode& item :
         read_list(node, "a list of faults, as in [{fault: motor_lost, unit: 2, at_s: 5}]", 0,
                   faults::kMostFaults)) {
        all.push_back(read_fault(item, rotors));
    }
    return all;
}

std::string fault_text(const Fault& fault) {
    const KindRow& row = kind_row(fault.kind);
    std::string text = fmt::format("{{fault: {}", to_string(fault.kind));
    const auto add = [&](std::string_view key, const auto& value) {
        text += fmt::format(", {}: {}", key, value);
    };
    if (row.units != 0) {
        add("unit", fault.unit == faults::kEveryUnit ? "all" : fmt::format("{}", fault.unit));
    }
    if (!row.size_unit.empty()) {
        add("size", number_text(fault.size));
    }
    if (fault.phase) {
        add("phase", to_string(*fault.phase));
    }
    add(fault.phase ? "after_s" : "at_s", number_text(fault.after_s));
    if (std::isfinite(fault.for_s)) {
        add("for_s", number_text(fault.for_s));
    }
    return text + "}";
}

std::vector<CatalogueEntry> list_faults() {
    std::vector<CatalogueEntry> all;
    for (std::size_t i = 0; i < kNamesOf<faults::FaultKind>.size(); ++i) {
        const KindRow& row = faults::kind_row(static_cast<faults::FaultKind>(i));
        all.push_back(
            {std::string(to_string(row.kind)),
             row.size_unit.empty()
                 ? std::string(row.description)
                 : fmt::format("{} (size: {} {}, allowed {}..{})", row.description, row.size_usual,
                               row.size_unit, row.size_min, row.size_max)});
    }
    return all;
}

void refuse_fault_keys(const YamlNode* sensors) {
    if (sensors == nullptr || sensors->kind != YamlNode::Kind::map) {
        return;
    }
    constexpr std::array<std::string_view, kFormerFaultKeys.size()> kInstead = {
        "fault: lidar_lost, unit: 0", "fault: lidar_lost, unit: 1", "fault: mocap_lost",
        "fault: force_lost", "fault: pressure_stuck"};
    for (std::size_t i = 0; i < kFormerFaultKeys.size(); ++i) {
        const YamlNode* node = sensors->find(kFormerFaultKeys[i]);
        if (node != nullptr && number_in(*node).value_or(0.0) < kNever_s) {
            fail(*node, fmt::format("is no key any more: write faults: [{{{}, at_s: {}}}]",
                                    kInstead[i], shown(node->text)));
        }
    }
}

}  // namespace limpet::scenario
