// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/plant_cache.hpp"

#include <algorithm>

namespace limpet::campaign {

std::shared_ptr<const plant::PlantModel> PlantCache::get(const scenario::Scenario& scenario) {
    const models::Scene scene = scene_of(scenario);
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(plants_.begin(), plants_.end(), [&](const Entry& entry) {
        return entry.engine == scenario.engine && entry.scene == scene &&
               entry.airframe == scenario.airframe;
    });
    if (found != plants_.end()) {
        return found->plant;
    }
    if (plants_.size() >= kMost) {
        plants_.clear();
    }
    plants_.push_back({scenario.engine, scenario.airframe, scene,
                       scenario.engine->make(scenario.airframe, scene)});
    return plants_.back().plant;
}

}  // namespace limpet::campaign
