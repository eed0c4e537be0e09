// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gazebo/vehicle_options.hpp"
#include "limpet/autopilot/px4.hpp"
#include "limpet/mavlink/link.hpp"

namespace limpet {

/// A real PX4 on its wires, as `limpet fly --autopilot px4` has it: lockstep over TCP, or real time
/// over a serial port.
class Px4Wires {
public:
    /// Opens the wires and waits for a PX4.
    /// @param say  a line for people
    /// @throws InputError when a wire cannot be opened or nobody comes in time
    Px4Wires(const VehicleOptions& options, const std::function<void(const std::string&)>& say);

    [[nodiscard]] Px4Autopilot& autopilot() { return *autopilot_; }

private:
    std::unique_ptr<mavlink::Link> hil_;
    std::unique_ptr<mavlink::Link> offboard_;  ///< null: all over one wire
    std::unique_ptr<Px4Autopilot> autopilot_;
};

}  // namespace limpet
