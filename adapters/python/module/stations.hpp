// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/flight.hpp"
#include "module.hpp"

namespace limpet::python {

/// Python objects as stations of a flight: whatever has the methods
/// (flying.py lists them) will do. None: the scenario's.
[[nodiscard]] Stations stations_of(const py::object& guidance, const py::object& autopilot,
                                   const py::object& cup);

/// @throws py::value_error for a name that is none
[[nodiscard]] Outcome outcome_named(const std::string& name);

}  // namespace limpet::python
