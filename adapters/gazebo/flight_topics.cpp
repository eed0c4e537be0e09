// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/flight_topics.hpp"

#include <fmt/format.h>

#include "adapters/gazebo/transport_messages.hpp"
#include "limpet/models/links.hpp"

namespace limpet::gazebo11 {
namespace {

constexpr int kRate_Hz = 50;  ///< as fast as guidance reads them
constexpr int kAgain_Hz = 1;  ///< for a window that was opened meanwhile
/// Slower than this a rotor is seen to stand. Source: limpet/report/moments.cpp.
constexpr double kStanding_rad_s = 20.0;

bool has_visual(gazebo::physics::Link& link, const std::string& name) {
    const sdf::ElementPtr sdf = link.GetSDF();
    for (auto visual = sdf->HasElement("visual") ? sdf->GetElement("visual") : nullptr; visual;
         visual = visual->GetNextElement("visual")) {
        if (visual->Get<std::string>("name") == name) {
            return true;
        }
    }
    return false;
}

gazebo::msgs::Visual part_of(const gazebo::physics::Link& link, const std::string& name) {
    gazebo::msgs::Visual visual;
    visual.set_name(link.GetScopedName() + "::" + name);
    visual.set_parent_name(link.GetScopedName());
    return visual;
}

}  // namespace

FlightTopics::FlightTopics(gazebo::physics::Model& vehicle, const std::string& plugin,
                           const vehicle::Airframe& airframe)
    : node_(new gazebo::transport::Node()) {
    node_->Init(vehicle.GetWorld()->Name());
    const std::string topic = "~/" + name_on_topics(vehicle, plugin) + "/";
    pressure_ = node_->Advertise<gazebo::msgs::Any>(topic + "pressure");
    state_ = node_->Advertise<gazebo::msgs::GzString>(topic + "state");
    guidance_ = node_->Advertise<gazebo::msgs::GzString>(topic + "guidance");
    event_ = node_->Advertise<gazebo::msgs::GzString>(topic + "event");
    visual_ = node_->Advertise<gazebo::msgs::Visual>("~/visual");
    const auto base = vehicle.GetLink(models::called(airframe, "base"));
    for (std::size_t i = 0; base && i < airframe.rotors.size(); ++i) {
        const std::string disc = fmt::format("rotor_{}", i), blade = fmt::format("blade_{}", i);
        // Of a model from CAD they may not be there; to name one would make it.
        if (has_visual(*base, disc) && has_visual(*base, blade)) {
            rotors_.push_back({.disc = part_of(*base, disc), .blade = part_of(*base, blade)});
        }
    }
}

void FlightTopics::tick(const simulation::Flight& flight) {
    const simulation::FlightState& state = flight.state();
    const std::string phase(to_string(state.truth.cup_status.phase));
    const std::string guidance(guidance::to_string(state.guidance.state));
    const bool now = due(state.tick, kRate_Hz);
    if (now || phase != shown_state_) {
        pressure_->Publish(number_message(state.truth.cup_status.pressure_Pa));
        state_->Publish(text_message(phase));
        shown_state_ = phase;
    }
    if (now || guidance != shown_guidance_) {
        guidance_->Publish(text_message(guidance));
        shown_guidance_ = guidance;
    }
    if (now) {
        show_rotors(state.truth, due(state.tick, kAgain_Hz));
    }
}

void FlightTopics::publish(const Event& event) {
    event_->Publish(text_message(fmt::format("{:.3f} {} {}: {}", event.time_s, event.station,
                                             to_string(event.name), event.reason)));
}

void FlightTopics::show_rotors(const Truth& truth, bool anew) {
    for (std::size_t i = 0; i < std::min(rotors_.size(), truth.rotor_speed_rad_s.size()); ++i) {
        Rotor& rotor = rotors_[i];
        const bool turns = truth.rotor_speed_rad_s[i] > kStanding_rad_s;
        if (anew || rotor.turns != turns) {
            rotor.turns = turns;
            rotor.disc.set_visible(turns);
            rotor.blade.set_visible(!turns);
            visual_->Publish(rotor.disc);
            visual_->Publish(rotor.blade);
        }
    }
}

}  // namespace limpet::gazebo11
