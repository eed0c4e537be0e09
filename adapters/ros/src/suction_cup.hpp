// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "limpet/core/time.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/sensors/pressure.hpp"
#include "limpet/suction/cup.hpp"

namespace limpet::ros {

/// What suction_cup_node does, without ROS: seal and pressure of a cup whose lip is felt elsewhere,
/// in the simulator's plugin (the paper's Figs. 5 and 6), and the sensor in it. The same inputs and
/// seed give the same states; the seal's demands are those of the embedded flight of that seed.
class SuctionCup {
public:
    explicit SuctionCup(const scenario::Scenario& scenario);

    void command(bool pump_on, bool valve_open);
    /// The lip at a time; one earlier than the last begins anew.
    /// @return attached, contact_lost, detached
    std::optional<Event> feel(const suction::LipContact& contact, double time_s);

    [[nodiscard]] const suction::CupState& state() const { return state_; }
    /// Of the sensor, at its rate; a new sample has a new time.
    [[nodiscard]] const Sample<PressureReading>& pressure() const { return reading_; }
    [[nodiscard]] bool pump_on() const { return pump_on_; }
    [[nodiscard]] bool valve_open() const { return valve_open_; }

private:
    void start();
    [[nodiscard]] const suction::Surface& surface() const;

    scenario::Scenario scenario_;
    std::vector<suction::Surface> surfaces_;  ///< of the touches, all after the last
    suction::CupState state_;
    sensors::SensorUnit<sensors::PressureSensor> sensor_;
    Sample<PressureReading> reading_;
    bool pump_on_ = false;
    bool valve_open_ = false;
    double last_s_ = -1.0;  ///< < 0: nothing was felt yet
    Tick last_tick_ = -1;
};

}  // namespace limpet::ros
