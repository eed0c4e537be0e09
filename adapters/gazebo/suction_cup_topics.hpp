// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/transport/transport.hh>
#include <mutex>
#include <string>

#include "limpet/core/signals/cup_status.hpp"
#include "limpet/core/signals/event.hpp"

namespace limpet::gazebo11 {

/// Commands to a cup from outside.
struct CupCommands {
    bool pump_on = false;
    bool valve_open = false;
};

/// A cup on Gazebo's transport; described at SuctionCupPlugin. Messages come in on threads of the
/// transport's; commands wait here for the next world update.
class SuctionCupTopics {
public:
    /// @param name          of the cup on topics: MODEL/PLUGIN; one cup has it
    /// @param valve_fitted  else it is refused to open one
    /// @throws InputError when another cup has the name
    SuctionCupTopics(gazebo::physics::WorldPtr world, const std::string& name,
                     const CupCommands& start, bool valve_fitted, double rate_Hz);
    SuctionCupTopics(const SuctionCupTopics&) = delete;
    SuctionCupTopics& operator=(const SuctionCupTopics&) = delete;

    ~SuctionCupTopics();

    [[nodiscard]] CupCommands commands() const;
    void command(const CupCommands& commands);
    /// One of them.
    /// @param what  "pump" or "valve"
    /// @return false for another one, and for a valve to be opened where none is fitted
    [[nodiscard]] bool turn(const std::string& what, bool on);
    /// Back to what they were at the start.
    void reset();
    /// Once a world update: a change of phase at once, pressure and phase at their rate.
    /// @return whether they were published now
    bool publish(const CupStatus& status, double time_s);
    void publish(const Event& event);

private:
    using IntPtr = boost::shared_ptr<const gazebo::msgs::Int>;
    using RequestPtr = boost::shared_ptr<const gazebo::msgs::Request>;
    void on_pump(const IntPtr& message);
    void on_valve(const IntPtr& message);
    void on_request(const RequestPtr& request);
    [[nodiscard]] bool answer(const gazebo::msgs::Request& request, const std::string& what,
                              gazebo::msgs::Response& response);

    const CupCommands start_;
    const bool valve_fitted_;
    const std::string prefix_;  ///< of requests: MODEL/PLUGIN/
    const double period_s_;
    double next_s_ = 0.0;
    mutable std::mutex mutex_;
    CupCommands commands_;
    CupStatus status_;
    gazebo::transport::NodePtr node_;
    gazebo::transport::PublisherPtr pressure_, state_, event_, response_;
    gazebo::transport::SubscriberPtr pump_, valve_, request_;
};

}  // namespace limpet::gazebo11
