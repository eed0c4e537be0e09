// SPDX-License-Identifier: Apache-2.0
#include "stations.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <type_traits>

namespace limpet::python {
namespace {

/// An attribute that is not there means 0; the error of one that fails is passed on.
std::size_t memory_size_of(const py::object& object) {
    constexpr const char* kName = "memory_size";
    if (!py::hasattr(py::type::of(object), kName) && !py::hasattr(object, kName)) {
        return 0;
    }
    const py::object size = object.attr(kName);
    try {
        if (py::isinstance<py::bool_>(size) || PyIndex_Check(size.ptr()) == 0) {
            throw py::cast_error();
        }
        return size.cast<std::size_t>();
    } catch (const py::cast_error&) {
        throw py::type_error("memory_size: a whole number from 0 on, not " +
                             std::string(py::repr(size)));
    }
}

/// What a station has returned.
/// @throws py::type_error naming the method, the type that it returned and what it should
template <class T>
T taken(const py::object& returned, const char* method, const char* wanted) {
    const auto refuse = [&]() -> T {
        throw py::type_error(std::string(method) + "() returned " +
                             std::string(py::str(py::type::of(returned).attr("__name__"))) +
                             ", not " + wanted);
    };
    try {
        return std::is_same_v<T, py::tuple> && PySequence_Check(returned.ptr()) == 0
                   ? refuse()
                   : returned.cast<T>();
    } catch (const py::cast_error&) {
        return refuse();
    } catch (const py::reference_cast_error&) {  // of None
        return refuse();
    }
}

/// The flight's numbers while a station may write them: a separate array, so that a station may
/// keep it.
class Lent {
public:
    explicit Lent(std::span<double> memory)
        : memory_(memory), array_(static_cast<py::ssize_t>(memory.size()), memory.data()) {}
    [[nodiscard]] const py::array_t<double>& array() const { return array_; }
    void take_back() const {
        if (static_cast<std::size_t>(array_.size()) != memory_.size()) {
            throw py::value_error("memory: another size than it was lent with");
        }
        std::copy_n(array_.data(), memory_.size(), memory_.begin());
    }

private:
    std::span<double> memory_;
    py::array_t<double> array_;
};

/// A station that is a Python object. Flights may release it on any thread.
template <class Station>
class PythonStation : public Station {
public:
    PythonStation(py::object object, const char* method)
        : object_(std::move(object)), method_(method) {
        if (!py::hasattr(object_, method)) {
            throw py::type_error(std::string(py::str(py::type::of(object_))) + " has no method " +
                                 method + "()");
        }
        if (PyType_Check(object_.ptr()) != 0) {
            throw py::type_error(std::string(py::str(object_)) +
                                 ": a class, not an object of it that could " + method + "()");
        }
        memory_size_ = memory_size_of(object_);
    }
    ~PythonStation() override {
        const PyGILState_STATE gil = PyGILState_Ensure();
        object_.release().dec_ref();
        PyGILState_Release(gil);
    }
    [[nodiscard]] std::size_t memory_size() const override { return memory_size_; }

protected:
    /// With the GIL. Signals are copied: Python may keep them.
    /// @param memory  the last argument
    template <class... Arguments>
    [[nodiscard]] py::object call(std::span<double> memory, const Arguments&... arguments) const {
        const Lent lent(memory);
        py::object returned =
            object_.attr(method_).template operator()<py::return_value_policy::copy>(arguments...,
                                                                                     lent.array());
        lent.take_back();
        return returned;
    }

private:
    py::object object_;
    const char* method_;
    std::size_t memory_size_ = 0;
};

/// Reasons are literals elsewhere: those of Python live as long as the program.
std::string_view kept(const std::string& text) {
    static std::mutex mutex;
    static std::set<std::string> texts;
    const std::lock_guard lock(mutex);
    return *texts.insert(text).first;
}

class PythonGuidance final : public PythonStation<Guidance> {
public:
    explicit PythonGuidance(py::object object) : PythonStation(std::move(object), "update") {}
    [[nodiscard]] GuidanceOutput update(const GuidanceInput& input,
                                        std::span<double> memory) const override {
        const py::gil_scoped_acquire gil;
        const py::object returned = call(memory, input.readings, input.estimate, input.time_s);
        constexpr const char* kWanted = "a Setpoint, or (Setpoint, outcome, reason)";
        if (!py::isinstance<py::tuple>(returned)) {
            return {.setpoint = taken<Setpoint>(returned, "update", kWanted)};
        }
        const auto all = returned.cast<py::tuple>();
        if (all.size() != 3) {
            throw py::value_error(std::string("update() returns ") + kWanted);
        }
        const auto part = [&](std::size_t k) { return py::object(all[k]); };
        return {.setpoint = taken<Setpoint>(part(0), "update", kWanted),
                .outcome = outcome_named(taken<std::string>(part(1), "update", kWanted)),
                .reason = kept(taken<std::string>(part(2), "update", kWanted))};
    }
};

class PythonAutopilot final : public PythonStation<Autopilot> {
public:
    explicit PythonAutopilot(py::object object) : PythonStation(std::move(object), "control") {}
    [[nodiscard]] AutopilotOutput control(const AutopilotInput& input,
                                          std::span<double> memory) const override {
        const py::gil_scoped_acquire gil;
        const py::object answer =
            call(memory, input.estimate, input.setpoint, input.vehicle, input.time_s, input.dt_s);
        const std::size_t rotors = input.vehicle.rotor_p_B_m.size();
        const std::string wanted =
            "(thrust, torque) or a command for each of " + std::to_string(rotors) + " rotors";
        const py::tuple returned = py::isinstance<py::str>(answer)
                                       ? py::make_tuple(answer)  // its letters are no commands
                                       : taken<py::tuple>(answer, "control", wanted.c_str());
        const auto number = [&](std::size_t k) {
            return taken<double>(py::object(returned[k]), "control", wanted.c_str());
        };
        if (returned.size() == 2) {
            return {.thrust = number(0), .torque = vector_from(returned[1], "torque")};
        }
        if (returned.size() != rotors) {
            throw py::value_error("control() returns " + wanted);
        }
        AutopilotOutput output;
        output.rotors.emplace(rotors);
        for (std::size_t i = 0; i < rotors; ++i) {
            (*output.rotors)[i] = number(i);
        }
        return output;
    }
};

class PythonCup final : public PythonStation<CupPressure> {
public:
    explicit PythonCup(py::object object) : PythonStation(std::move(object), "next_Pa") {}
    [[nodiscard]] double next_Pa(const CupPressureInput& air,
                                 std::span<double> memory) const override {
        const py::gil_scoped_acquire gil;
        const py::object returned = call(memory, air);
        return taken<double>(returned, "next_Pa", "a pressure in Pa");
    }
};

/// One station for each object: a branch of a flight goes on with the same memory.
template <class Station, class Made>
std::shared_ptr<const Station> station_of(const py::object& object) {
    static std::map<PyObject*, std::weak_ptr<const Station>> known;  // guarded by the GIL
    if (object.is_none()) {
        return nullptr;
    }
    std::erase_if(known, [](const auto& one) { return one.second.expired(); });
    std::weak_ptr<const Station>& last = known[object.ptr()];
    std::shared_ptr<const Station> station = last.lock();
    if (station == nullptr) {
        station = std::make_shared<Made>(object);
        last = station;
    }
    return station;
}

}  // namespace

Stations stations_of(const py::object& guidance, const py::object& autopilot,
                     const py::object& cup) {
    return {.autopilot = station_of<Autopilot, PythonAutopilot>(autopilot),
            .guidance = station_of<Guidance, PythonGuidance>(guidance),
            .cup = station_of<CupPressure, PythonCup>(cup)};
}

Outcome outcome_named(const std::string& name) {
    if (const auto outcome = outcome_from(name)) {
        return *outcome;
    }
    throw py::value_error("\"" + name + "\": no outcome");
}

void add_stations(py::module_& module) {
    py::class_<AutopilotVehicle>(module, "Vehicle", "What an autopilot may know of its vehicle.")
        .def_readonly("mass_kg", &AutopilotVehicle::mass_kg)
        .def_property_readonly(
            "inertia_kg_m2", [](const AutopilotVehicle& v) { return array_of(v.inertia_kg_m2); },
            "diagonal, about B")
        .def_readonly("hover_thrust", &AutopilotVehicle::hover_thrust,
                      "collective that carries the weight, 0..1");
    py::class_<CupPressureInput>(module, "CupAir", "A sealed cup at the beginning of a step.")
        .def_readonly("pressure_Pa", &CupPressureInput::pressure_Pa, "absolute [Pa]")
        .def_readonly("pump_running", &CupPressureInput::pump_running)
        .def_readonly("valve_open", &CupPressureInput::valve_open)
        .def_readonly("press_N", &CupPressureInput::press_N, "on the wall, < 0 pulled off [N]")
        .def_readonly("radius_m", &CupPressureInput::radius_m, "of the sealed area [m]")
        .def_readonly("vacuum_pressure_Pa", &CupPressureInput::vacuum_pressure_Pa,
                      "what pump and surface come to [Pa]")
        .def_readonly("sealing_time_constant_s", &CupPressureInput::sealing_time_constant_s, "[s]")
        .def_readonly("unsealing_time_constant_s", &CupPressureInput::unsealing_time_constant_s,
                      "[s]")
        .def_readonly("dt_s", &CupPressureInput::dt_s, "length of the step [s]")
        .def_readonly("ambient_Pa", &CupPressureInput::ambient_Pa, "of the air around [Pa]")
        .def_readonly("peel_N_m", &CupPressureInput::peel_N_m,
                      "moment that presses one side of the lip more than the other [N m]")
        .def_readonly("hole_mm2", &CupPressureInput::hole_mm2,
                      "to the atmosphere, beyond the leak of the lip [mm^2]")
        .def_readonly("leak_growth", &CupPressureInput::leak_growth,
                      "what the seal leaks more than when it was fresh, over that");
}

}  // namespace limpet::python
