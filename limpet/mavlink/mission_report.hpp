// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/outcome.hpp"
#include "limpet/mavlink/messages.hpp"

/// What a companion reports of its mission, on the sensors' wire and to people: events and the
/// outcome as STATUSTEXT, the state of guidance as NAMED_VALUE_FLOAT. The last heartbeats carry
/// MavState::poweroff (mechanism.hpp).
namespace limpet::mavlink {

/// "perched: reason", at most 50 letters.
[[nodiscard]] StatusText event_text(const Event& event);
/// @return nothing for texts that are no event's
[[nodiscard]] std::optional<EventName> event_name(const StatusText& message);

struct ToldOutcome {
    Outcome outcome = Outcome::timed_out;
    std::string_view reason;  ///< lives as long as the message
};
/// "outcome: released: reason", at most 50 letters.
[[nodiscard]] StatusText outcome_text(Outcome outcome, std::string_view reason);
[[nodiscard]] std::optional<ToldOutcome> told_outcome(const StatusText& message);

/// Name of the NAMED_VALUE_FLOAT with the number of guidance's state, 0 the first.
inline constexpr std::string_view kGuidanceStateName = "guid_state";
[[nodiscard]] NamedValueFloat guidance_state(int state, std::uint32_t time_boot_ms);
/// @return nothing for other names and what is no whole number from 0 to 255
[[nodiscard]] std::optional<int> guidance_state(const NamedValueFloat& message);

}  // namespace limpet::mavlink
