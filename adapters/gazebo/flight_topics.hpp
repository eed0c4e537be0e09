// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>
#include <optional>
#include <string>
#include <vector>

#include "limpet/simulation/flight.hpp"

namespace limpet::gazebo11 {

/// A flight on Gazebo's transport, and in its picture: blades where the rotors stand, discs where
/// they turn. Topics and what they carry are those of a cup of its own (SuctionCupPlugin), and
/// guidance's state:
///   ~/MODEL/PLUGIN/pressure  gazebo.msgs.Any, a double [Pa]: of the cup
///   ~/MODEL/PLUGIN/state     gazebo.msgs.GzString: of the cup, free, touching, sealing, attached,
///                            unsealing; also at once when it changes
///   ~/MODEL/PLUGIN/guidance  gazebo.msgs.GzString: pre_positioning, approaching, ...; likewise
///   ~/MODEL/PLUGIN/event     gazebo.msgs.GzString: "TIME STATION NAME: WHY"
class FlightTopics {
public:
    /// @param plugin  its name in <plugin name="...">
    FlightTopics(gazebo::physics::Model& vehicle, const std::string& plugin,
                 const vehicle::Airframe& airframe);
    FlightTopics(const FlightTopics&) = delete;
    FlightTopics& operator=(const FlightTopics&) = delete;
    ~FlightTopics() { node_->Fini(); }

    /// After every tick.
    void tick(const simulation::Flight& flight);
    void publish(const Event& event);

private:
    struct Rotor {
        gazebo::msgs::Visual disc, blade;
        std::optional<bool> turns = {};  ///< as shown; nothing was shown yet
    };
    void show_rotors(const Truth& truth, bool anew);

    gazebo::transport::NodePtr node_;
    gazebo::transport::PublisherPtr pressure_, state_, guidance_, event_, visual_;
    std::vector<Rotor> rotors_;  ///< of those that the model's visuals have
    std::string shown_state_, shown_guidance_;
};

}  // namespace limpet::gazebo11
