// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in_parameters.hpp"

#include <algorithm>
#include <vector>

namespace limpet::px4 {
namespace {

/// Rows of both tables by name, as PX4 numbers them; the earth's field is no parameter of PX4.
std::vector<BoundParameter> rows_of(const WireParameters& all) {
    std::vector<BoundParameter> rows = bind(stand_in_table(), all.commander);
    for (const BoundParameter& row : bind(autopilot::autopilot_table(), all.autopilot)) {
        if (row.name.front() >= 'A' && row.name.front() <= 'Z') {
            rows.push_back(row);
        }
    }
    std::sort(rows.begin(), rows.end(),
              [](const BoundParameter& a, const BoundParameter& b) { return a.name < b.name; });
    return rows;
}

}  // namespace

const ParameterTable<StandInParameters>& stand_in_table() {
    using P = StandInParameters;
    static const ParameterTable<P> table = {
        {"FD_FAIL_P", "deg", 0, 180, &P::FD_FAIL_P,
         "no arming when pitched further than this, 0: whatever the pitch", "PX4, px4.md"},
        {"FD_FAIL_R", "deg", 0, 180, &P::FD_FAIL_R,
         "no arming when rolled further than this, 0: whatever the roll", "PX4, px4.md"},
        {"COM_OF_LOSS_T", "s", 0, 60, &P::COM_OF_LOSS_T,
         "set-points older than this end offboard control", "PX4, px4.md"},
        {"COM_DISARM_PRFLT", "s", -1, 60, &P::COM_DISARM_PRFLT,
         "armed without thrust so long: disarms, <= 0: never", "PX4, px4.md"},
        {"COM_DISARM_LAND", "s", -1, 20, &P::COM_DISARM_LAND,
         "landed so long: disarms, <= 0: never", "PX4"},
    };
    return table;
}

std::uint16_t wire_parameter_count() {
    StandInParameters commander;
    autopilot::AutopilotParameters autopilot;
    return static_cast<std::uint16_t>(rows_of({commander, autopilot}).size());
}

std::optional<WireParameter> wire_parameter(const WireParameters& all, std::uint16_t index) {
    const std::vector<BoundParameter> rows = rows_of(all);
    if (index >= rows.size()) {
        return std::nullopt;
    }
    const BoundParameter& row = rows[index];
    return WireParameter{.name = row.name,
                         .value = row.value.get(),
                         .is_integer = row.value.is_whole(),
                         .index = index};
}

std::optional<WireParameter> wire_parameter(const WireParameters& all, std::string_view name) {
    const std::vector<BoundParameter> rows = rows_of(all);
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const BoundParameter& r) { return r.name == name; });
    return wire_parameter(all, static_cast<std::uint16_t>(row - rows.begin()));
}

bool set_wire_parameter(const WireParameters& all, std::string_view name, double value) {
    for (const BoundParameter& row : rows_of(all)) {
        if (row.name == name && row.allows(value)) {
            row.value.set(value);
            return true;
        }
    }
    return false;
}

}  // namespace limpet::px4
