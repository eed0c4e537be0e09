// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The colours of every chart and map: restrained, different in lightness as well as in hue
/// (Okabe and Ito's set, toned down).
namespace limpet::draw::colours {

inline constexpr const char* kInk = "#222B33";
inline constexpr const char* kFaint = "#5F6A74";
inline constexpr const char* kGrid = "#DDE2E7";
inline constexpr const char* kShade = "#F4F6F8";
inline constexpr const char* kMoment = "#B4BDC6";  ///< a vertical line: an event
inline constexpr const char* kLevel = "#C0504D";   ///< a horizontal line: a limit
inline constexpr const char* kWarning = "#B3261E";

inline constexpr const char* kDarkBlue = "#0B3C5D";
inline constexpr const char* kBlue = "#6FA8D6";
inline constexpr const char* kOrange = "#D98E04";
inline constexpr const char* kPeach = "#F0A35E";
inline constexpr const char* kRust = "#A34700";
inline constexpr const char* kGreen = "#1B7F5C";
inline constexpr const char* kPlum = "#8C4A7D";

}  // namespace limpet::draw::colours
