// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "limpet/core/enum_names.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/signals/outcome.hpp"

namespace limpet {

/// What the truth shows at a flight's end, whatever guidance believes of it.
enum class TrueEnd {
    on_wall,   ///< the cup is sealed, and the vehicle keeps still
    hovering,  ///< in the air, slow, where it belongs
    adrift,    ///< in the air, slow, somewhere else
    standing,  ///< on the ground on its legs
    fallen,    ///< hit ground, wall or ceiling with something else than cup and legs
    moving,    ///< none of these yet: the time was over, or somebody ended it
    mounted,   ///< on a mount, where nothing flies
};

[[nodiscard]] inline std::string_view to_string(TrueEnd end) {
    return name_of(end);
}
/// @return nullopt for a name that is none
[[nodiscard]] inline std::optional<TrueEnd> true_end_from(std::string_view name) {
    return enumerator_of<TrueEnd>(name);
}

/// Whether the truth is what an outcome claims: rests on the wall, is back where it belongs, or, of
/// a mission that was given up, is safe. One that claims nothing (crashed, timed_out, interrupted)
/// is always borne out.
[[nodiscard]] inline bool bears_out(TrueEnd truth, Outcome outcome) {
    if (truth == TrueEnd::mounted) {
        return true;
    }
    switch (outcome) {
        case Outcome::perched:
        case Outcome::release_aborted: return truth == TrueEnd::on_wall;
        case Outcome::released:
        case Outcome::failed_to_seal: return truth == TrueEnd::hovering;
        case Outcome::aborted: return truth != TrueEnd::fallen && truth != TrueEnd::moving;
        case Outcome::crashed:
        case Outcome::timed_out:
        case Outcome::interrupted: return true;
    }
    throw InternalError("outcome out of range");
}

/// A success of a single flight: perched or released, and so by the truth.
[[nodiscard]] inline bool is_success(Outcome outcome, TrueEnd truth) {
    return (outcome == Outcome::perched || outcome == Outcome::released) &&
           bears_out(truth, outcome);
}

/// For people: "released", or "released, in truth adrift" where the truth is another.
[[nodiscard]] inline std::string told_with_truth(Outcome outcome, TrueEnd truth) {
    std::string text(to_string(outcome));
    if (!bears_out(truth, outcome)) {
        text += ", in truth ";
        text += to_string(truth);
    }
    return text;
}

}  // namespace limpet
