// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/mission_report.hpp"

#include <cmath>

namespace limpet::mavlink {
namespace {

constexpr std::uint8_t kInfo = 6;  // MAV_SEVERITY
constexpr std::string_view kOutcome = "outcome";
constexpr std::string_view kAnd = ": ";

/// Fills a text piece by piece and lets go of what does not fit.
class TextWriter {
public:
    void add(std::string_view piece) {
        const std::size_t room = text_.size() - length_;
        length_ += piece.substr(0, room).copy(text_.data() + length_, room);
    }
    [[nodiscard]] StatusText message() const {
        StatusText message;
        message.severity = kInfo;
        message.text = text_;
        return message;
    }

private:
    std::array<char, 50> text_ = {};
    std::size_t length_ = 0;
};

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

StatusText event_text(const Event& event) {
    TextWriter text;
    text.add(to_string(event.name));
    if (!event.reason.empty()) {
        text.add(kAnd);
        text.add(event.reason);
    }
    return text.message();
}

std::optional<EventName> event_name(const StatusText& message) {
    const std::string_view head = part(text_of(message.text)).head;
    for (int i = 0; i <= static_cast<int>(EventName::aborted); ++i) {
        const auto name = static_cast<EventName>(i);
        if (to_string(name) == head) {
            return name;
        }
    }
    return std::nullopt;
}

StatusText outcome_text(Outcome outcome, std::string_view reason) {
    TextWriter text;
    text.add(kOutcome);
    text.add(kAnd);
    text.add(to_string(outcome));
    text.add(kAnd);
    text.add(reason);
    return text.message();
}

std::optional<ToldOutcome> told_outcome(const StatusText& message) {
    const Parts whole = part(text_of(message.text));
    const Parts told = part(whole.rest);
    const std::optional<Outcome> outcome = outcome_from(told.head);
    if (whole.head != kOutcome || !outcome) {
        return std::nullopt;
    }
    return ToldOutcome{.outcome = *outcome, .reason = told.rest};
}

NamedValueFloat guidance_state(int state, std::uint32_t time_boot_ms) {
    NamedValueFloat message;
    message.time_boot_ms = time_boot_ms;
    set_text(message.name, kGuidanceStateName);
    message.value = static_cast<float>(state);
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
