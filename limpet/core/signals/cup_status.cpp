// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/cup_status.hpp"

#include "limpet/core/errors.hpp"

namespace limpet {

std::string_view to_string(CupPhase phase) {
    switch (phase) {
        case CupPhase::free: return "free";
        case CupPhase::touching: return "touching";
        case CupPhase::sealing: return "sealing";
        case CupPhase::attached: return "attached";
        case CupPhase::unsealing: return "unsealing";
    }
    throw InternalError("cup phase out of range");
}

}  // namespace limpet
