// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "air.hpp"
#include "channels.hpp"
#include "limpet/core/time.hpp"
#include "limpet/limpet.hpp"
#include "stations.hpp"

namespace limpet::python {
namespace {

/// A flight that has been flown, with its channels.
struct Flown : Result {
    ChannelLog log;
};

py::dict metrics_of(const Flown& result) {
    py::dict metrics;
    for (const Metric& metric : result.metrics) {
        metrics[py::str(metric.name)] = metric.value;
    }
    return metrics;
}

/// Looks for Ctrl-C and for the interpreter's end now and then; flies without the GIL in between.
class Patience {
public:
    void wait() {
        if (++calls_ % 64 != 0 || Clock::now() < next_) {
            return;
        }
        next_ = Clock::now() + std::chrono::milliseconds(50);
        if (interpreter_ends()) {
            throw InterpreterEnds();
        }
        const py::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) {
            throw py::error_already_set();
        }
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point next_ = Clock::now() + std::chrono::milliseconds(50);
    unsigned calls_ = 0;
};

Tick tick_of(const Flight& flight) {
    return std::llround(flight.time_s() * kTicksPerSecond);
}

/// @param rate_Hz  of the channels' samples: the first step of the loop in each interval
std::shared_ptr<Flown> fly(Flight& flight, int rate_Hz) {
    if (rate_Hz < 1 || rate_Hz > kTicksPerSecond) {
        throw py::value_error("rate_Hz: 1..1000");
    }
    auto flown = std::make_shared<Flown>();
    const FlyFreely fly_freely;
    const int every = kTicksPerSecond / rate_Hz;
    Patience patience;
    flown->log.sample(flight);
    for (Tick next = tick_of(flight) + every; flight.tick(); patience.wait()) {
        if (tick_of(flight) >= next) {
            flown->log.sample(flight);
            next += every * ((tick_of(flight) - next) / every + 1);
        }
    }
    static_cast<Result&>(*flown) = flight.result();
    return flown;
}

/// A flight as Python steps it: several steps of the loop at once.
class Stepped final : public Flight {
public:
    using Flight::Flight;

    bool ticks(long long count) {
        constexpr long long kMost = 1'000'000'000;  // longer than any flight
        if (count < 0) {
            throw py::value_error("tick(): 0 milliseconds or more");
        }
        const FlyFreely fly_freely;
        Patience patience;
        happened_.clear();
        bool goes_on = !ended();
        for (const Tick end = tick_of(*this) + std::min(count, kMost);
             goes_on && tick_of(*this) < end;) {
            goes_on = tick();
            happened_.insert(happened_.end(), events().begin(), events().end());
            patience.wait();
        }
        return goes_on;
    }
    /// Of the last ticks().
    [[nodiscard]] const std::vector<Event>& happened() const { return happened_; }

private:
    std::vector<Event> happened_;
};

void add_scenario(py::module_& module) {
    py::class_<Scenario>(module, "Scenario",
                         "One experiment, read and checked: what flies, against what. Immutable.")
        .def_property_readonly("name", &Scenario::name)
        .def_property_readonly("description", &Scenario::description)
        .def_property_readonly("seed", &Scenario::seed)
        .def_property_readonly("yaml", &Scenario::yaml, "flies the same again")
        .def("_changed", &Scenario::with)
        .def("__repr__", [](const Scenario& s) { return "<limpet.Scenario " + s.name() + ">"; });
    module.def("_load", &load, py::arg("wanted"), py::arg("changes"));
    module.def("scenarios", &scenario_names, "Names of all scenarios that are installed.");
    module.def(
        "channels",
        [] {
            py::dict table;
            for (const Channel& channel : channel_table()) {
                table[channel.name] = channel.what;
            }
            return table;
        },
        "What a flight is sampled into: {name with SI unit: what it is}.");
}

void add_result(py::module_& module) {
    py::class_<Flown, std::shared_ptr<Flown>>(
        module, "Result",
        "A flight that has been flown. r[\"cup_pressure_Pa\"] "
        "is a channel against r[\"time_s\"], read-only, not "
        "copied; channels() lists them.")
        .def_property_readonly(
            "outcome", [](const Flown& f) { return std::string(to_string(f.outcome)); },
            "released, perched, failed_to_seal, crashed, ...")
        .def_property_readonly(
            "true_end", [](const Flown& f) { return std::string(to_string(f.true_end)); },
            "what the truth shows: on_wall, hovering, adrift, standing, fallen, moving, mounted")
        .def_readonly("success", &Flown::success, "perched or released, and so by the truth")
        .def_readonly("reason", &Flown::reason)
        .def_readonly("simulated_s", &Flown::simulated_s, "[s]")
        .def_readonly("attempts", &Flown::attempts, "docking runs")
        .def_readonly("events", &Flown::events)
        .def_property_readonly("metrics", metrics_of,
                               "{name with unit: number}; NaN: did not come to pass")
        .def_readonly("state_hash", &Flown::state_hash,
                      "digest of the trajectory: equal bits, equal hash")
        .def("__getitem__",
             [](const py::object& self, const std::string& name) {
                 const auto& flown = self.cast<const Flown&>();
                 return view_of(flown.log.columns[channel_index(name)], self);
             })
        .def("keys",
             [](const Flown&) {
                 std::vector<std::string> names;
                 for (const Channel& channel : channel_table()) {
                     names.emplace_back(channel.name);
                 }
                 return names;
             })
        .def("__repr__", [](const Flown& f) {
            return "<limpet.Result " + std::string(to_string(f.outcome)) + " after " +
                   std::to_string(f.simulated_s) + " s>";
        });
}

void add_flight_class(py::module_& module) {
    py::class_<Moment>(module, "Moment", "A flight at one instant, to branch from.");
    const auto copy = py::return_value_policy::copy;
    py::class_<Stepped>(module, "Flight",
                        "One flight, to be flown to its end or stepped. Same scenario, run and "
                        "stations: the same bits. It belongs to one thread at a time.")
        .def(py::init([](const Scenario& scenario, std::uint32_t run, const Moment* start,
                         const py::object& guidance, const py::object& autopilot,
                         const py::object& cup) {
                 if (start != nullptr && run != 0) {
                     throw py::value_error("a branch has the random numbers of its start, no run");
                 }
                 const Stations stations = stations_of(guidance, autopilot, cup);
                 return start != nullptr ? Stepped(scenario, *start, stations)
                                         : Stepped(scenario, stations, run);
             }),
             py::arg("scenario"), py::arg("run") = 0, py::kw_only(), py::arg("start") = nullptr,
             py::arg("guidance") = py::none(), py::arg("autopilot") = py::none(),
             py::arg("cup") = py::none())
        .def("record", &Flight::record, py::arg("file"),
             "Writes all signals from here on into an MCAP file.")
        .def("tick", &Stepped::ticks, py::arg("count") = 1,
             "Flies so many milliseconds, rounded up to a step of the loop. Returns whether the "
             "flight goes on.")
        .def(
            "fly", [](Stepped& flight, int rate_Hz) { return fly(flight, rate_Hz); },
            py::arg("rate_Hz") = 100, "To the end; channels at this rate.")
        .def_property_readonly("ended", &Flight::ended)
        .def_property_readonly("time_s", &Flight::time_s, "[s]")
        .def_property_readonly("truth", &Flight::truth, copy)
        .def_property_readonly("readings", &Flight::readings, copy)
        .def_property_readonly("estimate", &Flight::estimate, copy)
        .def_property_readonly("setpoint", &Flight::setpoint, copy)
        .def_property_readonly("rotor_commands",
                               [](const Stepped& f) { return array_of(f.rotors().command); })
        .def_property_readonly("phase", [](const Stepped& f) { return std::string(f.phase()); })
        .def_property_readonly(
            "events", [](const Stepped& f) { return f.happened(); },
            "of the last tick(), all of it")
        .def("save", &Flight::save,
             "To go on from here later, on other walls or with other stations.");
}

void add_recording(py::module_& module) {
    py::class_<PastEvent>(module, "PastEvent", "An event as it was recorded.")
        .def_readonly("time_s", &PastEvent::time_s)
        .def_readonly("station", &PastEvent::station)
        .def_readonly("name", &PastEvent::name)
        .def_readonly("reason", &PastEvent::reason)
        .def_property_readonly("values", [](const PastEvent& e) {
            py::dict values;
            for (const auto& [name, value] : e.values) {
                values[py::str(name)] = value;
            }
            return values;
        });
    py::class_<Recording>(module, "Recording", "A flight's MCAP file, read back.")
        .def(py::init<const std::filesystem::path&>(), py::arg("file"))
        .def_property_readonly("topics", &Recording::topics)
        .def("columns", &Recording::columns, py::arg("topic"))
        .def(
            "series",
            [](const py::object& self, const std::string& topic, const std::string& column) {
                const Series series = self.cast<const Recording&>().series(topic, column);
                return py::make_tuple(view_of(series.time_s, self), view_of(series.values, self));
            },
            py::arg("topic"), py::arg("column"), "(time_s, values), not copied")
        .def_property_readonly("events", &Recording::events)
        .def_property_readonly("scenario_yaml", &Recording::scenario_yaml)
        .def_property_readonly("damage", &Recording::damage, "empty when whole");
}

}  // namespace

void add_flight(py::module_& module) {
    add_scenario(module);
    add_result(module);
    add_flight_class(module);
    add_recording(module);
}

}  // namespace limpet::python
