// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in_parameters.hpp"

#include <algorithm>

namespace limpet::px4 {
const ParameterTable<StandInParameters>& stand_in_table() {
    using P = StandInParameters;
    static const ParameterTable<P> table = {
        {"FD_FAIL_P", "deg", 0, 180, &P::FD_FAIL_P,
         "no arming when pitched further than this, 0: whatever the pitch",
         "PX4, docs/reference/px4.md"},
        {"FD_FAIL_R", "deg", 0, 180, &P::FD_FAIL_R,
         "no arming when rolled further than this, 0: whatever the roll",
         "PX4, docs/reference/px4.md"},
        {"COM_OF_LOSS_T", "s", 0, 60, &P::COM_OF_LOSS_T,
         "set-points older than this end offboard control", "PX4, docs/reference/px4.md"},
        {"COM_DISARM_PRFLT", "s", -1, 60, &P::COM_DISARM_PRFLT,
         "armed without thrust so long: disarms, <= 0: never", "PX4, docs/reference/px4.md"},
        {"COM_DISARM_LAND", "s", -1, 20, &P::COM_DISARM_LAND,
         "landed so long: disarms, <= 0: never", "PX4"},
    };
    return table;
}

std::vector<BoundParameter> wire_parameters(StandInParameters& commander,
                                            autopilot::AutopilotParameters& autopilot) {
    std::vector<BoundParameter> rows = bind(stand_in_table(), commander);
    for (const BoundParameter& row : bind(autopilot::autopilot_table(), autopilot)) {
        if (row.name.front() >= 'A' && row.name.front() <= 'Z') {  // the earth's field is not PX4's
            rows.push_back(row);
        }
    }
    std::sort(rows.begin(), rows.end(),
              [](const BoundParameter& a, const BoundParameter& b) { return a.name < b.name; });
    return rows;
}

}  // namespace limpet::px4
