// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/outcome.hpp"

#include <array>

#include "limpet/core/errors.hpp"

namespace limpet {

std::string_view to_string(Outcome outcome) {
    switch (outcome) {
        case Outcome::perched: return "perched";
        case Outcome::released: return "released";
        case Outcome::failed_to_seal: return "failed_to_seal";
        case Outcome::release_aborted: return "release_aborted";
        case Outcome::crashed: return "crashed";
        case Outcome::timed_out: return "timed_out";
    }
    throw InternalError("outcome out of range");
}

std::optional<Outcome> outcome_from(std::string_view name) {
    for (const Outcome outcome :
         std::array{Outcome::perched, Outcome::released, Outcome::failed_to_seal,
                    Outcome::release_aborted, Outcome::crashed, Outcome::timed_out}) {
        if (to_string(outcome) == name) {
            return outcome;
        }
    }
    return std::nullopt;
}

}  // namespace limpet
