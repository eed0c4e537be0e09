// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/outcome.hpp"
#include "limpet/mavlink/messages.hpp"

/// What a companion reports of its mission, on the sensors' wire and to people: events and the
/// outcome as STATUSTEXT (in chunks, status_text.hpp), the state of guidance as NAMED_VALUE_FLOAT.
/// The last heartbeats carry MavState::poweroff (mechanism.hpp).
namespace limpet::mavlink {

/// "perched: reason".
[[nodiscard]] std::string event_text(const Event& event);
struct ToldEvent {
    EventName name = EventName::aborted;
    std::string_view reason;  ///< lives as long as the text
};
/// @return nothing for texts that are no event's
[[nodiscard]] std::optional<ToldEvent> told_event(std::string_view text);

struct ToldOutcome {
    Outcome outcome = Outcome::timed_out;
    std::string_view reason;  ///< lives as long as the text
};
/// "outcome: released: reason".
[[nodiscard]] std::string outcome_text(Outcome outcome, std::string_view reason);
[[nodiscard]] std::optional<ToldOutcome> told_outcome(std::string_view text);

/// Name of the NAMED_VALUE_FLOAT with the number of guidance's state, 0 the first.
inline constexpr std::string_view kGuidanceStateName = "guid_state";
[[nodiscard]] NamedValueFloat guidance_state(int state, std::uint32_t time_boot_ms);
/// @return nothing for other names and what is no whole number from 0 to 255
[[nodiscard]] std::optional<int> guidance_state(const NamedValueFloat& message);

}  // namespace limpet::mavlink
