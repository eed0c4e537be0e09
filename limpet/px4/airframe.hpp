// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limpet/autopilot/allocation.hpp"
#include "limpet/autopilot/parameters.hpp"
#include "limpet/mavlink/messages.hpp"
#include "limpet/mavlink/parameter_check.hpp"
#include "limpet/px4/facts.hpp"

namespace limpet::px4 {

/// Where the PX4 runs that is to be set up.
enum class Px4Target {
    sitl,    ///< on this machine, in lockstep with the simulator
    hitl,    ///< on a board, the simulator on its USB port
    flight,  ///< on the vehicle itself: its checks, its remote control and its outputs stay
};

/// Where its position comes from.
enum class Px4Pose {
    motion_capture,
    gps
};

struct Px4Airframe {
    std::string name;  ///< of the vehicle; other characters than a-z, A-Z, 0-9, _, - become _
    int id = 22001;    ///< SYS_AUTOSTART, 22000..22999; px4_airframe_id
    RotorList<autopilot::RotorGeometry> rotors;
    double battery_cells = 6.0;
    double battery_capacity_Ah = 4.0;
    bool perches = true;         ///< has a cup
    double imu_rate_Hz = 250.0;  ///< of HIL_SENSOR
    autopilot::AutopilotParameters autopilot;
    Px4Target target = Px4Target::sitl;
    Px4Pose pose = Px4Pose::motion_capture;
    Px4Version version = Px4Version::released;
};

/// One parameter as this vehicle needs it.
struct Px4Setting {
    std::string name;
    Px4Type type = Px4Type::real32;
    double value = 0.0;
    std::string reason;
    bool fixed = false;  ///< `param set`, not `set-default`: a user's own value must not win
};

/// PX4 keeps 22000..22999 for a user's own models. PX4 takes the last script of a number: a vehicle
/// has one of its own, the same for ever. Shipped vehicles 22001.., others by their name.
[[nodiscard]] int px4_airframe_id(std::string_view vehicle);
/// The shipped vehicle of a number; empty: none has it.
[[nodiscard]] std::string_view px4_airframe_vehicle(int id);
inline constexpr int kFirstOwnAirframe = 22000;  // init.d-posix/airframes/CMakeLists.txt
inline constexpr int kLastOwnAirframe = 22999;

/// What the number and places of its rotors make of it.
struct Px4Frame {
    const char* says;  ///< "a hexarotor"
    const char* type;  ///< PX4's, of an airframe: "Hexarotor x"
};
[[nodiscard]] Px4Frame px4_frame(const Px4Airframe& airframe);

/// What a PX4 of airframe.version must be set to, in the order in which a person reads it. Of the
/// built-in autopilot's parameters only control's (MPC_, MC_, IMU_) go over, where they differ from
/// PX4's defaults: its estimator has EKF2's names, but is another filter.
/// @throws InputError naming a parameter that is out of PX4's range, and an id that is not
///         22000..22999
[[nodiscard]] std::vector<Px4Setting> px4_settings(const Px4Airframe& airframe);

/// Settings that a PX4 has no parameter for: what became of them stands in docs/px4.md.
struct Px4Fitted {
    std::vector<Px4Setting> settings;
    std::vector<std::string> left_out;  ///< names
};
/// To a PX4 that was built.
/// @throws InputError naming a parameter whose value is out of that PX4's range
[[nodiscard]] Px4Fitted fitted(const std::vector<Px4Setting>& settings, const Px4Facts& known);

/// What guidance needs of any vehicle's PX4 as long as it perches on walls: of its failure
/// detector, its arming and its offboard control.
[[nodiscard]] std::vector<Px4Setting> px4_needs();

/// What a PX4 is compared with before it is armed.
[[nodiscard]] std::vector<mavlink::ExpectedParameter> expected_parameters(
    const std::vector<Px4Setting>& settings);
/// The same of an airframe.
/// @param left_out  that this PX4 has no more
/// @return nothing where PX4 does not take one of its values: the stand-in may fly it
[[nodiscard]] std::vector<mavlink::ExpectedParameter> expected_parameters(
    const Px4Airframe& airframe, const std::vector<std::string>& left_out = {});

/// A parameter file for QGroundControl: tab-separated lines
/// `vehicle component name value type`; each has its reason in a comment above it.
[[nodiscard]] std::string px4_params_text(const Px4Airframe& airframe,
                                          const std::vector<Px4Setting>& settings);

/// The start-up script of PX4 that sets the same.
[[nodiscard]] std::string px4_airframe_script(const Px4Airframe& airframe,
                                              const std::vector<Px4Setting>& settings);

/// What makes `make px4_sitl_default limpet_NAME` build a PX4 and launch it with its simulator.
[[nodiscard]] std::string px4_make_target(const Px4Airframe& airframe);
inline constexpr const char* kPx4MakeTarget = "sitl_targets_limpet.cmake";

/// `ID_limpet_NAME`: PX4 finds it by the number, by PX4_SIM_MODEL=limpet_NAME too.
[[nodiscard]] std::string px4_airframe_file_name(const Px4Airframe& airframe);

/// Where the script belongs in PX4's source tree.
[[nodiscard]] std::string px4_airframe_folder(Px4Target target);

}  // namespace limpet::px4
