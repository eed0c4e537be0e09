// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/px4_setup.hpp"

#include <limits>

#include "limpet/scenario/derived.hpp"

namespace limpet::simulation {

px4::Px4Airframe px4_airframe(const scenario::Scenario& scenario, std::optional<int> id) {
    const vehicle::Airframe& vehicle = scenario.airframe;
    px4::Px4Airframe airframe;
    airframe.name = vehicle.name;
    airframe.id = id.value_or(px4::px4_airframe_id(vehicle.name));
    airframe.rotors = scenario::rotor_geometry(vehicle);
    airframe.battery_cells = vehicle.battery.cells;
    airframe.battery_capacity_Ah = vehicle.battery.capacity_Ah;
    airframe.perches = vehicle.has_cup;
    airframe.autopilot = scenario.autopilot;
    airframe.imu_rate_Hz = scenario.sensors.imu_rate_Hz;
    airframe.pose =
        scenario.autopilot.EKF2_EV_CTRL != 0 ? px4::Px4Pose::motion_capture : px4::Px4Pose::gps;
    return airframe;
}

px4::Px4Addresses px4_addresses(const scenario::Scenario& scenario,
                                const px4::Px4Instance& instance) {
    const bool gps = scenario.autopilot.EKF2_GPS_CTRL != 0;
    px4::Px4Addresses addresses;
    addresses.hil = instance.hil();
    addresses.offboard = instance.offboard();
    addresses.system = instance.system();
    addresses.sets_origin = !gps;
    addresses.aiding_limit_s =
        gps ? std::numeric_limits<double>::infinity() : 1e-6 * scenario.autopilot.EKF2_NOAID_TOUT;
    return addresses;
}

}  // namespace limpet::simulation
