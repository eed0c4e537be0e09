// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/autopilot.hpp"
#include "limpet/cup.hpp"
#include "limpet/guidance.hpp"
#include "limpet/plant.hpp"
#include "limpet/scenario.hpp"
#include "limpet/signals.hpp"

namespace limpet {

/// Stations of your own in the loop; those that are null are the scenario's.
struct Stations {
    std::shared_ptr<const Autopilot> autopilot = {};
    std::shared_ptr<const Guidance> guidance = {};
    std::shared_ptr<const CupPressure> cup = {};
    std::shared_ptr<const PlantModel> plant = {};
};

struct Metric {
    std::string name;    ///< with its unit
    double value = 0.0;  ///< NaN: did not come to pass
};

/// How a flight ended.
struct Result {
    Outcome outcome = Outcome::timed_out;
    std::string reason;
    TrueEnd true_end = TrueEnd::moving;  ///< what the truth shows, whatever guidance believed
    bool success = false;                ///< perched or released, and so by the truth
    double simulated_s = 0.0;
    int attempts = 0;  ///< docking runs
    std::vector<Event> events;
    std::vector<Metric> metrics;
    std::uint64_t state_hash = 0;  ///< digest of the trajectory: equal bits, equal hash

    /// @throws InputError naming the nearest when there is none of that name
    [[nodiscard]] double metric(std::string_view name) const;
};

/// A flight at one instant: vehicle, sensors, estimator, guidance, cup, random numbers.
class Moment {
public:
    struct Inside;

private:
    friend class Flight;
    std::shared_ptr<const Inside> inside_;
};

/// One flight. Same scenario, run and stations: the same bits.
///
///     limpet::Flight flight(limpet::load("perch_concrete"));
///     const limpet::Result result = flight.fly();
class Flight {
public:
    /// @param run  of many with the same seed: other random numbers
    /// @throws InputError when no flight can be made of the scenario
    explicit Flight(const Scenario& scenario, const Stations& stations = {}, std::uint32_t run = 0);
    /// A branch: goes on from `from`, with another scenario or other stations if you like. The
    /// vehicle must be the same.
    /// @throws InputError for another number of rotors, mission, mount or engine, or a moment of no
    ///         flight
    Flight(const Scenario& scenario, const Moment& from, const Stations& stations = {});
    ~Flight();
    Flight(Flight&&) noexcept;
    Flight& operator=(Flight&&) noexcept;

    /// Writes all signals from here on into an MCAP file, whole once the flight has ended.
    /// @throws InputError when the file cannot be written
    void record(const std::filesystem::path& file);

    /// The loop to the next instant at which a sensor, guidance or a recording looks at the bodies:
    /// 1 to 4 ms; 1 ms with stations of one's own, or with simulation.longest_step_s = 0.001.
    /// Nothing once the flight has ended.
    /// @return whether it goes on
    bool tick();
    /// To the end: the mission's, a crash, or the scenario's time limit.
    Result fly();

    [[nodiscard]] bool ended() const;
    [[nodiscard]] double time_s() const;
    [[nodiscard]] const Truth& truth() const;
    [[nodiscard]] const Readings& readings() const;
    [[nodiscard]] const Estimate& estimate() const;
    [[nodiscard]] const Setpoint& setpoint() const;
    [[nodiscard]] const RotorCommand& rotors() const;
    /// Of the built-in manoeuvre: "approaching", "resting", ...
    [[nodiscard]] std::string_view phase() const;
    /// Of the last tick.
    [[nodiscard]] std::span<const Event> events() const;
    /// @throws InternalError before it has ended
    [[nodiscard]] Result result() const;

    [[nodiscard]] Moment save() const;

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace limpet
