// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <boost/coroutine2/coroutine.hpp>
#include <exception>
#include <filesystem>
#include <functional>
#include <gazebo/physics/physics.hh>
#include <memory>
#include <optional>

#include "adapters/gazebo/gazebo_plant.hpp"
#include "limpet/live/live_flight.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::gazebo11 {

/// What is flown, and how; see FlightConduct.
struct HostedFlight {
    scenario::Scenario scenario;
    std::filesystem::path recording;  ///< empty: none
    simulation::FlightConduct conduct;
    simulation::FlightWatch watch;
    live::LiveFlight* live = nullptr;  ///< shows it to viewers; null: nobody watches
};

/// Of the flights of one server: flight.mcap, flight-2.mcap, ...
/// @param flight  from 1
[[nodiscard]] std::filesystem::path flight_file(const std::filesystem::path& file, int flight);

/// fly(), turned inside out: Gazebo owns the loop, so the flight is a coroutine that runs from one
/// world update to the next. It is the same code, down to the recording, as in `limpet fly`; only
/// the plant is another. All calls come from Gazebo's physics thread.
class FlightHost {
public:
    /// @throws InputError where world and scenario differ, see GazeboModel
    FlightHost(gazebo::physics::ModelPtr vehicle, HostedFlight flight);

    /// At the beginning of a world update: flies on to the next step of the plant.
    /// @throws what fly() throws
    void update();
    /// The world was reset: a flight that is under way ends where it is, its recording whole, and
    /// another begins at the next update, with a recording next to it.
    void restart();

    /// Ends a flight that is under way where it is, its recording whole; Gazebo steps no more.
    void interrupt();
    /// How many there were, with this one.
    [[nodiscard]] int flights() const { return flights_; }
    [[nodiscard]] bool under_way() const { return coroutine_ != nullptr && *coroutine_; }

    /// @return nullptr until it is over
    [[nodiscard]] const simulation::FlightResult* result() const {
        return result_ ? &*result_ : nullptr;
    }

private:
    using Coroutine = boost::coroutines2::coroutine<void>;

    /// @return false: it steps no more
    bool wait_for_gazebo();
    void run(Coroutine::push_type& to_gazebo);

    HostedFlight flight_;
    std::shared_ptr<const simulation::FlightModel> model_;
    Coroutine::push_type* to_gazebo_ = nullptr;
    std::atomic<bool> interrupted_{false};
    int flights_ = 1;
    std::optional<simulation::FlightResult> result_;
    std::exception_ptr failure_;
    std::unique_ptr<Coroutine::pull_type> coroutine_;  ///< last: unwinds what uses the others
};

}  // namespace limpet::gazebo11
