// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/tfmini.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>

namespace limpet::devices {
namespace {

constexpr std::byte kStart{0x59};
constexpr std::uint16_t kSaturated = 65535;
/// What a matt wall within 3 m gives, far from both ends.
/// Source: assumed: the manual gives limits alone
constexpr std::uint16_t kUsualStrength = 1000;

std::byte sum(std::span<const std::byte> bytes) {
    const unsigned total = std::accumulate(
        bytes.begin(), bytes.end(), 0U,
        [](unsigned so_far, std::byte byte) { return so_far + std::to_integer<unsigned>(byte); });
    return static_cast<std::byte>(total & 0xFFU);
}

using Words = std::array<std::uint16_t, 3>;  // little-endian, as every host we build for

}  // namespace

RangeReading range_reading(const TfminiFrame& frame) {
    const double distance_m = 0.01 * frame.distance_cm;
    const bool valid = frame.strength >= kTfminiWeakest && frame.strength != kSaturated &&
                       distance_m >= kTfminiClosest_m && distance_m <= kTfminiFarthest_m;
    return {.distance_m = valid ? distance_m : 0.0, .valid = valid};
}

TfminiFrame tfmini_frame(const RangeReading& reading) {
    if (!reading.valid) {
        return {};
    }
    const double distance_cm = std::clamp(100.0 * reading.distance_m, 0.0, 65535.0);
    return {.distance_cm = static_cast<std::uint16_t>(std::lround(distance_cm)),
            .strength = kUsualStrength};
}

std::array<std::byte, kTfminiFrame_bytes> encode(const TfminiFrame& frame) {
    const double raw = std::clamp(8.0 * (frame.temperature_degC + 256.0), 0.0, 65535.0);
    const Words words = {frame.distance_cm, frame.strength,
                         static_cast<std::uint16_t>(std::lround(raw))};
    std::array<std::byte, kTfminiFrame_bytes> bytes = {kStart, kStart};
    std::memcpy(&bytes[2], words.data(), sizeof(words));
    bytes[8] = sum(std::span(bytes).first(8));
    return bytes;
}

std::optional<TfminiFrame> TfminiParser::parse(std::byte byte) {
    std::copy(last_.begin() + 1, last_.end(), last_.begin());
    last_.back() = byte;
    if (last_[0] != kStart || last_[1] != kStart || sum(std::span(last_).first(8)) != byte) {
        return std::nullopt;
    }
    Words words = {};
    std::memcpy(words.data(), &last_[2], sizeof(words));
    last_ = {};  // no byte belongs to two frames
    return TfminiFrame{
        .distance_cm = words[0], .strength = words[1], .temperature_degC = words[2] / 8.0 - 256.0};
}

}  // namespace limpet::devices
