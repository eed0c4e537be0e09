// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/ros/src/ros_vehicle.hpp"
#include "adapters/ros/src/setup.hpp"
#include "limpet/record/message_sink.hpp"
#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/flight_log.hpp"
#include "limpet/simulation/pace.hpp"

namespace limpet::ros {

/// Numbered as simulation_interfaces/SimulationState.
enum class SimulatorState : std::uint8_t {
    stopped,   ///< at the flight's start, before its first tick
    playing,   ///< at the pace of `speed`
    paused,    ///< between two ticks
    quitting,  ///< nothing more will happen
    no_world,  ///< there is no flight
};

struct SimulatorOptions {
    RosVehicleOptions vehicle;
    double speed = 1.0;  ///< times real time
    /// It begins stopped, and a flight that has ended is paused there; else it plays at once and
    /// quits with its flight.
    bool stopped = false;
    std::filesystem::path recording;  ///< of the first flight, others next to it; empty: none
};

/// How a step of many ticks goes on.
struct Stepping {
    std::uint64_t done = 0, left = 0;
    std::string obstacle{};  ///< why it ended before its time
};

/// One flight after another of a vehicle with ROS at its boundary, and what may be done with them
/// from outside: play, pause, step, begin anew, fly something else, be put somewhere. One thread
/// calls. A call that fails returns the reason and changes nothing.
class Simulator {
public:
    /// @param seen  takes what a recording takes; may be null
    /// @throws InputError for a flight that cannot be had
    Simulator(const SimulatorOptions& options, const SetupArguments& flight,
              record::MessageSink* seen);
    ~Simulator();

    [[nodiscard]] SimulatorState state() const { return state_; }
    /// What is flown; null without a world. Until the next word.
    [[nodiscard]] const simulation::Flight* flight() const { return flight_.get(); }
    /// What the flight was made of.
    [[nodiscard]] const SetupArguments& flown() const { return arguments_; }
    /// Of the vehicle over the last tick, linear and angular, in W [m/s^2, rad/s^2]; zero where
    /// there was none since it was put somewhere.
    struct Acceleration {
        Vector3 linear_W = Vector3::Zero(), angular_W = Vector3::Zero();
    };
    [[nodiscard]] Acceleration acceleration() const;
    /// Time on /clock of the flight's state.
    [[nodiscard]] double clock_s() const;

    // Words. What they return is why not; empty: it is done.

    [[nodiscard]] std::string play();
    [[nodiscard]] std::string pause();
    /// The flight begins anew, as if the node had been started again; played on where it played.
    [[nodiscard]] std::string reset();
    /// That, and waits before its first tick.
    [[nodiscard]] std::string stop();
    void quit() { state_ = SimulatorState::quitting; }
    /// From now on this is flown; stopped.
    /// @throws InputError for a flight that cannot be had
    void load(const SetupArguments& flight);
    void unload();
    /// Ticks of 1 ms while paused, as fast as they go.
    /// @param report  after each, and once more where it ends before its time
    [[nodiscard]] std::string step(std::uint64_t ticks,
                                   std::function<void(const Stepping&)> report);
    /// Of a step that goes on; its report() is called.
    void give_up_stepping(const std::string& why);
    /// Puts the vehicle there, so moving, at this instant; its autopilot knows it. Not while the
    /// cup holds, nor into wall or ground.
    [[nodiscard]] std::string place(const Kinematics& base);

    /// Flies until it quits, or the flight ends and no client is waited for.
    /// @param listen  makes the calls that wait: for so long at most until there are any [s]
    void run(const std::function<void(double patience_s)>& listen);

private:
    void begin();
    void end();
    void tick();
    [[nodiscard]] bool moves() const;

    SimulatorOptions options_;
    record::MessageSink* seen_;
    SetupArguments arguments_;
    std::shared_ptr<const simulation::FlightModel> model_;
    std::unique_ptr<RosVehicle> vehicle_;
    std::unique_ptr<simulation::Flight> flight_;
    std::optional<simulation::FlightLog> log_;
    std::optional<Kinematics> before_;  ///< the last tick
    std::vector<Event> events_;
    int flights_ = 0;
    simulation::Pace pace_;
    SimulatorState state_ = SimulatorState::no_world;
    Stepping stepping_;
    std::function<void(const Stepping&)> report_;
};

}  // namespace limpet::ros
