// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "limpet/core/signals/readings.hpp"

/// Benewake TFmini Plus on a serial port, standard output: 115200 baud, 8N1, 9 bytes a frame,
/// 100 Hz unless set otherwise.
///
///   0x59 0x59 dist_L dist_H strength_L strength_H temp_L temp_H checksum
///
/// Distance in cm, temperature = temp / 8 - 256 degC, checksum = low byte of the sum of the eight
/// bytes before. Source: manual SJ-PM-TFmini Plus-T-01 A04, sections 5.2 to 5.4
namespace limpet::devices {

inline constexpr std::size_t kTfminiFrame_bytes = 9;
/// Below it, or at 65535 (saturated), the distance is unreliable. Source: manual, section 5.4
inline constexpr std::uint16_t kTfminiWeakest = 100;
/// Operating range. Source: manual, table of characteristics: 0.1 m to 12 m
inline constexpr double kTfminiClosest_m = 0.1;
inline constexpr double kTfminiFarthest_m = 12.0;

struct TfminiFrame {
    std::uint16_t distance_cm = 0;
    std::uint16_t strength = 0;
    double temperature_degC = 25.0;
};

/// @return valid when the echo is neither weak nor saturated and within the operating range
[[nodiscard]] RangeReading range_reading(const TfminiFrame& frame);
/// What a sensor would send for this reading; no echo: strength 0, distance 0.
[[nodiscard]] TfminiFrame tfmini_frame(const RangeReading& reading);
[[nodiscard]] std::array<std::byte, kTfminiFrame_bytes> encode(const TfminiFrame& frame);

/// Bytes to frames; finds its way back after any garbage. Two bytes 0x59 within a frame do not
/// mislead it for longer than until the next right checksum.
class TfminiParser {
public:
    /// @return a frame when this byte ends one
    [[nodiscard]] std::optional<TfminiFrame> parse(std::byte byte);

private:
    std::array<std::byte, kTfminiFrame_bytes> last_ = {};  ///< bytes that came
};

}  // namespace limpet::devices
