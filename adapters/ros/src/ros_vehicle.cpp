// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/ros_vehicle.hpp"

#include <fmt/format.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "adapters/ros/src/topics.hpp"
#include "limpet/mavlink/translate.hpp"
#include "limpet_ros/State.h"

namespace limpet::ros {
namespace {

// Rates at which MAVROS has them from a PX4, or more.
constexpr int kClock_Hz = 250;
constexpr int kEstimate_Hz = 100;
constexpr int kState_Hz = 10;

}  // namespace

std::vector<BoundParameter> RosVehicleOptions::rows() {
    std::vector<BoundParameter> rows = bind(offboard_manners_table(), manners);
    rows.push_back({"cup_by_node", "-", 0.0, 1.0, &cup_by_node,
                    "seal and pressure come from suction_cup_node", "the paper's Figs. 5 and 6"});
    rows.push_back({"ends_with_mission", "-", 0.0, 1.0, &ends_with_mission,
                    "the flight is over when perching_node's mission is", "assumed: it goes on"});
    rows.push_back({"patience_s", "s", 0.0, 60.0, &patience_s,
                    "of real time: so long the simulation waits for a perching_node that is "
                    "behind; 0: never",
                    "assumed: a busy machine's longest pause"});
    return rows;
}

RosVehicle::RosVehicle(const scenario::Scenario& scenario, const RosVehicleOptions& options,
                       std::optional<HostClock> host)
    : options_(options),
      sensors_(scenario.sensors),
      host_(std::move(host)),
      diagnostics_(node_, "vehicle"),
      received_(options.manners, options.ends_with_mission) {
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
    const auto receive = [this](const auto& received) {
        const std::lock_guard lock(mutex_);
        received_.receive(received);
        news_.notify_all();
    };
    const auto target = [receive](const auto& message) {
        if (const auto motion = motion_from(message)) {
            receive(*motion);
        }
    };
    const auto cup = [receive](const limpet_ros::CupState& message) {
        if (phase_from(message)) {
            receive(message);
        }
    };
    subscribers_ = {
        listen<limpet_ros::PositionTarget>(node_, "mavros/setpoint_raw/local", target),
        listen<limpet_ros::AttitudeTarget>(node_, "mavros/setpoint_raw/attitude", target),
        listen<geometry_msgs::PoseStamped>(node_, "mavros/setpoint_position/local", target),
        listen<limpet_ros::MechanismCommand>(node_, "mechanism/command", receive),
        listen<limpet_ros::PerchingStatus>(node_, "perching_node/status", receive),
        listen<limpet_ros::PerchingEvent>(node_, "perching_node/event", receive),
        listen<limpet_ros::CupState>(node_, "cup/state", cup)};
    services_ = {node_.advertiseService("mavros/cmd/arming", &RosVehicle::arm, this),
                 node_.advertiseService("mavros/cmd/command", &RosVehicle::command, this),
                 node_.advertiseService("mavros/set_mode", &RosVehicle::set_mode, this)};
}

bool RosVehicle::arm(limpet_ros::CommandBool::Request& request,
                     limpet_ros::CommandBool::Response& response) {
    response.success = 1;  // and result 0: MAV_RESULT_ACCEPTED
    const std::lock_guard lock(mutex_);
    received_.arm(request.value != 0);
    return true;
}

bool RosVehicle::command(limpet_ros::CommandLong::Request& request,
                         limpet_ros::CommandLong::Response& response) {
    constexpr std::uint8_t kAccepted = 0;  // MAV_RESULT
    constexpr std::uint8_t kUnsupported = 3;
    response.success = request.command == mavlink::MavCmd::component_arm_disarm ? 1 : 0;
    response.result = response.success != 0 ? kAccepted : kUnsupported;
    if (response.success != 0) {
        const std::lock_guard lock(mutex_);
        received_.arm(request.param1 > 0.5F);
    }
    return true;
}

bool RosVehicle::set_mode(limpet_ros::SetMode::Request& request,
                          limpet_ros::SetMode::Response& response) {
    const std::lock_guard lock(mutex_);
    response.mode_sent = received_.choose(request.custom_mode) ? 1 : 0;
    return true;
}

// --- what goes out ------------------------------------------------------------------------------

/// @param time_s  of the flight
::ros::Time RosVehicle::on_clock(double time_s) const {
    return ros_time(clock_s_ - (flight_s_ - time_s));
}

template <class T, class Make>
void RosVehicle::send_new(const ::ros::Publisher& to, const Sample<T>& sample,
                          const Sample<T>& last, Make make) const {
    if (sample.newer_than(last)) {
        send(to, make(sample.value), on_clock(sample.time_s));
    }
}

void RosVehicle::send_readings(const Readings& readings) {
    const auto range_in = [this](std::string_view frame) {
        return [this, frame](const RangeReading& reading) {
            return range_message(reading, frame, sensors_.lidar_range_min_m,
                                 sensors_.lidar_range_max_m);
        };
    };
    const auto& [left, right] = record::kLidarFrames;
    send_new(left_, readings.lidar_left, last_.lidar_left, range_in(left));
    send_new(right_, readings.lidar_right, last_.lidar_right, range_in(right));
    send_new(force_, readings.force, last_.force, force_message);
    send_new(battery_, readings.battery, last_.battery, battery_message);
    if (!options_.cup_by_node) {
        send_new(pressure_, readings.cup_pressure, last_.cup_pressure, pressure_message);
    }
    last_ = readings;
}

void RosVehicle::show(const simulation::Flight& flight) {
    if (scene_ == nullptr) {
        scene_ = std::make_unique<SceneTopics>(node_, flight.model());
    }
    if (due(clock_, kEstimate_Hz)) {
        scene_->show(flight.state().truth, ros_time(clock_s_));
    }
    if (due(clock_, Diagnostics::kRate_Hz)) {
        diagnose();
    }
}

void RosVehicle::diagnose() {
    const std::lock_guard lock(mutex_);
    Diagnosis simulation{.name = "simulation",
                         .message = "in step with perching_node",
                         .values = {{"mode", std::string(received_.mode().mode())},
                                    {"armed", received_.mode().armed() ? "yes" : "no"},
                                    {"flight_s", fmt::format("{:.1f}", flight_s_)}}};
    if (!received_.guidance_received()) {
        simulation.level = Diagnosis::Level::warn;
        simulation.message = "no perching_node sends: holds";
    } else if (!waits_) {
        simulation.level = Diagnosis::Level::error;
        simulation.message =
            fmt::format("perching_node has sent nothing for {:g} s of real time: flown on without",
                        options_.patience_s);
    }
    diagnostics_.publish({simulation}, ros_time(clock_s_));
}

// --- the simulation's calls ---------------------------------------------------------------------

/// Of /clock, at the first tick of a flight. Nodes begin anew by its going back; where it is the
/// simulator's and goes on they do not, and a warning says how they would.
double RosVehicle::clock_start_s(double time_s) {
    const std::string other = host_ && !clock_out_ ? host_->publisher() : "";
    if (!clock_out_ && other.empty()) {
        clock_out_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 1);
    }
    if (!host_) {
        return Received::kClockStart_s;
    }
    const double now_s = host_->now_s() - time_s;
    const bool goes_on = clock_ >= 0 && now_s >= clock_s_;
    if (!other.empty()) {
        ROS_INFO("/clock is that of %s", other.c_str());
        if (goes_on) {
            ROS_WARN(
                "the flight begins anew and /clock goes on, by which the nodes do not know it: "
                "reset "
                "the world's time too (/gazebo/reset_simulation)");
        }
        return now_s;
    }
    return goes_on ? Received::kClockStart_s : now_s;
}

void RosVehicle::exchange(const Readings& readings, const Estimate& estimate, double time_s,
                          guidance::PerchingMemory& guidance, guidance::EventList& events) {
    limpet_ros::State state;
    bool shows_state = false;
    {
        const std::lock_guard lock(mutex_);
        const bool begins = clock_ < 0 || time_s < flight_s_;
        const bool anew = received_.tick(time_s, begins ? clock_start_s(time_s) : 0.0);
        clock_ = received_.clock();
        clock_s_ = received_.clock_s();
        flight_s_ = time_s;
        const bool was_armed = guidance.setpoint.armed;
        const bool lost = received_.take(estimate, guidance, events);
        shows_state = due(clock_, kState_Hz) || lost || was_armed != guidance.setpoint.armed;
        state.armed = received_.mode().armed() ? 1 : 0;
        state.mode = std::string(received_.mode().mode());
        if (anew) {
            lip_ = {};
            last_ = {};
        }
        if (received_.answer()) {
            lip_.receive(*received_.answer());
        }
    }
    if (clock_out_ && due(clock_, kClock_Hz)) {
        rosgraph_msgs::Clock clock;
        clock.clock = ros_time(clock_s_);
        clock_out_->publish(clock);
    }
    send_readings(readings);
    const ::ros::Time now = ros_time(clock_s_);
    if (due(clock_, kEstimate_Hz) && estimate.valid) {
        send(pose_, pose_message(estimate), now);
        send(velocity_, velocity_message(estimate), now);
        send(imu_, imu_message(estimate), now);
    }
    if (shows_state) {
        constexpr std::uint8_t kActive = 4;  // MAV_STATE
        state.connected = state.guided = 1;
        state.system_status = kActive;
        send(state_, state, now);
    }
    keep_step();
}

void RosVehicle::keep_step() {
    std::unique_lock lock(mutex_);
    const auto in_step = [this] { return !received_.guidance_is_behind(); };
    if (in_step()) {
        waits_ = true;
    } else if (waits_) {
        waits_ = news_.wait_for(lock, std::chrono::duration<double>(options_.patience_s), in_step);
    }
}

std::string RosVehicle::obstacle() const {
    const std::lock_guard lock(mutex_);
    return received_.guidance_received() ? "" : "no perching_node sends";
}

suction::CupOutput RosVehicle::step(const suction::CupModel& model, suction::CupState& state,
                                    const suction::Surface& surface, const Kinematics& cup,
                                    const suction::CupInput& input, double /*dt_s*/) {
    const suction::CupOutput output = lip_.step(model, state, surface, cup, input);
    if (const auto report = lip_.take_report()) {
        send(contact_, *report, on_clock(report->header.stamp.toSec()));
    }
    return output;
}

}  // namespace limpet::ros
