// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "limpet/plant/mujoco_model.hpp"

namespace limpet {

/// Compiled plants by their text, shared by all workers: a campaign that varies neither vehicle nor
/// wall compiles once. Few are kept, so that one that varies a mass does not keep a plant a run.
class PlantCache {
public:
    [[nodiscard]] std::shared_ptr<const MujocoModel> get(const std::string& mjcf);

private:
    static constexpr std::size_t kMost = 32;
    std::mutex mutex_;  ///< also over MuJoCo's compiler, which keeps globals
    std::unordered_map<std::string, std::shared_ptr<const MujocoModel>> plants_;
};

}  // namespace limpet
