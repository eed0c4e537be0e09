// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/signals/event.hpp"

#include "limpet/core/errors.hpp"

namespace limpet {

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
