// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace limpet::record {

/// Name of a column as Limpet writes it. ROS 2 allows lower-case field names only, so our
/// messages say `pressure_pa`; the column is `pressure_Pa`. Names of other packages stay as they
/// are.
/// @param type   "limpet_msgs/msg/CupState"
/// @param field  flattened, an index in brackets allowed: "rotor_speed_rad_s[0]"
[[nodiscard]] std::string column_name(std::string_view type, std::string_view field);

/// The same with the unit of a ROS field, whose name has none: for files that are read without a
/// schema. "pose.position.x" -> "pose.position.x_m".
/// Source: REP 103 and the comments of ROS's .msg files.
[[nodiscard]] std::string column_name_with_unit(std::string_view type, std::string_view column);

}  // namespace limpet::record
