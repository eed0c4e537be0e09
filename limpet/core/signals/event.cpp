// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/event.hpp"

#include "limpet/core/errors.hpp"

namespace limpet {

std::string_view to_string(EventName name) {
    switch (name) {
        case EventName::pre_positioned: return "pre_positioned";
        case EventName::approach_started: return "approach_started";
        case EventName::impact: return "impact";
        case EventName::contact_lost: return "contact_lost";
        case EventName::attached: return "attached";
        case EventName::hold_over: return "hold_over";
        case EventName::retreat_started: return "retreat_started";
        case EventName::landing_started: return "landing_started";
        case EventName::perched: return "perched";
        case EventName::motors_off: return "motors_off";
        case EventName::motors_on: return "motors_on";
        case EventName::level: return "level";
        case EventName::pump_off: return "pump_off";
        case EventName::valve_open: return "valve_open";
        case EventName::pressure_released: return "pressure_released";
        case EventName::detached: return "detached";
        case EventName::backed_off: return "backed_off";
        case EventName::aborted: return "aborted";
        case EventName::parameter_set: return "parameter_set";
    }
    throw InternalError("event name out of range");
}

void Event::add(std::string_view value_name, double value) {
    require(value_count < kMaxValues, "an event carries at most kMaxValues values");
    values[value_count++] = {value_name, value};
}

Event make_event(double time_s, std::string_view station, EventName name, std::string_view reason,
                 std::initializer_list<EventValue> values) {
    Event event{.time_s = time_s, .station = station, .name = name, .reason = reason};
    for (const EventValue& value : values) {
        event.add(value.name, value.value);
    }
    return event;
}

}  // namespace limpet
