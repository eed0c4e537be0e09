// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "limpet/draw/chart.hpp"

/// What a paper says and what came out here.
namespace limpet::report {

/// A number, a range of numbers, or words where there is none: "lets go at once".
using Quantity = std::variant<std::string, double, draw::Range>;

enum class Verdict {
    reproduced,
    differs,
    not_modelled,
};
/// "reproduced", "differs", "not modelled"
[[nodiscard]] const char* to_text(Verdict verdict);

/// One statement of the paper. Nothing may be empty but what says so.
struct Claim {
    std::string id = {};         ///< of letters, digits, '_' and '-'; unique
    std::string section = {};    ///< where the paper says it: "IV-B", "Fig. 11"
    std::string statement = {};  ///< what it says, in a sentence
    Quantity paper = {};
    Quantity simulated = {};
    std::string unit = {};     ///< of paper, simulated and a number as difference; empty: none
    Quantity difference = {};  ///< simulated less paper, or words
    Verdict verdict = Verdict::not_modelled;
    std::string accepted = {};  ///< of the simulated value: "0.8 … 1.4", "at least 2"; may be empty
    std::string basis = {};     ///< how the simulated value came about: "measured"; may be empty
    std::vector<std::string> assumes = {};  ///< keys on whose assumed values the verdict rests
    std::string same_as = {};    ///< id of a claim that says the same of the same; may be empty
    std::string note = {};       ///< why it differs, where bounds come from; may be empty
    std::string figure = {};     ///< id of a figure of the page; may be empty
    std::string recording = {};  ///< path relative to the page; may be empty
};

/// As people read it: four digits, "0.8 … 1.4", the words.
/// @param with_sign  of a number: "+0.03"
[[nodiscard]] std::string to_text(const Quantity& quantity, bool with_sign = false);

}  // namespace limpet::report
