// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "limpet/scenario/scenario.hpp"

namespace limpet::campaign {

/// Plants by what they are made of, shared by all workers: a campaign that varies neither vehicle
/// nor wall compiles once. Few are kept, so that one that varies a mass does not keep a plant a
/// run.
class PlantCache {
public:
    [[nodiscard]] std::shared_ptr<const plant::PlantModel> get(const scenario::Scenario& scenario);

private:
    struct Entry {
        const plant::Engine* engine;
        vehicle::Airframe airframe;
        models::Scene scene;
        std::shared_ptr<const plant::PlantModel> plant;
    };
    static constexpr std::size_t kMost = 32;
    std::mutex mutex_;  ///< also over MuJoCo's compiler, which keeps globals
    std::vector<Entry> plants_;
};

}  // namespace limpet::campaign
