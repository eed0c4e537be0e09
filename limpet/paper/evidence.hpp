// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "limpet/core/frames.hpp"

namespace limpet::paper {

/// What was measured on the simulation, under names that claims refer to: "perch_metal.release_s",
/// "press_metal.tau_1_s". NaN: it was looked for and did not come to pass.
class Evidence {
public:
    void set(const std::string& name, double value) { values_[name] = value; }
    /// @return NaN where nothing was measured under this name
    [[nodiscard]] double get(const std::string& name) const {
        const auto found = values_.find(name);
        return found == values_.end() ? kNaN : found->second;
    }
    [[nodiscard]] bool has(const std::string& name) const { return values_.count(name) > 0; }
    [[nodiscard]] const std::map<std::string, double>& all() const { return values_; }

private:
    std::map<std::string, double> values_;
};

}  // namespace limpet::paper
