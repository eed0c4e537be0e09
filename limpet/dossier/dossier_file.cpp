// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "limpet/core/errors.hpp"
#include "limpet/dossier/dossier_runs.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/yaml_reader.hpp"
#include "limpet/study/study.hpp"

namespace limpet::dossier {
namespace {

using scenario::YamlNode;

std::string level(const YamlNode& node) {
    const std::string text = read_text(node);
    if (text != "low" && text != "medium" && text != "high") {
        fail(node, fmt::format("\"{}\" must be low, medium or high", scenario::shown(text)));
    }
    return text;
}

std::vector<UncertainInput> read_inputs(const YamlNode& map) {
    std::vector<UncertainInput> inputs;
    for (const YamlNode& node : map.children) {
        check_keys(node, {"spread", "source"});
        inputs.push_back({.key = node.key,
                          .spread = read_text(needed(node, "spread")),
                          .source = read_text(needed(node, "source"))});
    }
    if (inputs.empty()) {
        fail(map, "names no input");
    }
    return inputs;
}

Quantity read_quantity(const YamlNode& node, const DossierFile& file) {
    check_keys(node, {"figure", "scenario", "unit", "use", "influence", "consequence", "safe",
                      "evidence"});
    Quantity quantity{.name = node.key,
                      .figure = read_text(needed(node, "figure")),
                      .scenario = read_text(needed(node, "scenario")),
                      .unit = read_text(needed(node, "unit")),
                      .use = read_text(needed(node, "use")),
                      .influence = level(needed(node, "influence")),
                      .consequence = level(needed(node, "consequence")),
                      .safe_above = false,
                      .evidence = {}};
    if (file.inputs.count(quantity.scenario) == 0) {
        fail(needed(node, "scenario"),
             fmt::format("\"{}\" has no inputs above", scenario::shown(quantity.scenario)));
    }
    try {
        (void)study::parse_figure(quantity.figure);
    } catch (const InputError&) {
        fail(needed(node, "figure"),
             fmt::format("\"{}\" is no outcome and no metric (limpet study --help)",
                         scenario::shown(quantity.figure)));
    }
    const YamlNode& safe = needed(node, "safe");
    const std::string side = read_text(safe);
    if (side != "at_least" && side != "at_most") {
        fail(safe, fmt::format("\"{}\" must be at_least or at_most", scenario::shown(side)));
    }
    quantity.safe_above = side == "at_least";
    if (const YamlNode* evidence = node.find("evidence")) {
        for (const YamlNode& id : read_list(*evidence, "a list of ids, as in [spike]", 0)) {
            quantity.evidence.push_back(read_text(id));
        }
    }
    return quantity;
}

}  // namespace

DossierFile load_dossier(const std::filesystem::path& path) {
    const YamlNode root =
        scenario::parse_yaml(scenario::read_yaml_text(path), scenario::shown_path(path));
    if (!is_section(&root)) {
        fail(root, "is empty");
    }
    check_keys(root, {"title", "question", "inputs", "quantities"});
    DossierFile file;
    file.title = read_text(needed(root, "title"));
    file.question = read_text(needed(root, "question"));
    for (const YamlNode& one : needed(root, "inputs").children) {
        if (scenario::is_path(one.key)) {
            fail(one, "must be the name of a scenario, not a file: its flights' folders have it");
        }
        file.inputs[one.key] = read_inputs(one);
    }
    for (const YamlNode& quantity : needed(root, "quantities").children) {
        file.quantities.push_back(read_quantity(quantity, file));
    }
    if (file.quantities.empty()) {
        fail(needed(root, "quantities"), "names no quantity");
    }
    return file;
}

}  // namespace limpet::dossier
