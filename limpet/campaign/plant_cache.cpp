// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/plant_cache.hpp"

namespace limpet {

std::shared_ptr<const MujocoModel> PlantCache::get(const std::string& mjcf) {
    const std::lock_guard lock(mutex_);
    if (const auto found = plants_.find(mjcf); found != plants_.end()) {
        return found->second;
    }
    if (plants_.size() >= kMost) {
        plants_.clear();
    }
    return plants_[mjcf] = std::make_shared<const MujocoModel>(mjcf);
}

}  // namespace limpet
