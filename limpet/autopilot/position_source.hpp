// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace limpet::autopilot {

/// What tells the estimator where it is: one name for the parameters of PX4 that say so.
struct PositionSource {
    struct Setting {
        std::string_view parameter;
        int value = 0;
    };
    std::string_view name;  ///< `autopilot.aiding`
    std::string_view description;
    std::array<Setting, 4> settings = {};
};

inline constexpr PositionSource kMotionCaptureAiding = {
    .name = "motion_capture",
    .description = "a motion capture system's pose: indoors",
    .settings = {
        {{"EKF2_EV_CTRL", 15}, {"EKF2_GPS_CTRL", 0}, {"EKF2_BARO_CTRL", 0}, {"EKF2_MAG_TYPE", 5}}}};
inline constexpr PositionSource kGpsAiding = {
    .name = "gps",
    .description = "GPS, barometer and magnetometer: outdoors",
    .settings = {
        {{"EKF2_EV_CTRL", 0}, {"EKF2_GPS_CTRL", 7}, {"EKF2_BARO_CTRL", 1}, {"EKF2_MAG_TYPE", 0}}}};

/// The first is the default.
[[nodiscard]] inline std::span<const PositionSource* const> position_sources() {
    static constexpr std::array kSources = {&kMotionCaptureAiding, &kGpsAiding};
    return kSources;
}

/// @return what a source sets a parameter to; nothing for the others
[[nodiscard]] constexpr std::optional<double> setting_of(const PositionSource& source,
                                                         std::string_view parameter) {
    for (const PositionSource::Setting& setting : source.settings) {
        if (setting.parameter == parameter) {
            return setting.value;
        }
    }
    return std::nullopt;
}

}  // namespace limpet::autopilot
