// SPDX-License-Identifier: Apache-2.0
#include "ros/src/ros_vehicle.hpp"

#include <rosgraph_msgs/Clock.h>

#include <algorithm>

#include "limpet/mavlink/translate.hpp"
#include "limpet_ros/State.h"

namespace limpet::ros {
namespace {

// Rates at which MAVROS has them from a PX4, or more.
constexpr int kClock_Hz = 250;
constexpr int kEstimate_Hz = 100;
constexpr int kState_Hz = 10;
constexpr std::uint32_t kQueue = 1000;  ///< nothing is to be lost on one machine

}  // namespace

RosVehicle::RosVehicle(const scenario::Scenario& scenario, const RosVehicleOptions& options)
    : options_(options),
      sensors_(scenario.sensors),
      heard_(options.manners, options.ends_with_mission) {
    node_.setCallbackQueue(&queue_);
    advertise();
    subscribe();
    spinner_ = std::make_unique<::ros::AsyncSpinner>(1, &queue_);
    spinner_->start();
}

RosVehicle::~RosVehicle() {
    spinner_->stop();
}

simulation::Outside RosVehicle::outside() {
    return {.guidance = this, .cup = options_.cup_by_node ? this : nullptr};
}

void RosVehicle::advertise() {
    clock_out_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 1);
    pose_ = node_.advertise<geometry_msgs::PoseStamped>("mavros/local_position/pose", kQueue);
    velocity_ = node_.advertise<geometry_msgs::TwistStamped>("mavros/local_position/velocity_local",
                                                             kQueue);
    imu_ = node_.advertise<sensor_msgs::Imu>("mavros/imu/data", kQueue);
    state_ = node_.advertise<limpet_ros::State>("mavros/state", kQueue, true);
    battery_ = node_.advertise<sensor_msgs::BatteryState>("mavros/battery", kQueue);
    left_ = node_.advertise<sensor_msgs::Range>("lidar/left", kQueue);
    right_ = node_.advertise<sensor_msgs::Range>("lidar/right", kQueue);
    force_ = node_.advertise<geometry_msgs::WrenchStamped>("cup/force", kQueue);
    if (options_.cup_by_node) {
        contact_ = node_.advertise<limpet_ros::CupContact>("cup/contact", kQueue);
    } else {
        pressure_ = node_.advertise<sensor_msgs::FluidPressure>("cup/pressure", kQueue);
    }
}

void RosVehicle::subscribe() {
    // Small messages, each of which counts at once: none may wait for the next.
    const auto hints = ::ros::TransportHints().tcpNoDelay();
    const auto hear = [&](auto message, const char* topic, auto&& call) {
        using Message = decltype(message);
        const boost::function<void(const Message&)> function = call;
        subscribers_.push_back(node_.subscribe<Message>(
            topic, kQueue,
            boost::function<void(const boost::shared_ptr<const Message>&)>(
                [function](const boost::shared_ptr<const Message>& m) { function(*m); }),
            ::ros::VoidConstPtr(), hints));
    };
    const auto hear_target = [this](const auto& m) { hear_motion(motion_from(m)); };
    hear(limpet_ros::PositionTarget(), "mavros/setpoint_raw/local", hear_target);
    hear(limpet_ros::AttitudeTarget(), "mavros/setpoint_raw/attitude", hear_target);
    hear(geometry_msgs::PoseStamped(), "mavros/setpoint_position/local", hear_target);
    hear(limpet_ros::MechanismCommand(), "mechanism/command",
         [this](const limpet_ros::MechanismCommand& m) {
             const std::lock_guard lock(mutex_);
             heard_.hear(m);
         });
    hear(limpet_ros::PerchingStatus(), "perching_node/status",
         [this](const limpet_ros::PerchingStatus& m) {
             const std::lock_guard lock(mutex_);
             heard_.hear(m);
         });
    hear(limpet_ros::PerchingEvent(), "perching_node/event",
         [this](const limpet_ros::PerchingEvent& m) {
             const std::lock_guard lock(mutex_);
             heard_.hear(m);
         });
    hear(limpet_ros::CupState(), "cup/state",
         [this](const limpet_ros::CupState& m) { hear_cup(m); });
    services_.push_back(node_.advertiseService("mavros/cmd/command", &RosVehicle::command, this));
    services_.push_back(node_.advertiseService("mavros/set_mode", &RosVehicle::set_mode, this));
}

// --- what comes in ------------------------------------------------------------------------------

void RosVehicle::hear_motion(const std::optional<Motion>& motion) {
    if (motion) {
        const std::lock_guard lock(mutex_);
        heard_.hear(*motion);
    }
}

void RosVehicle::hear_cup(const limpet_ros::CupState& message) {
    const auto phase = phase_from(message);
    if (!phase) {
        return;
    }
    const std::lock_guard lock(mutex_);
    heard_.hear(LipAnswer{.contact = message.contact,
                          .phase = *phase,
                          .pressure_Pa = message.pressure_Pa,
                          .mean_pressure_Pa = message.mean_pressure_Pa,
                          .seal_threshold_N = message.seal_threshold_N,
                          .pump_running = message.pump_running != 0,
                          .valve_open = message.valve_open != 0},
                message.header.stamp.toSec());
}

bool RosVehicle::command(limpet_ros::CommandLong::Request& request,
                         limpet_ros::CommandLong::Response& response) {
    constexpr std::uint8_t kAccepted = 0;  // MAV_RESULT
    constexpr std::uint8_t kUnsupported = 3;
    response.success = request.command == mavlink::kCommandArm ? 1 : 0;
    response.result = response.success != 0 ? kAccepted : kUnsupported;
    if (response.success != 0) {
        const std::lock_guard lock(mutex_);
        heard_.arm(request.param1 > 0.5F);
    }
    return true;
}

bool RosVehicle::set_mode(limpet_ros::SetMode::Request& request,
                          limpet_ros::SetMode::Response& response) {
    const std::lock_guard lock(mutex_);
    response.mode_sent = heard_.choose(request.custom_mode) ? 1 : 0;
    return true;
}

// --- what goes out ------------------------------------------------------------------------------

/// @param time_s  of the flight
template <class Message>
void RosVehicle::send(::ros::Publisher& to, Message message, double time_s) {
    message.header.stamp = ros_time(clock_s_ - (flight_s_ - time_s));
    to.publish(message);
}

template <class T, class Make>
void RosVehicle::send_new(::ros::Publisher& to, const Sample<T>& sample, const Sample<T>& last,
                          Make make) {
    if (sample.newer_than(last)) {
        send(to, make(sample.value), sample.time_s);
    }
}

void RosVehicle::send_readings(const Readings& readings) {
    const auto range = [this](const RangeReading& reading) {
        return range_message(reading, sensors_.lidar_range_min_m, sensors_.lidar_range_max_m);
    };
    send_new(left_, readings.lidar_left, last_.lidar_left, range);
    send_new(right_, readings.lidar_right, last_.lidar_right, range);
    send_new(force_, readings.force, last_.force, force_message);
    send_new(battery_, readings.battery, last_.battery, battery_message);
    if (!options_.cup_by_node) {
        send_new(pressure_, readings.cup_pressure, last_.cup_pressure, pressure_message);
    }
    last_ = readings;
}

void RosVehicle::send_estimate(const Estimate& estimate) {
    if (due(clock_, kEstimate_Hz) && estimate.valid) {
        send(pose_, pose_message(estimate), flight_s_);
        send(velocity_, velocity_message(estimate), flight_s_);
        send(imu_, imu_message(estimate), flight_s_);
    }
}

// --- the simulation's calls ---------------------------------------------------------------------

void RosVehicle::exchange(const Readings& readings, const Estimate& estimate, double time_s,
                          guidance::PerchingMemory& guidance, guidance::EventList& events) {
    limpet_ros::State state;
    bool shows_state = false;
    {
        const std::lock_guard lock(mutex_);
        const bool anew = heard_.tick(time_s);
        clock_ = heard_.clock();
        clock_s_ = heard_.clock_s();
        flight_s_ = time_s;
        const bool was_armed = guidance.setpoint.armed;
        const bool lost = heard_.take(estimate, guidance, events);
        shows_state = due(clock_, kState_Hz) || lost || was_armed != guidance.setpoint.armed;
        state.armed = heard_.mode().armed() ? 1 : 0;
        state.mode = std::string(heard_.mode().mode());
        if (anew) {
            lip_ = {};
            last_ = {};
        }
        if (heard_.answer()) {
            lip_.hear(*heard_.answer());
        }
    }
    if (due(clock_, kClock_Hz)) {
        rosgraph_msgs::Clock clock;
        clock.clock = ros_time(clock_s_);
        clock_out_.publish(clock);
    }
    send_readings(readings);
    send_estimate(estimate);
    if (shows_state) {
        constexpr std::uint8_t kActive = 4;  // MAV_STATE
        state.connected = state.guided = 1;
        state.system_status = kActive;
        send(state_, state, time_s);
    }
}

std::string RosVehicle::obstacle() const {
    const std::lock_guard lock(mutex_);
    return heard_.guidance_heard() ? "" : "no perching_node is heard";
}

suction::CupOutput RosVehicle::step(const suction::CupModel& model, suction::CupState& state,
                                    const suction::Surface& surface, const Kinematics& cup,
                                    const suction::CupInput& input, double /*dt_s*/) {
    const suction::CupOutput output = lip_.step(model, state, surface, cup, input);
    if (const auto report = lip_.take_report()) {
        limpet_ros::CupContact message = contact_message(report->contact);
        message.number = report->number;
        message.touch = report->touch;
        message.press_N = report->press_N;
        send(contact_, message, report->time_s);
    }
    return output;
}

}  // namespace limpet::ros
