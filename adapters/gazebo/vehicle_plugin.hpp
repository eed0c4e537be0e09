// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <gazebo/common/Events.hh>
#include <gazebo/common/Plugin.hh>
#include <memory>
#include <string_view>
#include <thread>
#include <vector>

#include "adapters/gazebo/flight_host.hpp"
#include "adapters/gazebo/flight_topics.hpp"
#include "adapters/gazebo/vehicle_options.hpp"

namespace limpet::gazebo11 {

/// LimpetVehiclePlugin: a model plugin that flies a scenario with Gazebo's bodies. Rotors, battery,
/// air, cup, sensors, autopilot and guidance are those of `limpet fly`, the same object code; the
/// engine is ODE, one world update a step. What the loop reads comes from bodies, joints and
/// physics rays in the world update: Gazebo's own sensors lose their rates at full speed.
///
///   element    what                                                           default
///   scenario   name (limpet list scenarios) or YAML file: vehicle, wall, start,
///              everything. The world must agree with it; `limpet export SCENARIO
///              --format world` writes one that does
///   set        KEY=VALUE as `limpet fly --set`; may stand more than once
///   seed       of every random number                                         the scenario's
///   autopilot  builtin, or px4: a real one in the loop                        builtin
///   hil        px4's simulator link, tcp:HOST:PORT or serial:DEVICE:BAUD      tcp:127.0.0.1:4560
///   offboard   where px4's onboard link comes in                              udp:127.0.0.1:14540
///   wait_s     longest wait for a px4 [s]                                     60
///   speed      times real time; 0: as fast as it goes. 1 alone with a px4 on
///              a serial wire, which has a clock of its own                    0, watched 1
///   live       port where Foxglove and Lichtblick may watch (docs/live.md);
///              0: any that is free, printed                                   nobody may
///   recording  MCAP file to write                                             none
///   result     JSON file to write when the flight is over                     none
///   when_over  pause the world, or quit the server                            pause
///
/// Its state is published on Gazebo's transport, see FlightTopics. The environment overrides each:
/// LIMPET_SCENARIO, LIMPET_SET (parts between semicolons), LIMPET_SPEED, ... What cannot be used
/// stops the server with one line and exit code 2. The world's own real_time_update_rate is set
/// aside. A world reset begins the flight anew. One vehicle flies in a gzserver.
class VehiclePlugin : public gazebo::ModelPlugin {
public:
    ~VehiclePlugin() override;

    void Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) override;
    void Reset() override;

protected:
    /// For plugins that put other stations in their place (ROS).
    /// @return further elements that they read themselves
    [[nodiscard]] virtual std::vector<std::string_view> more_elements() const { return {}; }
    /// Before the flight is made.
    /// @param parameters  all elements
    /// @param flight      may be given stations from outside and a watch
    virtual void prepare(const scenario::YamlNode& /*parameters*/, HostedFlight& /*flight*/) {}
    /// From prepare() on.
    [[nodiscard]] gazebo::physics::World& world() const { return *world_; }
    /// Ends a flight that is under way, its recording whole. Whoever gives stations in prepare()
    /// calls it in its destructor: the flight goes on to the end of its tick and uses them.
    void end_flight() noexcept;

private:
    void configure(gazebo::physics::ModelPtr model, const sdf::ElementPtr& sdf);
    void update();
    void end();
    void watch_world();

    VehicleOptions options_;
    gazebo::physics::WorldPtr world_;
    std::atomic<bool> stop_{false};  ///< the world is to stop: waits for a PX4 or a viewer are over
    std::atomic<bool> watched_{false};
    std::thread watching_;  ///< of a flight with a PX4 or viewers
    std::unique_ptr<px4::Px4Wires> px4_;
    std::unique_ptr<live::LiveFlight> live_;
    std::unique_ptr<FlightTopics> topics_;
    std::unique_ptr<FlightHost> host_;
    bool reported_ = false;  ///< how it ended
    gazebo::event::ConnectionPtr on_update_;
};

}  // namespace limpet::gazebo11
