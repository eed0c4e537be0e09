// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/mission_report.hpp"

#include <cmath>

namespace limpet::mavlink {
namespace {

constexpr std::string_view kOutcome = "outcome";
constexpr std::string_view kAnd = ": ";

struct Parts {
    std::string_view head;
    std::string_view rest;
};
Parts part(std::string_view text) {
    const std::size_t at = text.find(kAnd);
    return at == std::string_view::npos ? Parts{text, {}}
                                        : Parts{text.substr(0, at), text.substr(at + kAnd.size())};
}

}  // namespace

ReportText event_text(const Event& event) {
    return event.reason.empty() ? ReportText(to_string(event.name))
                                : ReportText(to_string(event.name), kAnd, event.reason);
}

std::optional<ToldEvent> told_event(std::string_view text) {
    const Parts parts = part(text);
    for (int i = 0; i <= static_cast<int>(EventName::aborted); ++i) {
        const auto name = static_cast<EventName>(i);
        if (to_string(name) == parts.head) {
            return ToldEvent{.name = name, .reason = parts.rest};
        }
    }
    return std::nullopt;
}

ReportText outcome_text(Outcome outcome, std::string_view reason) {
    return ReportText(kOutcome, kAnd, to_string(outcome), kAnd, reason);
}

std::optional<ToldOutcome> told_outcome(std::string_view text) {
    const Parts whole = part(text);
    const Parts parts = part(whole.rest);
    const std::optional<Outcome> outcome = outcome_from(parts.head);
    if (whole.head != kOutcome || !outcome) {
        return std::nullopt;
    }
    return ToldOutcome{.outcome = *outcome, .reason = parts.rest};
}

NamedValueFloat guidance_state(int state, std::uint32_t time_boot_ms) {
    NamedValueFloat message{.time_boot_ms = time_boot_ms, .value = static_cast<float>(state)};
    set_text(message.name, kGuidanceStateName);
    return message;
}

std::optional<int> guidance_state(const NamedValueFloat& message) {
    const bool whole = message.value >= 0.0F && message.value <= 255.0F &&
                       message.value == std::floor(message.value);
    if (text_of(message.name) != kGuidanceStateName || !whole) {
        return std::nullopt;
    }
    return static_cast<int>(message.value);
}

}  // namespace limpet::mavlink
