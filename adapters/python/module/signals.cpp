// SPDX-License-Identifier: Apache-2.0
#include "limpet/signals.hpp"

#include <pybind11/stl.h>

#include <cmath>

#include "module.hpp"

namespace limpet::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// @return empty: there are none in it
/// @throws py::error_already_set what is not about them: Ctrl-C comes at any time
Numbers array_from(const py::handle& given) {
    try {
        return Numbers(py::reinterpret_borrow<py::object>(given));
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) {
            throw;
        }
        return {};
    }
}

std::vector<double> numbers_from(const py::handle& given, std::size_t count, const char* what) {
    const Numbers array = array_from(given);
    if (static_cast<std::size_t>(array.size()) != count) {
        throw py::value_error(std::string(what) + ": " + std::to_string(count) + " numbers");
    }
    const std::vector<double> numbers(array.data(), array.data() + count);
    for (const double number : numbers) {
        if (!std::isfinite(number)) {
            throw py::value_error(std::string(what) + ": finite numbers");
        }
    }
    return numbers;
}

double finite(double number, const char* what) {
    if (!std::isfinite(number)) {
        throw py::value_error(std::string(what) + ": a finite number");
    }
    return number;
}

/// A member as numpy has it.
template <class Owner, class Value>
auto as_array(Value Owner::*member) {
    return [member](const Owner& owner) { return array_of(owner.*member); };
}

template <class Owner>
auto euler_of(Quaternion Owner::*attitude) {
    return [attitude](const Owner& owner) {
        const Euler e = euler_from_quaternion(owner.*attitude);
        return array_of(Vector3(e.roll_rad, e.pitch_rad, e.yaw_rad));
    };
}

void add_truth(py::module_& module) {
    py::class_<Kinematics>(module, "Kinematics",
                           "Where a body's frame F is and how it moves, seen from the world W "
                           "(north, east, down).")
        .def_property_readonly("p_WF_m", as_array(&Kinematics::p_WF_m), "position [m]")
        .def_property_readonly("q_WF", as_array(&Kinematics::q_WF),
                               "attitude, unit quaternion w, x, y, z")
        .def_property_readonly("v_WF_W_m_s", as_array(&Kinematics::v_WF_W_m_s),
                               "velocity in W [m/s]")
        .def_property_readonly("w_WF_F_rad_s", as_array(&Kinematics::w_WF_F_rad_s),
                               "angular velocity in F [rad/s]")
        .def_property_readonly("euler_rad", euler_of(&Kinematics::q_WF), "roll, pitch, yaw [rad]");
    py::class_<CupStatus>(module, "CupStatus", "The true state of the cup.")
        .def_property_readonly(
            "phase", [](const CupStatus& c) { return std::string(to_string(c.phase)); },
            "free, touching, sealing, attached or unsealing")
        .def_readonly("pressure_Pa", &CupStatus::pressure_Pa, "absolute [Pa]")
        .def_readonly("pump_running", &CupStatus::pump_running)
        .def_readonly("valve_open", &CupStatus::valve_open)
        .def_readonly("pull_N", &CupStatus::pull_N, "> 0 pulls the vehicle off, < 0 presses [N]")
        .def_readonly("shear_N", &CupStatus::shear_N, "along the wall [N]")
        .def_readonly("peel_N_m", &CupStatus::peel_N_m, "tilting moment at the lip [N m]")
        .def_readonly("gap_m", &CupStatus::gap_m, "lip to wall, < 0 compressed [m]")
        .def_readonly("pull_margin_N", &CupStatus::pull_margin_N,
                      "what it could pull more before letting go [N]");
    py::class_<Truth>(module, "Truth", "What is really so; a controller must not look at it.")
        .def_readonly("time_s", &Truth::time_s, "[s]")
        .def_readonly("base", &Truth::base, "the vehicle's frame B")
        .def_readonly("cup", &Truth::cup_status, "the cup")
        .def_readonly("cup_motion", &Truth::cup, "the cup's frame C")
        .def_property_readonly(
            "slider_m", [](const Truth& t) { return t.slider.position_m; },
            "0 at the outer stop, < 0 compressed [m]")
        .def_property_readonly(
            "slider_force_N", [](const Truth& t) { return t.slider.force_N; }, "< 0 pressed [N]")
        .def_property_readonly("rotor_speed_rad_s", as_array(&Truth::rotor_speed_rad_s),
                               "of each rotor [rad/s]")
        .def_readonly("thrust_N", &Truth::thrust_N, "of all rotors [N]")
        .def_property_readonly(
            "battery_remaining", [](const Truth& t) { return t.battery.remaining; }, "0..1");
}

void add_estimate(py::module_& module) {
    py::class_<Estimate>(module, "Estimate", "What the autopilot believes of the vehicle.")
        .def_readonly("time_s", &Estimate::time_s, "[s]")
        .def_property_readonly("p_WB_m", as_array(&Estimate::p_WB_m), "position [m]")
        .def_property_readonly("v_WB_m_s", as_array(&Estimate::v_WB_m_s), "velocity [m/s]")
        .def_property_readonly("q_WB", as_array(&Estimate::q_WB), "attitude w, x, y, z")
        .def_property_readonly("w_WB_B_rad_s", as_array(&Estimate::w_WB_B_rad_s),
                               "angular velocity in B [rad/s]")
        .def_property_readonly("euler_rad", euler_of(&Estimate::q_WB), "roll, pitch, yaw [rad]")
        .def_property_readonly("variance", as_array(&Estimate::variance),
                               "of position, velocity, attitude, gyro bias, accelerometer bias")
        .def_readonly("valid", &Estimate::valid);
}

/// A sample's number, or NaN when none ever came.
template <class T, class Of>
auto number_of(Sample<T> Readings::*sample, Of of) {
    return [sample, of](const Readings& readings) {
        return (readings.*sample).ever() ? static_cast<double>(of((readings.*sample).value)) : kNaN;
    };
}

void add_readings(py::module_& module) {
    const auto range = [](const RangeReading& r) { return r.valid ? r.distance_m : kNaN; };
    py::class_<Readings>(module, "Readings",
                         "The latest readings of the sensors; NaN: none yet, or no echo.")
        .def_property_readonly("lidar_left_m", number_of(&Readings::lidar_left, range), "[m]")
        .def_property_readonly("lidar_right_m", number_of(&Readings::lidar_right, range), "[m]")
        .def_property_readonly("force_N",
                               number_of(&Readings::force, [](const auto& f) { return f.axial_N; }),
                               "through the slider, < 0 pressed [N]")
        .def_property_readonly(
            "cup_pressure_Pa",
            number_of(&Readings::cup_pressure, [](const auto& p) { return p.pressure_Pa; }),
            "absolute [Pa]")
        .def_property_readonly(
            "battery_remaining",
            number_of(&Readings::battery, [](const auto& b) { return b.remaining; }), "0..1")
        .def_property_readonly(
            "specific_force_B_m_s2",
            [](const Readings& r) { return array_of(r.imu.value.specific_force_B_m_s2); },
            "of the accelerometers [m/s^2]")
        .def_property_readonly(
            "rate_B_rad_s", [](const Readings& r) { return array_of(r.imu.value.rate_B_rad_s); },
            "of the gyros [rad/s]")
        .def_property_readonly(
            "motion_capture_p_WB_m",
            [](const Readings& r) { return array_of(r.motion_capture.value.p_WB_m); }, "[m]")
        .def_property_readonly(
            "barometer_Pa",
            number_of(&Readings::barometer, [](const auto& b) { return b.pressure_Pa; }),
            "absolute [Pa]")
        .def_property_readonly(
            "field_B_gauss",
            [](const Readings& r) { return array_of(r.magnetometer.value.field_B_gauss); },
            "of the magnetometer [gauss]")
        .def_property_readonly(
            "gps_p_WB_m", [](const Readings& r) { return array_of(r.gps.value.p_WB_m); },
            "in the local world [m]")
        .def_property_readonly(
            "gps_v_WB_m_s", [](const Readings& r) { return array_of(r.gps.value.v_WB_m_s); },
            "[m/s]");
}

Setpoint setpoint(const decltype(Setpoint::motion)& motion, bool pump_on, bool valve_open) {
    return {.motion = motion, .armed = true, .pump_on = pump_on, .valve_open = valve_open};
}

void add_setpoints(py::module_& module) {
    py::class_<Setpoint>(module, "Setpoint",
                         "The commands of guidance to autopilot and perching mechanism.")
        .def_static(
            "position",
            [](const py::object& p_W_m, double yaw_rad, const py::object& v_W_m_s, bool pump_on,
               bool valve_open) {
                return setpoint(
                    PositionSetpoint{vector_from(p_W_m, "p_W_m"), finite(yaw_rad, "yaw_rad"),
                                     vector_from(v_W_m_s, "feedforward_v_W_m_s")},
                    pump_on, valve_open);
            },
            py::arg("p_W_m"), py::arg("yaw_rad") = 0.0,
            py::arg("feedforward_v_W_m_s") = py::make_tuple(0.0, 0.0, 0.0),
            py::arg("pump_on") = false, py::arg("valve_open") = false,
            "Go to p_W_m [m] (north, east, down) with this heading [rad].")
        .def_static(
            "velocity",
            [](const py::object& v_W_m_s, double yaw_rad, bool pump_on, bool valve_open) {
                return setpoint(VelocitySetpoint{vector_from(v_W_m_s, "v_W_m_s"),
                                                 finite(yaw_rad, "yaw_rad"), Vector3::Zero()},
                                pump_on, valve_open);
            },
            py::arg("v_W_m_s"), py::arg("yaw_rad") = 0.0, py::arg("pump_on") = false,
            py::arg("valve_open") = false, "Fly with this velocity [m/s] and heading [rad].")
        .def_static(
            "attitude",
            [](const py::object& q_WB, double thrust, bool pump_on, bool valve_open) {
                return setpoint(
                    AttitudeSetpoint{quaternion_from(q_WB, "q_WB"), finite(thrust, "thrust")},
                    pump_on, valve_open);
            },
            py::arg("q_WB"), py::arg("thrust"), py::arg("pump_on") = false,
            py::arg("valve_open") = false,
            "Hold this attitude (w, x, y, z) with this collective thrust, 0..1.")
        .def_static(
            "idle",
            [](bool armed, bool pump_on, bool valve_open) {
                return Setpoint{.armed = armed, .pump_on = pump_on, .valve_open = valve_open};
            },
            py::arg("armed") = false, py::arg("pump_on") = false, py::arg("valve_open") = false,
            "Motors off, or armed at their idle speed.")
        .def_property_readonly(
            "thrust",
            [](const Setpoint& s) -> std::optional<double> {
                const auto* attitude = std::get_if<AttitudeSetpoint>(&s.motion);
                return attitude == nullptr ? std::nullopt : std::optional(attitude->thrust);
            },
            "collective, 0..1, of a set-point for the attitude, else None")
        .def_readwrite("armed", &Setpoint::armed)
        .def_readwrite("pump_on", &Setpoint::pump_on)
        .def_readwrite("valve_open", &Setpoint::valve_open)
        .def_readwrite("hold_integrators", &Setpoint::hold_integrators,
                       "the vehicle leans on something: integrators must not wind up");
}

void add_event(py::module_& module) {
    py::class_<Event>(module, "Event", "Something that happened in a flight.")
        .def_readonly("time_s", &Event::time_s, "[s]")
        .def_property_readonly("station", [](const Event& e) { return std::string(e.station); })
        .def_property_readonly("name",
                               [](const Event& e) { return std::string(to_string(e.name)); })
        .def_property_readonly("reason", [](const Event& e) { return std::string(e.reason); })
        .def_property_readonly("values",
                               [](const Event& e) {
                                   py::dict values;
                                   for (std::size_t i = 0; i < e.value_count; ++i) {
                                       values[py::str(std::string(e.values[i].name))] =
                                           e.values[i].value;
                                   }
                                   return values;
                               })
        .def("__repr__", [](const Event& e) {
            return "<" + std::string(to_string(e.name)) + " at " + std::to_string(e.time_s) + " s>";
        });
}

}  // namespace

Vector3 vector_from(const py::handle& numbers, const char* what) {
    return Vector3(numbers_from(numbers, 3, what).data());
}

Quaternion quaternion_from(const py::handle& numbers, const char* what) {
    const std::vector<double> q = numbers_from(numbers, 4, what);
    const Quaternion made(q[0], q[1], q[2], q[3]);
    if (!(made.norm() > 1e-6)) {
        throw py::value_error(std::string(what) + ": a quaternion that is not zero");
    }
    return made.normalized();
}

void add_signals(py::module_& module) {
    add_event(module);
    add_truth(module);
    add_estimate(module);
    add_readings(module);
    add_setpoints(module);
}

}  // namespace limpet::python
