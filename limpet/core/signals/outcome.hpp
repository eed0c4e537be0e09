// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "limpet/core/enum_names.hpp"

namespace limpet {

/// How a flight ended.
enum class Outcome {
    perched,         ///< rests on the wall, motors off, as the mission requires
    released,        ///< perched, took off and is back where it came from (or hovered as requested)
    failed_to_seal,  ///< used up its attempts
    release_aborted,  ///< gave up the release and rests on the wall again
    aborted,          ///< gave the mission up in the air for another reason, which its reason says
    crashed,          ///< hit something with something else than the cup and the legs
    timed_out,        ///< the scenario's time is over
    interrupted,      ///< somebody ended it: Ctrl-C, SIGTERM
};

[[nodiscard]] inline std::string_view to_string(Outcome outcome) {
    return name_of(outcome);
}
/// @return nullopt for a name that is none
[[nodiscard]] inline std::optional<Outcome> outcome_from(std::string_view name) {
    return enumerator_of<Outcome>(name);
}

}  // namespace limpet
