// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario.hpp"

#include <utility>

#include "limpet/face/inside.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/version.hpp"

namespace limpet {

std::string_view library_version() {
    return kVersion;
}

Scenario::Scenario(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}

const std::string& Scenario::name() const {
    return inside_->scenario.name;
}
const std::string& Scenario::description() const {
    return inside_->scenario.description;
}
std::uint64_t Scenario::seed() const {
    return inside_->scenario.seed;
}
const std::string& Scenario::yaml() const {
    return inside_->yaml;
}

Scenario Scenario::with(const std::vector<std::string>& changes) const {
    std::vector<std::string> all = inside_->changes;
    all.insert(all.end(), changes.begin(), changes.end());
    return load(inside_->wanted, all);
}

Scenario load(const std::string& wanted, const std::vector<std::string>& changes) {
    InnerScenario loaded = scenario::load_scenario(wanted, {.overrides = changes});
    std::string yaml = to_yaml(loaded);
    return Scenario(
        std::make_shared<const Scenario::Inside>(Scenario::Inside{.scenario = std::move(loaded),
                                                                  .yaml = std::move(yaml),
                                                                  .wanted = wanted,
                                                                  .changes = changes}));
}

std::vector<std::string> scenario_names() {
    return scenario::names_in(scenario::data_root() / "scenarios");
}

}  // namespace limpet
