// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/message_definitions.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/record/schema.hpp"

namespace limpet::record {
namespace {

constexpr std::array<MessageDefinition, 21> kDefinitions = {{
    {"builtin_interfaces/msg/Time", R"(int32 sec
uint32 nanosec
)"},
    {"std_msgs/msg/Header", R"(builtin_interfaces/Time stamp
string frame_id
)"},
    {"geometry_msgs/msg/Vector3", R"(float64 x
float64 y
float64 z
)"},
    {"geometry_msgs/msg/Point", R"(float64 x
float64 y
float64 z
)"},
    {"geometry_msgs/msg/Quaternion", R"(float64 x 0
float64 y 0
float64 z 0
float64 w 1
)"},
    {"geometry_msgs/msg/Pose", R"(geometry_msgs/Point position
geometry_msgs/Quaternion orientation
)"},
    {"geometry_msgs/msg/PoseStamped", R"(std_msgs/Header header
geometry_msgs/Pose pose
)"},
    {"geometry_msgs/msg/Twist", R"(geometry_msgs/Vector3 linear
geometry_msgs/Vector3 angular
)"},
    {"geometry_msgs/msg/TwistStamped", R"(std_msgs/Header header
geometry_msgs/Twist twist
)"},
    {"geometry_msgs/msg/Wrench", R"(geometry_msgs/Vector3 force
geometry_msgs/Vector3 torque
)"},
    {"geometry_msgs/msg/WrenchStamped", R"(std_msgs/Header header
geometry_msgs/Wrench wrench
)"},
    {"sensor_msgs/msg/Imu", R"(std_msgs/Header header
geometry_msgs/Quaternion orientation
float64[9] orientation_covariance
geometry_msgs/Vector3 angular_velocity
float64[9] angular_velocity_covariance
geometry_msgs/Vector3 linear_acceleration
float64[9] linear_acceleration_covariance
)"},
    {"sensor_msgs/msg/Range", R"(std_msgs/Header header
uint8 ULTRASOUND=0
uint8 INFRARED=1
uint8 radiation_type
float32 field_of_view
float32 min_range
float32 max_range
float32 range
float32 variance
)"},
    {"sensor_msgs/msg/FluidPressure", R"(std_msgs/Header header
float64 fluid_pressure
float64 variance
)"},
    {"sensor_msgs/msg/BatteryState", R"(uint8 POWER_SUPPLY_STATUS_UNKNOWN=0
uint8 POWER_SUPPLY_STATUS_DISCHARGING=2
uint8 POWER_SUPPLY_HEALTH_UNKNOWN=0
uint8 POWER_SUPPLY_TECHNOLOGY_LIPO=3
std_msgs/Header header
float32 voltage
float32 temperature
float32 current
float32 charge
float32 capacity
float32 design_capacity
float32 percentage
uint8 power_supply_status
uint8 power_supply_health
uint8 power_supply_technology
bool present
float32[] cell_voltage
float32[] cell_temperature
string location
string serial_number
)"},
    {"limpet_msgs/msg/VehicleTruth",
     R"(# What is really so and no standard message carries. World: north-east-down, body: forward-right-down.
builtin_interfaces/Time stamp
float64 roll_rad
float64 pitch_rad
float64 yaw_rad
float64 velocity_north_m_s
float64 velocity_east_m_s
float64 velocity_down_m_s
float64 rate_forward_rad_s
float64 rate_right_rad_s
float64 rate_down_rad_s
float64 slider_position_m       # 0 at the outer stop, < 0 compressed
float64 slider_velocity_m_s     # > 0 extends
float64 slider_force_n          # on the cup's side, < 0 when pressed
float64 cup_pitch_rad           # of the cup on its joint: pitch first, then yaw
float64 cup_yaw_rad
float64 legs_force_north_n      # by the wall on the legs
float64 legs_force_east_n
float64 legs_force_down_n
float64[4] rotor_speed_rad_s    # front right, rear left, front left, rear right
float64 thrust_n                # sum of the rotors
float64 battery_voltage_v
float64 battery_current_a
float64 battery_energy_used_j
float64 battery_remaining       # 0..1
)"},
    {"limpet_msgs/msg/CupState",
     R"(# True state of the suction cup. Its wrench is on /truth/cup_wrench.
uint8 FREE=0
uint8 TOUCHING=1
uint8 SEALING=2
uint8 ATTACHED=3
uint8 UNSEALING=4
builtin_interfaces/Time stamp
uint8 phase
bool pump_running
bool valve_open
float64 pressure_pa             # absolute
float64 pull_n                  # away from the wall, < 0 presses
float64 shear_n                 # along the wall
float64 peel_n_m                # tilting moment at the lip
float64 gap_m                   # lip plane to wall, < 0 when compressed
float64 pull_margin_n           # to spare before it lets go
float64 shear_margin_n
float64 peel_margin_n           # as a force at the lip's lever arm
float64 seal_threshold_n        # press force that seals this touch
)"},
    {"limpet_msgs/msg/Setpoint",
     R"(# What guidance asks for. World: north-east-down. What the mode does not use is NaN.
uint8 IDLE=0
uint8 POSITION=1
uint8 VELOCITY=2
uint8 ATTITUDE=3
builtin_interfaces/Time stamp
uint8 mode
bool armed
bool pump_on
bool valve_open
bool hold_integrators
float64 position_north_m
float64 position_east_m
float64 position_down_m
float64 velocity_north_m_s      # mode VELOCITY; in mode POSITION the feed-forward
float64 velocity_east_m_s
float64 velocity_down_m_s
float64 acceleration_north_m_s2 # feed-forward of mode VELOCITY
float64 acceleration_east_m_s2
float64 acceleration_down_m_s2
float64 roll_rad                # mode ATTITUDE
float64 pitch_rad
float64 yaw_rad                 # every mode but IDLE
float64 thrust                  # collective, 0..1 of the motor command; mode ATTITUDE
)"},
    {"limpet_msgs/msg/GuidanceState", R"(builtin_interfaces/Time stamp
string state
int32 attempt
)"},
    {"limpet_msgs/msg/RotorCommand", R"(builtin_interfaces/Time stamp
float64[4] command              # 0..1: front right, rear left, front left, rear right
bool armed
)"},
    {"limpet_msgs/msg/Event", R"(builtin_interfaces/Time stamp
string station
string name
string reason                   # may be empty
string[] value_names            # names carry units
float64[] values                # as many as names
)"},
}};

void collect(std::string_view type, std::vector<const MessageDefinition*>& found) {
    const auto definition = std::find_if(kDefinitions.begin(), kDefinitions.end(),
                                         [type](const auto& d) { return d.type == type; });
    require(definition != kDefinitions.end(), "every message type used has a definition");
    if (std::find(found.begin(), found.end(), &*definition) != found.end()) {
        return;
    }
    found.push_back(&*definition);
    const MessageType parsed = parse_message_type(std::string(type), std::string(definition->text));
    for (const Field& field : parsed.fields) {
        if (!field.nested_type.empty()) {
            collect(field.nested_type, found);
        }
    }
}

/// Of what another message depends on.
std::string part_of(const MessageDefinition& definition) {
    return std::string(80, '=') + "\nMSG: " + short_type_name(definition.type) + "\n" +
           std::string(definition.text);
}

}  // namespace

std::span<const MessageDefinition> message_definitions() {
    return kDefinitions;
}

std::string ros2msg_schema(std::string_view type) {
    std::vector<const MessageDefinition*> parts;
    collect(type, parts);
    std::string text(parts.front()->text);
    for (std::size_t i = 1; i < parts.size(); ++i) {
        text += part_of(*parts[i]);
    }
    return text;
}

std::string column_schema(std::span<const std::string_view> columns) {
    std::string text = "builtin_interfaces/Time stamp\n";
    for (const std::string_view column : columns) {
        text += "float64 ";
        std::transform(column.begin(), column.end(), std::back_inserter(text),
                       [](unsigned char c) { return std::tolower(c); });
        text += "\n";
    }
    return text + part_of(kDefinitions.front());
}

}  // namespace limpet::record
