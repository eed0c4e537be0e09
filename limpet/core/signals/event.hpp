// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string_view>

#include "limpet/core/enum_names.hpp"

namespace limpet {

/// Everything that a flight reports as it happens, in the order of the manoeuvre.
enum class EventName {
    pre_positioned,
    approach_started,
    impact,
    contact_lost,
    attached,
    hold_over,
    retreat_started,
    landing_started,
    perched,
    motors_off,
    motors_on,
    level,
    pump_off,
    valve_open,
    pressure_released,
    detached,
    backed_off,
    aborted,
    parameter_set,  ///< from outside, of the autopilot: its name and value
    fault_began,    ///< of a scenario's table
    fault_ended,
};

[[nodiscard]] inline std::string_view to_string(EventName name) {
    return name_of(name);
}

struct EventValue {
    std::string_view name;  ///< a literal: outlives the event
    double value = 0.0;
};

/// Fixed size: reporting one allocates nothing.
struct Event {
    static constexpr std::size_t kMaxValues = 6;

    double time_s = 0.0;
    std::string_view station;  ///< "guidance", "cup", "simulation": a literal
    EventName name = EventName::aborted;
    std::string_view reason;  ///< a literal, why it happened; may be empty
    std::array<EventValue, kMaxValues> values{};
    std::size_t value_count = 0;

    /// @throws InternalError beyond kMaxValues
    void add(std::string_view value_name, double value);
};

[[nodiscard]] Event make_event(double time_s, std::string_view station, EventName name,
                               std::string_view reason = {},
                               std::initializer_list<EventValue> values = {});

}  // namespace limpet
