// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/tfmini.hpp"

#include <algorithm>
#include <cmath>
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

std::uint16_t word(std::byte low, std::byte high) {
    return static_cast<std::uint16_t>(std::to_integer<unsigned>(low) |
                                      (std::to_integer<unsigned>(high) << 8U));
}

void put(std::uint16_t value, std::byte* into) {
    into[0] = static_cast<std::byte>(value & 0xFFU);
    into[1] = static_cast<std::byte>(value >> 8U);
}

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
    std::array<std::byte, kTfminiFrame_bytes> bytes = {kStart, kStart};
    put(frame.distance_cm, &bytes[2]);
    put(frame.strength, &bytes[4]);
    const double raw = std::clamp(8.0 * (frame.temperature_degC + 256.0), 0.0, 65535.0);
    put(static_cast<std::uint16_t>(std::lround(raw)), &bytes[6]);
    bytes[8] = sum(std::span(bytes).first(8));
    return bytes;
}

void TfminiParser::drop_first() {
    ++discarded_;
    std::copy(frame_.begin() + 1, frame_.begin() + static_cast<std::ptrdiff_t>(count_),
              frame_.begin());
    --count_;
}

std::optional<TfminiFrame> TfminiParser::parse(std::byte byte) {
    frame_[count_++] = byte;
    if (count_ == kTfminiFrame_bytes && sum(std::span(frame_).first(8)) == frame_[8] &&
        frame_[0] == kStart && frame_[1] == kStart) {
        count_ = 0;
        ++frames_;
        return TfminiFrame{.distance_cm = word(frame_[2], frame_[3]),
                           .strength = word(frame_[4], frame_[5]),
                           .temperature_degC = word(frame_[6], frame_[7]) / 8.0 - 256.0};
    }
    if (count_ == kTfminiFrame_bytes) {
        ++damaged_;
        drop_first();  // a frame may have begun within it
    }
    while (count_ > 0 && (frame_[0] != kStart || (count_ > 1 && frame_[1] != kStart))) {
        drop_first();
    }
    return std::nullopt;
}

}  // namespace limpet::devices
