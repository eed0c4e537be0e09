// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/mechanism_line.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace limpet::devices {
namespace {

constexpr double kLargest = 1e6;  // N and Pa: beyond any sensor, and within the line's length

/// Decimal digits with sign and point, no exponent; std::from_chars for doubles came with GCC 11.
std::optional<double> number(std::string_view text) {
    const bool negative = text.starts_with('-');
    text.remove_prefix(negative || text.starts_with('+') ? 1 : 0);
    double value = 0.0;
    double place = 0.0;  // of the next digit behind the point; 0: before it
    bool digits = false;
    for (const char letter : text) {
        if (letter == '.' && place == 0.0) {
            place = 0.1;
        } else if (letter >= '0' && letter <= '9') {
            const double digit = letter - '0';
            value = place == 0.0 ? 10.0 * value + digit : value + place * digit;
            place *= 0.1;
            digits = true;
        } else {
            return std::nullopt;
        }
    }
    if (!digits || value > kLargest) {
        return std::nullopt;
    }
    return negative ? -value : value;
}

bool set(std::optional<double>& field, double value) {
    return !std::exchange(field, value).has_value();
}

bool set(std::optional<bool>& field, double value) {
    return !std::exchange(field, value == 1.0).has_value() && (value == 0.0 || value == 1.0);
}

bool take_field(std::string_view field, MechanismLine& line) {
    const std::optional<double> value = field.empty() ? std::nullopt : number(field.substr(1));
    if (!value) {
        return false;
    }
    switch (field[0]) {
        case 'P': return set(line.pump_on, *value);
        case 'V': return set(line.valve_open, *value);
        case 'F': return set(line.force_N, *value);
        case 'A': return set(line.pressure_Pa, *value);
        default: return field[0] >= 'A' && field[0] <= 'Z';  // a newer device says more
    }
}

}  // namespace

std::uint8_t line_checksum(std::string_view text) {
    unsigned crc = 0;
    for (const char letter : text) {
        crc ^= static_cast<unsigned char>(letter);
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc & 0x80U) != 0 ? ((crc << 1U) ^ 0x07U) & 0xFFU : crc << 1U;
        }
    }
    return static_cast<std::uint8_t>(crc);
}

std::string_view encode(const MechanismLine& line, MechanismBuffer& into) {
    char* end = into.data();
    const auto put = [&](char letter, double value, int decimals) {
        end = fmt::format_to(end, "{}{}{:.{}f}", end == into.data() ? "" : " ", letter, value,
                             decimals);
    };
    if (line.pump_on) {
        put('P', *line.pump_on ? 1.0 : 0.0, 0);
    }
    if (line.valve_open) {
        put('V', *line.valve_open ? 1.0 : 0.0, 0);
    }
    if (line.force_N && std::abs(*line.force_N) <= kLargest) {
        put('F', *line.force_N, 2);
    }
    if (line.pressure_Pa && std::abs(*line.pressure_Pa) <= kLargest) {
        put('A', *line.pressure_Pa, 0);
    }
    const auto text = [&] {
        return std::string_view(into.data(), static_cast<std::size_t>(end - into.data()));
    };
    end = fmt::format_to(end, "*{:02X}\n", line_checksum(text()));
    return text();
}

std::optional<MechanismLine> decode_line(std::string_view text) {
    if (!text.empty() && text.back() == '\r') {
        text.remove_suffix(1);
    }
    if (text.size() < 5 || text[text.size() - 3] != '*') {
        return std::nullopt;
    }
    const std::string_view checksum = text.substr(text.size() - 2);
    text.remove_suffix(3);
    if (checksum != fmt::format("{:02X}", line_checksum(text))) {
        return std::nullopt;
    }
    MechanismLine line;
    for (;;) {
        const std::size_t space = text.find(' ');
        if (!take_field(text.substr(0, space), line)) {
            return std::nullopt;
        }
        if (space == std::string_view::npos) {
            return line;
        }
        text.remove_prefix(space + 1);
    }
}

std::optional<MechanismLine> MechanismParser::parse(std::byte byte) {
    const char letter = static_cast<char>(byte);
    if (letter != '\n') {
        too_long_ = too_long_ || length_ == text_.size();
        if (!too_long_) {
            text_[length_++] = letter;
        }
        return std::nullopt;
    }
    const bool whole = !std::exchange(too_long_, false);
    const std::string_view text(text_.data(), std::exchange(length_, 0));
    return whole ? decode_line(text) : std::nullopt;
}

}  // namespace limpet::devices
