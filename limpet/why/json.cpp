// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "limpet/why/why.hpp"

namespace limpet::why {
namespace {

using WhyJson = nlohmann::ordered_json;

// Numbers that are none become null by themselves.
WhyJson json_of(const Hold& hold) {
    const LipLoads& loads = hold.loads;
    return {{"sealed_s", hold.sealed_s},
            {"attached_s", hold.attached_s},
            {"ended_s", hold.ended_s},
            {"let_go", hold.let_go},
            {"on_purpose", hold.on_purpose},
            {"phase", hold.phase},
            {"pressure_min_Pa", hold.pressure_Pa},
            {"pitch_max_deg", hold.pitch_deg},
            {"margin_min_N", hold.margin_N},
            {"pull_N", loads.pull_N},
            {"pull_most_N", loads.pull_most_N},
            {"shear_N", loads.shear_N},
            {"shear_most_N", loads.shear_most_N},
            {"peel_N_m", loads.peel_N_m},
            {"peel_most_N_m", loads.peel_most_N_m},
            {"peel_by",
             {{"centring_spring_N_m", hold.peel.spring_N_m},
              {"centring_damper_N_m", hold.peel.damper_N_m},
              {"shear_at_lip_offset_N_m", hold.peel.lever_N_m},
              {"joint_bent_deg", hold.peel.bent_deg}}}};
}

WhyJson json_of(const Change& change) {
    return {{"key", change.key},
            {"unit", change.unit},
            {"from", change.from},
            {"to", change.to},
            {"set", change.override_text()}};
}

WhyJson json_of(const Trial& trial) {
    WhyJson changes = WhyJson::array(), holds = WhyJson::array();
    for (const Change& change : trial.changes) {
        changes.push_back(json_of(change));
    }
    for (const Hold& hold : trial.holds) {
        holds.push_back(json_of(hold));
    }
    const simulation::FlightResult& result = trial.result;
    return {{"changes", changes},
            {"outcome", to_string(result.outcome)},
            {"reason", result.reason},
            {"true_end", to_string(result.true_end)},
            {"success", is_success(result.outcome, result.true_end)},
            {"stage", to_string(trial.stage)},
            {"share", trial.share},
            {"margin_min_N", result.metrics.cup_margin_min_N},
            {"holds", holds}};
}

WhyJson json_of(const std::vector<HelpfulKey>& keys) {
    WhyJson list = WhyJson::array();
    for (const HelpfulKey& key : keys) {
        WhyJson entry = json_of(key.change);
        entry["in_remedy"] = key.in_remedy;
        entry["alone"] = json_of(key.alone);
        list.push_back(entry);
    }
    return list;
}

}  // namespace

std::string why_json(const Found& found) {
    WhyJson others = WhyJson::array();
    for (const Trial& other : found.others) {
        others.push_back(json_of(other));
    }
    const bool any = !found.remedy.changes.empty();
    return WhyJson{
        {"scenario", found.scenario},
        {"seed", found.seed},
        {"flight", json_of(found.base)},
        {"goal", to_string(found.goal)},
        {"mended", found.mended},
        {"remedy", any ? json_of(found.remedy) : WhyJson(nullptr)},
        {"and_then", found.and_then.changes.empty() ? WhyJson(nullptr) : json_of(found.and_then)},
        {"others", others},
        {"keys", json_of(found.keys)},
        {"parts", json_of(found.parts)},
        {"faults", found.faults},
        {"flights", found.flights},
        {"wall_s", found.wall_s}}
        .dump(2);
}

}  // namespace limpet::why
