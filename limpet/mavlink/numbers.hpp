// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "limpet/core/frames.hpp"

/// Our numbers as messages carry them.
namespace limpet::mavlink {

/// Whole numbers are rounded and held to what the wire can carry; what is no number is 0.
template <class T>
[[nodiscard]] T on_wire(double value) {
    if constexpr (std::is_floating_point_v<T>) {
        return static_cast<T>(value);
    } else {
        using Limits = std::numeric_limits<T>;
        return std::isnan(value) ? T{0}
                                 : static_cast<T>(std::clamp(std::round(value),
                                                             static_cast<double>(Limits::lowest()),
                                                             static_cast<double>(Limits::max())));
    }
}

/// A vector in three fields.
template <class T>
void put(const Vector3& from, T& x, T& y, T& z) {
    x = on_wire<T>(from.x());
    y = on_wire<T>(from.y());
    z = on_wire<T>(from.z());
}

/// [ms] since the flight's beginning
[[nodiscard]] inline std::uint32_t boot_ms(double time_s) {
    return on_wire<std::uint32_t>(1e3 * time_s);
}

/// [us] since the flight's beginning
[[nodiscard]] inline std::uint64_t boot_us(double time_s) {
    return on_wire<std::uint64_t>(1e6 * time_s);
}

/// @return a direction from north over east [0.01 deg], 0 .. 35999
[[nodiscard]] inline std::uint16_t centidegrees(double angle_rad) {
    const double angle_deg = degrees(angle_rad);
    return static_cast<std::uint16_t>(
        on_wire<std::uint16_t>(100.0 * (angle_deg < 0.0 ? angle_deg + 360.0 : angle_deg)) % 36000U);
}

}  // namespace limpet::mavlink
