// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace limpet {

/// One experiment, read and checked: what flies, against what, with which numbers. Immutable, cheap
/// to copy.
class Scenario {
public:
    [[nodiscard]] const std::string& name() const;
    [[nodiscard]] const std::string& description() const;
    [[nodiscard]] std::uint64_t seed() const;
    /// The text with every change applied: flies the same again.
    [[nodiscard]] const std::string& yaml() const;
    /// The same with more keys changed.
    /// @throws InputError as load()
    [[nodiscard]] Scenario with(const std::vector<std::string>& changes) const;

    struct Inside;

private:
    friend class Flight;
    friend Scenario load(const std::string& wanted, const std::vector<std::string>& changes);
    explicit Scenario(std::shared_ptr<const Inside> inside);
    std::shared_ptr<const Inside> inside_;
};

/// @param wanted   a name (`limpet list scenarios`) or the path of a YAML file
/// @param changes  "key=value" in that order, as `--set` takes them: guidance.dock_speed_m_s=0.8,
///                 wall.surface=metal, seed=7; `limpet params` lists the keys
/// @throws InputError one line: file:line, key, value, what is allowed
[[nodiscard]] Scenario load(const std::string& wanted,
                            const std::vector<std::string>& changes = {});

/// Names of all scenarios that are installed.
[[nodiscard]] std::vector<std::string> scenario_names();

}  // namespace limpet
