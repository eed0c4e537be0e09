// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/stand_in_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace limpet {
namespace {

using P = StandInParameters;

template <double P::*member>
double& at(P& parameters) {
    return parameters.*member;
}

/// PX4's integers that are no counts here. Source: PX4 v1.15, parameter types
constexpr std::array<std::string_view, 4> kIntegers = {"EKF2_NOAID_TOUT", "EKF2_PREDICT_US",
                                                       "FD_FAIL_P", "FD_FAIL_R"};

/// A row of either table.
struct Entry {
    const Parameter<StandInParameters>* commander = nullptr;
    const Parameter<AutopilotParameters>* autopilot = nullptr;

    [[nodiscard]] std::string_view name() const {
        return commander != nullptr ? commander->name : autopilot->name;
    }
    [[nodiscard]] std::string_view unit() const {
        return commander != nullptr ? commander->unit : autopilot->unit;
    }
    [[nodiscard]] bool allows(double value) const {
        return commander != nullptr ? value >= commander->minimum && value <= commander->maximum
                                    : value >= autopilot->minimum && value <= autopilot->maximum;
    }
    [[nodiscard]] double& field(const WireParameters& all) const {
        return commander != nullptr ? commander->field(all.commander)
                                    : autopilot->field(all.autopilot);
    }
    [[nodiscard]] bool is_integer() const {
        return unit() == "count" ||
               std::find(kIntegers.begin(), kIntegers.end(), name()) != kIntegers.end();
    }
};

/// By name, as PX4 numbers them; the earth's field is no parameter of PX4.
const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = [] {
        std::vector<Entry> list;
        for (const auto& row : stand_in_table()) {
            list.push_back({.commander = &row});
        }
        for (const auto& row : autopilot_table()) {
            if (row.name.front() >= 'A' && row.name.front() <= 'Z') {
                list.push_back({.autopilot = &row});
            }
        }
        std::sort(list.begin(), list.end(),
                  [](const Entry& a, const Entry& b) { return a.name() < b.name(); });
        return list;
    }();
    return all;
}

}  // namespace

const ParameterTable<StandInParameters>& stand_in_table() {
    static const ParameterTable<StandInParameters> table = {
        {"FD_FAIL_P", "deg", 0, 180, at<&P::FD_FAIL_P>,
         "no arming when pitched further than this, 0: whatever the pitch", "PX4, px4.md"},
        {"FD_FAIL_R", "deg", 0, 180, at<&P::FD_FAIL_R>,
         "no arming when rolled further than this, 0: whatever the roll", "PX4, px4.md"},
        {"COM_OF_LOSS_T", "s", 0, 60, at<&P::COM_OF_LOSS_T>,
         "set-points older than this end offboard control", "PX4, px4.md"},
        {"COM_DISARM_PRFLT", "s", -1, 60, at<&P::COM_DISARM_PRFLT>,
         "armed without thrust so long: disarms, <= 0: never", "PX4, px4.md"},
        {"COM_DISARM_LAND", "s", -1, 20, at<&P::COM_DISARM_LAND>,
         "landed so long: disarms, <= 0: never", "PX4"},
    };
    return table;
}

std::uint16_t wire_parameter_count() {
    return static_cast<std::uint16_t>(entries().size());
}

std::optional<WireParameter> wire_parameter(const WireParameters& all, std::uint16_t index) {
    if (index >= entries().size()) {
        return std::nullopt;
    }
    const Entry& entry = entries()[index];
    return WireParameter{.name = entry.name(),
                         .value = entry.field(all),
                         .is_integer = entry.is_integer(),
                         .index = index};
}

std::optional<WireParameter> wire_parameter(const WireParameters& all, std::string_view name) {
    for (std::uint16_t i = 0; i < wire_parameter_count(); ++i) {
        if (entries()[i].name() == name) {
            return wire_parameter(all, i);
        }
    }
    return std::nullopt;
}

bool set_wire_parameter(const WireParameters& all, std::string_view name, double value) {
    for (const Entry& entry : entries()) {
        if (entry.name() == name && std::isfinite(value) && entry.allows(value) &&
            (!entry.is_integer() || std::trunc(value) == value)) {
            entry.field(all) = value;
            return true;
        }
    }
    return false;
}

}  // namespace limpet
