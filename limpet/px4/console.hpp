// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace limpet::px4 {

/// What stands out in what a PX4 printed.
struct Px4Console {
    std::size_t errors = 0;    ///< lines marked ERROR
    std::size_t warnings = 0;  ///< lines marked WARN
    bool failsafe = false;     ///< one of them, or another line, tells of a failsafe
    /// The different ones among them, as they came, without colours: errors, then failsafes, then
    /// warnings; at most kMostLines.
    std::vector<std::string> lines;
    static constexpr std::size_t kMostLines = 5;
};

/// @param text  PX4's output: "ERROR [param] Parameter MPC_USE_HTE not found."
[[nodiscard]] Px4Console read_px4_console(std::string_view text);

/// "2 errors, 1 warning, failsafe"; empty: nothing stands out.
[[nodiscard]] std::string console_text(const Px4Console& console);

}  // namespace limpet::px4
