// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limpet/scenario/scenario.hpp"
#include "limpet/scenario/yaml_tree.hpp"

namespace limpet::scenario {

struct LoadOptions {
    /// "key.path=value", applied in order before anything is checked: guidance.hold_s=0.6,
    /// vehicle.slider.stiffness_N_m=400, wall.surface=metal, wall.surface.friction=0.5.
    std::vector<std::string> overrides{};
    std::optional<std::uint64_t> seed{};  ///< after the overrides
    std::filesystem::path data_root{};    ///< empty: scenario::data_root()
    /// Where the overrides were written: their relative paths count from here first, then from the
    /// scenario's folder. Empty: the working folder.
    std::filesystem::path folder{};
};

/// Reads, overrides, derives and checks one experiment. A scenario's keys are described in
/// data/scenarios/README.md.
/// @param wanted  path of a file, or a name in scenarios/ of the data
/// @throws InputError one line: file:line (or --set), key, value, what is allowed
[[nodiscard]] Scenario load_scenario(const std::string& wanted, const LoadOptions& options = {});

/// The same of a text, such as Scenario::yaml out of a recording.
/// @param name  of the scenario, and of the text in messages
[[nodiscard]] Scenario load_scenario_text(const std::string& text, const std::string& name,
                                          const LoadOptions& options = {});

/// @param text   "[[1, 0.6], [2, 0.8]]", as noise_text() writes it
/// @param place  of it in messages
/// @throws InputError when it is no noise
[[nodiscard]] NoiseBlend noise_from(const std::string& text, const std::string& place);

/// Such a text, read once, of which scenarios are made with many overrides.
class ScenarioText {
public:
    /// @throws InputError when it is not YAML
    ScenarioText(std::string yaml, std::string name);
    [[nodiscard]] const std::string& yaml() const { return yaml_; }
    friend bool operator==(const ScenarioText& a, const ScenarioText& b) {
        return a.yaml_ == b.yaml_;
    }
    /// As load_scenario_text().
    [[nodiscard]] Scenario load(const LoadOptions& options) const;

private:
    std::string yaml_;
    std::string name_;
    std::shared_ptr<const YamlNode> tree_;
};

/// What no single row of a table can say: values that must fit each other.
/// @param root  the text with its overrides, for the place in the message
/// @throws InputError for the first that does not fit
void check(const Scenario& scenario, const YamlNode& root);

}  // namespace limpet::scenario
