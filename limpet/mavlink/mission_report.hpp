// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/outcome.hpp"
#include "limpet/mavlink/messages.hpp"

/// What a companion reports of its mission, on the sensors' wire and to people: events and the
/// outcome as STATUSTEXT (in chunks, status_text.hpp), the state of guidance as NAMED_VALUE_FLOAT.
/// The last heartbeats carry MavState::poweroff (mechanism.hpp).
namespace limpet::mavlink {

/// A text of a mission's report; what is longer is cut. Allocates nothing.
class ReportText {
public:
    template <class... Pieces>
    explicit ReportText(const Pieces&... pieces) {
        (add(pieces), ...);
    }
    [[nodiscard]] std::string_view view() const { return {letters_.data(), size_}; }

private:
    void add(std::string_view piece) {
        const std::size_t fits = std::min(piece.size(), letters_.size() - size_);
        std::copy_n(piece.begin(), fits, letters_.begin() + static_cast<std::ptrdiff_t>(size_));
        size_ += fits;
    }
    std::array<char, 400> letters_ = {};
    std::size_t size_ = 0;
};

/// "perched: reason".
[[nodiscard]] ReportText event_text(const Event& event);
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
[[nodiscard]] ReportText outcome_text(Outcome outcome, std::string_view reason);
[[nodiscard]] std::optional<ToldOutcome> told_outcome(std::string_view text);

/// Name of the NAMED_VALUE_FLOAT with the number of guidance's state, 0 the first.
inline constexpr std::string_view kGuidanceStateName = "guid_state";
[[nodiscard]] NamedValueFloat guidance_state(int state, std::uint32_t time_boot_ms);
/// @return nothing for other names and what is no whole number from 0 to 255
[[nodiscard]] std::optional<int> guidance_state(const NamedValueFloat& message);

}  // namespace limpet::mavlink
