// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limpet_ros/CommandBool.h>
#include <limpet_ros/CommandLong.h>
#include <limpet_ros/CupState.h>
#include <limpet_ros/MechanismCommand.h>
#include <limpet_ros/PerchingEvent.h>
#include <limpet_ros/PerchingStatus.h>
#include <limpet_ros/SetMode.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "adapters/ros/src/apart_lip.hpp"
#include "adapters/ros/src/convert.hpp"
#include "adapters/ros/src/diagnostics.hpp"
#include "adapters/ros/src/received.hpp"
#include "adapters/ros/src/scene_topics.hpp"
#include "limpet/core/time.hpp"
#include "limpet/scenario/scenario.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet::ros {

struct RosVehicleOptions {
    OffboardManners manners;
    /// The cup's seal and pressure come from suction_cup_node; else the simulator keeps them and
    /// publishes the pressure sensor itself.
    bool cup_by_node = true;
    /// The flight is over when perching_node's mission is; else when its time is.
    bool ends_with_mission = false;
    /// Real time for which the simulation waits for a perching_node that is behind.
    double patience_s = 2.0;

    /// As parameters of vehicle_node and of its plugin.
    [[nodiscard]] std::vector<BoundParameter> rows();
};

/// The clock of a simulator that has one of its own, and others that look at it (Gazebo's world).
/// Called at the first tick of each flight.
struct HostClock {
    /// Of the state that the flight begins with [s].
    std::function<double()> now_s;
    /// Who has it on /clock already; empty: no node.
    std::function<std::string()> publisher;
};

/// A simulated vehicle with ROS at its boundary: /clock, sensors and the autopilot's estimate go
/// out, set-points, pump, valve and the cup's state come in. The same in Gazebo and on the embedded
/// engine. The simulation's thread calls exchange() and step(); what comes in is taken by a thread
/// of its own. Simulated time keeps step with guidance: where perching_node has spoken
/// and is late, exchange() waits for it, so that a busy machine makes a flight slower and not
/// another one.
/// One that does not come within patience_s is gone: it is waited for again once its messages
/// come.
class RosVehicle final : public simulation::ExternalGuidance, public simulation::ExternalCup {
public:
    /// ros::init() has been called.
    /// @param host  where /clock is the simulator's; else it begins at 1 s with each flight
    RosVehicle(const scenario::Scenario& scenario, const RosVehicleOptions& options,
               std::optional<HostClock> host = std::nullopt);
    ~RosVehicle() override;

    /// Guidance, and the cup if it is kept by the node; `this` outlives the flight.
    [[nodiscard]] simulation::Outside outside();
    /// For viewers; after every tick.
    void show(const simulation::Flight& flight);

    void exchange(const Readings& readings, const Estimate& estimate, double time_s,
                  guidance::PerchingMemory& guidance, guidance::EventList& events) override;
    [[nodiscard]] std::string obstacle() const override;
    suction::CupOutput step(const suction::CupModel& model, suction::CupState& state,
                            const suction::Surface& surface, const Kinematics& cup,
                            const suction::CupInput& input, double dt_s) override;

private:
    void keep_step();
    [[nodiscard]] double clock_start_s(double time_s);
    void diagnose();
    void advertise();
    void subscribe();
    [[nodiscard]] ::ros::Time on_clock(double time_s) const;
    template <class T, class Make>
    void send_new(const ::ros::Publisher& to, const Sample<T>& sample, const Sample<T>& last,
                  Make make) const;
    void send_readings(const Readings& readings);
    bool command(limpet_ros::CommandLong::Request& request,
                 limpet_ros::CommandLong::Response& response);
    bool arm(limpet_ros::CommandBool::Request& request,
             limpet_ros::CommandBool::Response& response);
    bool set_mode(limpet_ros::SetMode::Request& request, limpet_ros::SetMode::Response& response);

    RosVehicleOptions options_;
    sensors::SensorParameters sensors_;
    ::ros::NodeHandle node_;
    ::ros::CallbackQueue queue_;
    std::vector<::ros::Subscriber> subscribers_;
    std::vector<::ros::ServiceServer> services_;
    std::optional<::ros::Publisher> clock_out_;  ///< none: another node publishes /clock
    ::ros::Publisher pose_, velocity_, imu_, state_, battery_, left_, right_, force_, pressure_,
        contact_;

    // of the simulation's thread
    std::optional<HostClock> host_;
    Diagnostics diagnostics_;
    std::unique_ptr<SceneTopics> scene_;  ///< from the first tick on
    Tick clock_ = -1;
    double clock_s_ = 0.0;   ///< time on /clock
    double flight_s_ = 0.0;  ///< the flight's own time at this clock
    Readings last_;
    ApartLip lip_;

    mutable std::mutex mutex_;
    std::condition_variable news_;
    Received received_;  ///< shared; by mutex_
    bool waits_ = true;  ///< for a guidance that is behind

    std::unique_ptr<::ros::AsyncSpinner> spinner_;  ///< last: stops before what it calls goes
};

}  // namespace limpet::ros
