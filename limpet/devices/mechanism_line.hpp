// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

/// The perching mechanism's own wire: a microcontroller that switches pump and valve and reads load
/// cell and pressure sensor. Text over a serial port, 8N1, 115200 baud unless agreed otherwise.
///
///   line     = field *(" " field) "*" checksum LF  at most 80 characters; CR before LF is let go
///   field    = letter number                       each letter once; unknown ones are skipped
///   number   = ["-"] digits ["." digits]           up to a million
///   checksum = two hexadecimal digits, upper case: CRC-8 (polynomial 0x07, start 0) of all before
///              the asterisk
///
///   P  pump   1 on, 0 off                 F  axial force [N], tension positive
///   V  valve  1 open, 0 closed            A  absolute pressure in the cup [Pa]
///
/// Companion to mechanism, at 10 Hz or more, and at once on a change:   P1 V0*E4
/// Mechanism to companion, as fast as it measures:                      P1 V0 F-12.30 A88123*67
///
/// When the companion falls silent the mechanism keeps its last state: a vehicle that hangs on a
/// wall must not drop because a cable or a computer failed. After power-up, pump off and valve
/// closed until the first line; the companion's repeats bring the state back within 0.1 s. A line
/// with a wrong checksum changes nothing. The echo of P and V is what the outputs are.
/// Source: assumed: ours, the paper does not describe its wire
namespace limpet::devices {

inline constexpr std::size_t kMechanismLongestLine = 80;

/// One line, either way.
struct MechanismLine {
    std::optional<bool> pump_on = {};
    std::optional<bool> valve_open = {};
    std::optional<double> force_N = {};
    std::optional<double> pressure_Pa = {};
};

/// CRC-8, polynomial x^8 + x^2 + x + 1, start 0: "123456789" gives 0xF4.
[[nodiscard]] std::uint8_t line_checksum(std::string_view text);

using MechanismBuffer = std::array<char, kMechanismLongestLine + 2>;
/// @return the part of `into` that is the line, with its LF. Force to 0.01 N, pressure to 1 Pa.
[[nodiscard]] std::string_view encode(const MechanismLine& line, MechanismBuffer& into);

/// @param text  without LF
/// @return nothing when the checksum is wrong or a field is no number, doubled, or not 0 or 1 where
///         it must be
[[nodiscard]] std::optional<MechanismLine> decode_line(std::string_view text);

/// Bytes to lines; a line that is too long or damaged is dropped up to its LF.
class MechanismParser {
public:
    /// @return a line when this byte ends a right one
    [[nodiscard]] std::optional<MechanismLine> parse(std::byte byte);

private:
    std::array<char, kMechanismLongestLine + 1> text_ = {};
    std::size_t length_ = 0;
    bool too_long_ = false;
};

}  // namespace limpet::devices
