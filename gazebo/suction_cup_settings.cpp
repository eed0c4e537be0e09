// SPDX-License-Identifier: Apache-2.0
#include "gazebo/suction_cup_settings.hpp"

#include "gazebo/sdf_reader.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/parts.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::gazebo11 {
namespace {

suction::Surface read_surface(const scenario::YamlNode& node) {
    return surface_from(node, scenario::data_root());
}

CupTarget target_of(const scenario::YamlNode& node, const suction::Surface& surface) {
    if (node.kind != scenario::YamlNode::Kind::map) {
        fail(node, "must have attributes, allowed model, collision, plane, surface");
    }
    check_keys(node, {"model", "collision", "plane", "surface"});
    CupTarget target{.surface = surface};
    const bool has_model = node.find("model") != nullptr;
    if (has_model == (node.find("plane") != nullptr)) {
        fail(node, "needs one of model=\"NAME\" and plane=\"x y z roll pitch yaw\"");
    }
    read_if_given(node, "model", scenario::read_text, target.model);
    read_if_given(node, "plane", read_pose, target.plane);
    read_if_given(node, "collision", scenario::read_text, target.collision);
    if (!has_model && !target.collision.empty()) {
        fail(*node.find("collision"), "stands beside plane, allowed beside model");
    }
    read_if_given(node, "surface", read_surface, target.surface);
    return target;
}

/// sdformat writes a child that says true as 1: a row takes both.
const ParameterTable<SuctionCupSettings>& plugin_table() {
    using S = SuctionCupSettings;
    static const ParameterTable<S> table = {
        {"pump", "-", 0.0, 1.0, &S::pump_on, "on at the start", "assumed: off"},
        {"valve", "-", 0.0, 1.0, &S::valve_open, "open at the start", "assumed: shut"},
        {"publish_rate_Hz", "Hz", 0.1, 1000.0, &S::publish_rate_Hz,
         "pressure and state on their topics, in simulated time",
         "assumed: as fast as guidance reads them"},
        {"flatness_m", "m", 1e-4, 0.1, &S::flatness_m,
         "a wall that leaves a plane by more below the lip is none",
         "assumed: the depth at which the lip bottoms out, baseline.md"},
        {"load_time_constant_s", "s", 1e-4, 1.0, &S::load_time_constant_s,
         "of the low-pass over a joint's load, against the solver's spikes",
         "assumed: five steps of 1 ms"},
    };
    return table;
}

}  // namespace

SuctionCupSettings suction_cup_settings(const scenario::YamlNode& tree) {
    SuctionCupSettings settings;
    read_rows(&tree, bind(plugin_table(), settings),
              {"link", "lip_pose", "suction", "surface", "target", "attachment", "seed"});
    if (tree.find("link") == nullptr) {
        fail(tree, "link: is missing, needed: the link that carries the lip");
    }
    read_if_given(tree, "link", scenario::read_text, settings.link);
    read_if_given(tree, "lip_pose", read_pose, settings.X_LC);
    read_suction(tree.find("suction"), settings.cup);
    read_if_given(tree, "surface", read_surface, settings.surface);
    if (const scenario::YamlNode* targets = tree.find("target")) {
        for (const scenario::YamlNode& target : targets->children) {
            settings.targets.push_back(target_of(target, settings.surface));
        }
    }
    read_word_if_given(tree, "attachment", settings.attachment,
                       {{"compliant", Attachment::compliant},
                        {"fixed", Attachment::fixed},
                        {"universal", Attachment::universal}});
    if (settings.valve_open && !settings.cup.valve_fitted) {
        fail(*tree.find("valve"),
             "open, but no valve is fitted, allowed with suction.valve_fitted 1");
    }
    read_if_given(tree, "seed", scenario::read_count, settings.seed);
    return settings;
}

}  // namespace limpet::gazebo11
