// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/suction_cup_settings.hpp"

#include "adapters/gazebo/sdf_reader.hpp"
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
    read_given(node, "model", target.model);
    read_given(node, "plane", target.plane, read_pose);
    read_given(node, "collision", target.collision);
    if (!has_model && !target.collision.empty()) {
        fail(*node.find("collision"), "is given with plane, allowed with model");
    }
    read_given(node, "surface", target.surface, read_surface);
    return target;
}

/// sdformat writes `true` in a child as 1: a row takes both.
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
    read_given(tree, "link", settings.link);
    read_given(tree, "lip_pose", settings.X_LC, read_pose);
    read_suction(tree.find("suction"), settings.cup);
    read_given(tree, "surface", settings.surface, read_surface);
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
    read_given(tree, "seed", settings.seed, scenario::read_count);
    return settings;
}

}  // namespace limpet::gazebo11
