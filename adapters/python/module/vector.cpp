// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>

#include "air.hpp"
#include "channels.hpp"
#include "limpet/limpet.hpp"
#include "module.hpp"

namespace limpet::python {
namespace {

/// Commands the latest set-point that was given.
class GivenSetpoint final : public Guidance {
public:
    [[nodiscard]] GuidanceOutput update(const GuidanceInput& /*input*/,
                                        std::span<double> /*memory*/) const override {
        return {.setpoint = setpoint};
    }
    Setpoint setpoint;
};

/// Many flights that take set-points from outside and step together, on several threads.
/// Nothing of one depends on another.
class Flights {
public:
    Flights(std::size_t count, int jobs, const std::vector<std::string>& channels)
        : seats_(count), jobs_(std::max(1, jobs)) {
        for (const std::string& name : channels) {
            channels_.push_back(&channel_table()[channel_index(name)]);
        }
    }

    /// Another flight at this place.
    void start(std::size_t place, const Scenario& scenario, std::uint32_t run, const Moment* from) {
        Seat& seat = seats_.at(place);
        seat.guidance = std::make_shared<GivenSetpoint>();
        const Stations stations{.guidance = seat.guidance};
        seat.flight.reset();
        if (from != nullptr) {
            seat.flight.emplace(scenario, *from, stations);
        } else {
            seat.flight.emplace(scenario, stations, run);
        }
        seat.guidance->setpoint = seat.flight->setpoint();
    }

    /// @param kind     "velocity": forward, right (of the estimated heading), down [m/s], turn
    /// [rad];
    ///                 "attitude": roll, pitch, turn [rad], thrust 0..1; turns are from the
    ///                 estimated heading
    /// @param numbers  a row a flight: those four, then pump and valve, > 0.5 is on
    void step(const std::string& kind,
              const py::array_t<double, py::array::c_style | py::array::forcecast>& numbers,
              int ticks) {
        if (numbers.ndim() != 2 || numbers.shape(0) != static_cast<py::ssize_t>(seats_.size()) ||
            numbers.shape(1) != 6) {
            throw py::value_error("set-points: an array of (flights, 6)");
        }
        const bool velocity = kind == "velocity";
        if (!velocity && kind != "attitude") {
            throw py::value_error("kind: velocity or attitude");
        }
        for (std::size_t i = 0; i < seats_.size(); ++i) {
            const double* row = numbers.data(static_cast<py::ssize_t>(i), 0);
            if (!std::all_of(row, row + 6, [](double n) { return std::isfinite(n); })) {
                throw py::value_error("set-points: finite numbers");
            }
            seats_[i].set(row, velocity);
        }
        const FlyFreely fly_freely;
        fly(ticks);
    }

    /// A row a flight, a column a channel.
    [[nodiscard]] py::array_t<double> observe() const {
        py::array_t<double> seen({seats_.size(), channels_.size()});
        double* out = seen.mutable_data();
        for (const Seat& seat : seats_) {
            for (const Channel* channel : channels_) {
                *out++ = seat.flight ? channel->of(*seat.flight) : kNaN;
            }
        }
        return seen;
    }
    [[nodiscard]] py::array_t<bool> ended() const {
        py::array_t<bool> ended(static_cast<py::ssize_t>(seats_.size()));
        for (std::size_t i = 0; i < seats_.size(); ++i) {
            ended.mutable_at(i) = !seats_[i].flight || seats_[i].flight->ended();
        }
        return ended;
    }
    [[nodiscard]] std::string outcome(std::size_t place) const {
        const Seat& seat = seats_.at(place);
        return seat.flight && seat.flight->ended()
                   ? std::string(to_string(seat.flight->result().outcome))
                   : std::string();
    }

private:
    struct Seat {
        std::shared_ptr<GivenSetpoint> guidance;
        std::optional<Flight> flight;

        void set(const double* row, bool velocity) {
            if (!flight) {
                return;
            }
            Setpoint& setpoint = guidance->setpoint;
            const double yaw = euler_from_quaternion(flight->estimate().q_WB).yaw_rad;
            if (velocity) {
                const double cos = std::cos(yaw), sin = std::sin(yaw);
                const Vector3 v_W(cos * row[0] - sin * row[1], sin * row[0] + cos * row[1], row[2]);
                setpoint.motion = VelocitySetpoint{v_W, yaw + row[3], Vector3::Zero()};
            } else {
                setpoint.motion =
                    AttitudeSetpoint{quaternion_from_euler({row[0], row[1], yaw + row[2]}),
                                     std::clamp(row[3], 0.0, 1.0)};
            }
            setpoint.armed = true;
            setpoint.pump_on = row[4] > 0.5;
            setpoint.valve_open = row[5] > 0.5;
        }
    };

    void fly(int ticks) {
        std::atomic<std::size_t> next = 0;
        std::mutex mutex;
        std::exception_ptr failed;
        const auto work = [&] {
            try {
                for (std::size_t i = next++; i < seats_.size(); i = next++) {
                    for (int k = 0; seats_[i].flight && k < ticks && !interpreter_ends() &&
                                    seats_[i].flight->tick();
                         ++k) {
                    }
                }
            } catch (...) {
                const std::lock_guard lock(mutex);
                failed = std::current_exception();
            }
        };
        {
            std::vector<std::jthread> others;
            const auto wanted = std::min(static_cast<std::size_t>(jobs_), seats_.size());
            try {
                while (others.size() + 1 < wanted) {
                    others.emplace_back(work);
                }
            } catch (const std::system_error&) {  // no more threads: those there are will do
            } catch (const std::bad_alloc&) {     // nor memory for them
            }
            work();
        }
        if (failed) {
            std::rethrow_exception(failed);
        }
        if (interpreter_ends()) {
            throw InterpreterEnds();
        }
    }

    std::vector<Seat> seats_;
    std::vector<const Channel*> channels_;
    int jobs_;
};

}  // namespace

void add_vector(py::module_& module) {
    py::class_<Flights>(module, "Flights",
                        "Many flights that take set-points and step together. Nothing "
                        "of one depends on another.")
        .def(py::init<std::size_t, int, const std::vector<std::string>&>(), py::arg("count"),
             py::arg("jobs"), py::arg("channels"))
        .def("start", &Flights::start, py::arg("place"), py::arg("scenario"), py::arg("run") = 0,
             py::arg("start") = nullptr, "Another flight at this place.")
        .def("step", &Flights::step, py::arg("kind"), py::arg("setpoints"), py::arg("ticks"),
             "Set-points (flights, 6), kind \"velocity\": forward, right of the estimated heading, "
             "down [m/s], turn from it [rad]; \"attitude\": roll, pitch, turn [rad], thrust 0..1; "
             "then pump and valve, 0 or 1. Each flight then goes on for so many milliseconds.")
        .def("observe", &Flights::observe, "(flights, channels)")
        .def_property_readonly("ended", &Flights::ended)
        .def("outcome", &Flights::outcome, py::arg("place"), "empty: it flies");
}

}  // namespace limpet::python
