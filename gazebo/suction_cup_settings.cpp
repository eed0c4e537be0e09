// SPDX-License-Identifier: Apache-2.0
#include "gazebo/suction_cup_settings.hpp"

#include "gazebo/sdf_reader.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/parts.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::gazebo11 {
namespace {

Attachment attachment_of(const scenario::YamlNode& node) {
    const std::string text = read_text(node);
    if (text == "compliant") {
        return Attachment::compliant;
    }
    if (text == "fixed") {
        return Attachment::fixed;
    }
    if (text == "universal") {
        return Attachment::universal;
    }
    fail(node, "\"" + scenario::shown(text) +
                   "\" is not an attachment, allowed compliant, fixed, universal");
}

/// sdformat writes a child that says true as 1.
bool read_switch(const scenario::YamlNode& node) {
    bool value = false;
    return read_number(node, {node.key, "switch", 0.0, 1.0, &value, {}, {}}) != 0.0;
}

CupTarget target_of(const scenario::YamlNode& node, const suction::Surface& surface) {
    if (node.kind != scenario::YamlNode::Kind::map) {
        fail(node, "must have attributes, allowed model, collision, plane, surface");
    }
    check_keys(node, {"model", "collision", "plane", "surface"});
    CupTarget target{.model = {}, .collision = {}, .plane = {}, .surface = surface};
    const scenario::YamlNode* const model = node.find("model");
    const scenario::YamlNode* const plane = node.find("plane");
    if ((model == nullptr) == (plane == nullptr)) {
        fail(node, "needs one of model=\"NAME\" and plane=\"x y z roll pitch yaw\"");
    }
    if (model != nullptr) {
        target.model = read_text(*model);
    } else {
        target.plane = read_pose(*plane);
    }
    if (const scenario::YamlNode* collision = node.find("collision")) {
        if (model == nullptr) {
            fail(*collision, "stands beside plane, allowed beside model");
        }
        target.collision = read_text(*collision);
    }
    if (const scenario::YamlNode* named = node.find("surface")) {
        target.surface = surface_from(*named, scenario::data_root());
    }
    return target;
}

}  // namespace

const ParameterTable<CupPluginParameters>& cup_plugin_table() {
    using P = CupPluginParameters;
    static const ParameterTable<P> table = {
        {"publish_rate_Hz", "Hz", 0.1, 1000.0, &P::publish_rate_Hz,
         "pressure and state on their topics, in simulated time",
         "assumed: as fast as guidance reads them"},
        {"flatness_m", "m", 1e-4, 0.1, &P::flatness_m,
         "a wall that leaves a plane by more below the lip is none",
         "assumed: the depth at which the lip bottoms out, baseline.md"},
        {"load_time_constant_s", "s", 1e-4, 1.0, &P::load_time_constant_s,
         "of the low-pass over a joint's load, against the solver's spikes",
         "assumed: five steps of 1 ms"},
    };
    return table;
}

SuctionCupSettings suction_cup_settings(const scenario::YamlNode& tree) {
    SuctionCupSettings settings;
    const auto plugin_rows = bind(cup_plugin_table(), settings.plugin);
    std::vector<std::string_view> keys = {"link",       "lip_pose", "suction", "surface", "target",
                                          "attachment", "pump",     "valve",   "seed"};
    for (const BoundParameter& row : plugin_rows) {
        keys.push_back(row.name);
    }
    check_keys(tree, keys);
    read_rows(&tree, plugin_rows, keys);
    const scenario::YamlNode* const link = tree.find("link");
    if (link == nullptr) {
        fail(tree, "link: is missing, needed: the link that carries the lip");
    }
    settings.link = read_text(*link);
    if (const scenario::YamlNode* pose = tree.find("lip_pose")) {
        settings.X_LC = read_pose(*pose);
    }
    read_suction(tree.find("suction"), settings.cup);
    if (const scenario::YamlNode* surface = tree.find("surface")) {
        settings.surface = surface_from(*surface, scenario::data_root());
    }
    if (const scenario::YamlNode* targets = tree.find("target")) {
        for (const scenario::YamlNode& target : targets->children) {
            settings.targets.push_back(target_of(target, settings.surface));
        }
    }
    if (const scenario::YamlNode* attachment = tree.find("attachment")) {
        settings.attachment = attachment_of(*attachment);
    }
    if (const scenario::YamlNode* pump = tree.find("pump")) {
        settings.pump_on = read_switch(*pump);
    }
    if (const scenario::YamlNode* valve = tree.find("valve")) {
        settings.valve_open = read_switch(*valve);
        if (settings.valve_open && !settings.cup.valve_fitted) {
            fail(*valve, "open, but no valve is fitted, allowed with suction.valve_fitted 1");
        }
    }
    if (const scenario::YamlNode* seed = tree.find("seed")) {
        settings.seed = read_count(*seed);
    }
    return settings;
}

}  // namespace limpet::gazebo11
