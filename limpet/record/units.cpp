// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/units.hpp"

#include <array>
#include <utility>

namespace limpet::record {
namespace {

/// Longer suffixes first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kCapitals = {{
    {"_degc", "_degC"},
    {"_n_m", "_N_m"},
    {"_pa", "_Pa"},
    {"_n", "_N"},
    {"_v", "_V"},
    {"_a", "_A"},
    {"_j", "_J"},
}};

struct RosUnit {
    std::string_view type;
    std::string_view field;  ///< a whole column, or its beginning if it ends in '.' or '['
    std::string_view unit;
};

constexpr std::array<RosUnit, 26> kRosUnits = {{
    {"", "header.stamp", "s"},
    {"", "stamp", "s"},
    {"geometry_msgs/msg/PoseStamped", "pose.position.", "m"},
    {"geometry_msgs/msg/TwistStamped", "twist.linear.", "m_s"},
    {"geometry_msgs/msg/TwistStamped", "twist.angular.", "rad_s"},
    {"geometry_msgs/msg/WrenchStamped", "wrench.force.", "N"},
    {"geometry_msgs/msg/WrenchStamped", "wrench.torque.", "N_m"},
    {"sensor_msgs/msg/BatteryState", "voltage", "V"},
    {"sensor_msgs/msg/BatteryState", "temperature", "degC"},
    {"sensor_msgs/msg/BatteryState", "current", "A"},
    {"sensor_msgs/msg/BatteryState", "charge", "Ah"},
    {"sensor_msgs/msg/BatteryState", "capacity", "Ah"},
    {"sensor_msgs/msg/BatteryState", "design_capacity", "Ah"},
    {"sensor_msgs/msg/FluidPressure", "fluid_pressure", "Pa"},
    {"sensor_msgs/msg/FluidPressure", "variance", "Pa2"},
    {"sensor_msgs/msg/Imu", "angular_velocity.", "rad_s"},
    {"sensor_msgs/msg/Imu", "angular_velocity_covariance[", "rad2_s2"},
    {"sensor_msgs/msg/Imu", "linear_acceleration.", "m_s2"},
    {"sensor_msgs/msg/Imu", "linear_acceleration_covariance[", "m2_s4"},
    {"sensor_msgs/msg/MagneticField", "magnetic_field.", "T"},
    {"sensor_msgs/msg/MagneticField", "magnetic_field_covariance[", "T2"},
    {"sensor_msgs/msg/Range", "field_of_view", "rad"},
    {"sensor_msgs/msg/Range", "min_range", "m"},
    {"sensor_msgs/msg/Range", "max_range", "m"},
    {"sensor_msgs/msg/Range", "range", "m"},
    {"sensor_msgs/msg/Range", "variance", "m2"},
}};

bool covers(const RosUnit& row, std::string_view type, std::string_view column) {
    const bool of_type = row.type.empty() || row.type == type;
    const bool prefix = row.field.back() == '.' || row.field.back() == '[';
    return of_type &&
           (prefix ? column.substr(0, row.field.size()) == row.field : column == row.field);
}

}  // namespace

std::string column_name(std::string_view type, std::string_view field) {
    const bool ours = type.substr(0, type.find('/')) == "limpet_msgs";
    const std::string_view name = field.substr(0, field.find('['));
    if (ours) {
        for (const auto& [lower, unit] : kCapitals) {
            const bool ends =
                name.size() > lower.size() && name.substr(name.size() - lower.size()) == lower;
            if (ends) {
                return std::string(name.substr(0, name.size() - lower.size()))
                    .append(unit)
                    .append(field.substr(name.size()));
            }
        }
    }
    return std::string(field);
}

std::string column_name_with_unit(std::string_view type, std::string_view column) {
    for (const RosUnit& row : kRosUnits) {
        if (covers(row, type, column)) {
            return std::string(column).append("_").append(row.unit);
        }
    }
    return std::string(column);
}

}  // namespace limpet::record
