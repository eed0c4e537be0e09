// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "command_line.hpp"
#include "limpet/rare/rare_event.hpp"
#include "terminal.hpp"

namespace limpet::app {

/// The search of `limpet campaign --rare`.
struct RareOptions {
    std::string event;
    rare::RareGuide guide;
    int level_runs = 1000;
};
[[nodiscard]] OptionList options_of(RareOptions& options);

/// @throws InputError for options that need --rare, and for an event that is none
void check(const Given& given, const RareOptions& options);

/// Flies a search for a rare event and reports the result.
/// @param file  the campaign as it was named
/// @return other_outcome where it ends without an estimate
ExitCode fly_rare_campaign(const RareOptions& options, campaign::Results& results, int jobs,
                           const std::filesystem::path& folder, const std::string& file,
                           Terminal& terminal);

}  // namespace limpet::app
