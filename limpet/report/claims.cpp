// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/claims.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::report {
namespace {

std::string number(double value, bool with_sign) {
    if (!std::isfinite(value)) {
        return "not a number";
    }
    const double shown = value + 0.0;  // no negative zero
    const bool long_one = std::abs(shown) >= 1e4 && std::abs(shown) < 1e9;
    const std::string text = long_one ? fmt::format("{:.0f}", shown) : fmt::format("{:.4g}", shown);
    if (text[0] == '-') {
        return "−" + text.substr(1);
    }
    return with_sign && shown > 0.0 ? "+" + text : text;
}

}  // namespace

const char* to_text(Verdict verdict) {
    switch (verdict) {
        case Verdict::reproduced: return "reproduced";
        case Verdict::differs: return "differs";
        case Verdict::not_modelled: return "not modelled";
    }
    throw InternalError("verdict out of range");
}

std::string to_text(const Quantity& quantity, bool with_sign) {
    if (const auto* words = std::get_if<std::string>(&quantity)) {
        return *words;
    }
    if (const auto* range = std::get_if<draw::Range>(&quantity)) {
        return fmt::format("{} … {}", number(range->low, false), number(range->high, false));
    }
    return number(std::get<double>(quantity), with_sign);
}

}  // namespace limpet::report
