// SPDX-License-Identifier: Apache-2.0
// Guidance as a ROS node: sensors and the autopilot's estimate in, set-points, pump and valve out;
// perch, take_off and abort by services and as actions. What it does is
// limpet/companion/session.hpp, here are its wires.
#include <fmt/format.h>
#include <limpet_ros/MechanismCommand.h>
#include <limpet_ros/PerchingEvent.h>
#include <limpet_ros/PerchingStatus.h>
#include <limpet_ros/State.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <type_traits>

#include "adapters/ros/src/autopilot_calls.hpp"
#include "adapters/ros/src/convert.hpp"
#include "adapters/ros/src/diagnostics.hpp"
#include "adapters/ros/src/manoeuvre_goal.hpp"
#include "adapters/ros/src/perching_actions.hpp"
#include "adapters/ros/src/setup.hpp"
#include "adapters/ros/src/topics.hpp"
#include "adapters/ros/src/vehicle_mode.hpp"
#include "limpet/companion/session.hpp"
#include "limpet/companion/wires.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::ros {
namespace {

/// When a message was measured: by its stamp, if it has one that has been.
double time_of(const std_msgs::Header& header) {
    const double now_s = ::ros::Time::now().toSec();
    return header.stamp.isZero() ? now_s : std::min(header.stamp.toSec(), now_s);
}

companion::SessionSetup read_setup() {
    const scenario::YamlNode parameters = node_parameters({"asks_for_mode"});
    bool asks_for_mode = false;
    read_given(parameters, "asks_for_mode", asks_for_mode);
    const NodeSetup setup = load_setup(setup_of(parameters));
    const companion::SessionSetup session{
        .task = {.take_off = setup.scenario.mission == scenario::Mission::perch_and_take_off},
        .guidance = setup.scenario.guidance,
        .limits = setup.limits,
        .by_request = true,
        .asks_for_mode = asks_for_mode,
        .watches_motion_capture = false};
    if (setup.scenario.mission == scenario::Mission::hover || !setup.scenario.airframe.has_cup) {
        throw InputError(
            "perching_node: needs a vehicle with a cup and mission perch or "
            "perch_and_take_off");
    }
    return session;
}

Diagnosis diagnosis_of_guidance(const companion::PerchingSession& session) {
    using companion::SessionPhase;
    const bool flies = session.phase() == SessionPhase::flying;
    Diagnosis diagnosis{.name = "guidance"};
    diagnosis.values = {
        {"phase", std::string(to_string(session.phase()))},
        {"state", flies ? std::string(guidance::to_string(session.memory().state)) : ""},
        {"place", std::string(companion::to_string(session.place()))},
        {"outcome", session.outcome() ? std::string(limpet::to_string(*session.outcome())) : ""},
        {"reason", session.reason()}};
    diagnosis.message = diagnosis.values[flies ? 2 : 0].second;
    if (session.phase() == SessionPhase::handed_back) {
        diagnosis.level = session.end() == companion::CompanionEnd::handed_back
                              ? Diagnosis::Level::error
                              : Diagnosis::Level::warn;
        diagnosis.message = "control was handed back: " + session.reason();
    } else if (!session.obstacle().empty()) {
        diagnosis.level = Diagnosis::Level::warn;
        diagnosis.message += ": " + session.obstacle();
    }
    return diagnosis;
}

constexpr double kOld_s = 1.0;
constexpr double kSeldom_s = 3.0;  ///< MAVROS publishes state and battery about once a second

/// How old each input is.
Diagnosis diagnosis_of_inputs(const companion::SessionInputs& in, double now_s) {
    Diagnosis diagnosis{.name = "inputs", .message = "all come"};
    const auto look = [&](const char* name, double measured_s, double old_s = kOld_s) {
        const bool ever = measured_s >= 0.0;
        diagnosis.values.emplace_back(
            std::string(name) + " age_s",
            ever ? fmt::format("{:.3f}", now_s - measured_s) : "never came");
        if (!ever || now_s - measured_s > old_s) {
            const bool first = diagnosis.level == Diagnosis::Level::ok;
            diagnosis.message =
                first ? "do not come: " + std::string(name) : diagnosis.message + ", " + name;
            diagnosis.level = Diagnosis::Level::error;
        }
    };
    look("mavros/state", in.autopilot.time_s, kSeldom_s);
    look("pose", in.pose.time_s);
    look("velocity", in.velocity_W_m_s.time_s);
    look("imu", in.rate_B_rad_s.time_s);
    look("battery", in.readings.battery.time_s, kSeldom_s);
    look("lidar/left", in.readings.lidar_left.time_s);
    look("lidar/right", in.readings.lidar_right.time_s);
    look("cup/force", in.readings.force.time_s);
    look("cup/pressure", in.readings.cup_pressure.time_s);
    return diagnosis;
}

class PerchingNode {
public:
    explicit PerchingNode(const companion::SessionSetup& setup)
        : session_(
              setup,
              {.on_event = [this](const Event& event) { publish(event); },
               .on_line = [](double, const std::string& text) { ROS_INFO("%s", text.c_str()); }}),
          own_("~"),
          calls_(kRetry_s),
          actions_(own_, session_),
          diagnostics_(node_, "perching_node") {
        status_ = own_.advertise<limpet_ros::PerchingStatus>("status", kQueue, true);
        event_ = own_.advertise<limpet_ros::PerchingEvent>("event", kQueue);
        position_ = node_.advertise<limpet_ros::PositionTarget>("mavros/setpoint_raw/local", 1);
        attitude_ = node_.advertise<limpet_ros::AttitudeTarget>("mavros/setpoint_raw/attitude", 1);
        mechanism_ = node_.advertise<limpet_ros::MechanismCommand>("mechanism/command", 1, true);
        subscribe();
        for (const auto manoeuvre : {Manoeuvre::perch, Manoeuvre::take_off, Manoeuvre::abort}) {
            serve(manoeuvre);
        }
        timer_ = node_.createTimer(::ros::Duration(1.0 / setup.limits.guidance_rate_Hz),
                                   [this](const ::ros::TimerEvent&) { tick(); });
        slow_timer_ = node_.createTimer(::ros::Duration(1.0 / Diagnostics::kRate_Hz),
                                        [this](const ::ros::TimerEvent&) { diagnose(); });
    }

private:
    static constexpr double kRetry_s = 0.3;  // as the companion, limpet/mavlink/offboard.hpp

    /// @param put  (message, its time)
    template <class Message, class Put>
    void receive(const std::string& topic, Put put) {
        subscribers_.push_back(
            listen<Message>(node_, topic, [put](const Message& m) { put(m, time_of(m.header)); }));
    }
    /// Into a sample, where the message is sound.
    template <class Message, class T, class Read>
    void read(const std::string& topic, Sample<T>& into, Read convert) {
        receive<Message>(topic, [&into, convert](const Message& message, double time_s) {
            if (const std::optional<T> value = convert(message)) {
                into = {time_s, *value};
            }
        });
    }
    void subscribe() {
        companion::SessionInputs& in = session_.inputs();
        Readings& readings = in.readings;
        receive<limpet_ros::State>("mavros/state",
                                   [&in](const limpet_ros::State& m, double time_s) {
                                       in.autopilot = {time_s,
                                                       {.connected = m.connected != 0,
                                                        .armed = m.armed != 0,
                                                        .offboard = m.mode == kOffboard}};
                                   });
        using geometry_msgs::PoseStamped;
        using geometry_msgs::TwistStamped;
        using geometry_msgs::WrenchStamped;
        using sensor_msgs::Range;
        read<PoseStamped>("mavros/local_position/pose", in.pose, pose_reading);
        read<TwistStamped>("mavros/local_position/velocity_local", in.velocity_W_m_s, velocity_W);
        read<sensor_msgs::Imu>("mavros/imu/data", in.rate_B_rad_s, rate_B);
        read<Range>("lidar/left", readings.lidar_left, range_reading);
        read<Range>("lidar/right", readings.lidar_right, range_reading);
        read<WrenchStamped>("cup/force", readings.force, force_reading);
        read<sensor_msgs::FluidPressure>("cup/pressure", readings.cup_pressure, pressure_reading);
        read<sensor_msgs::BatteryState>("mavros/battery", readings.battery, battery_reading);
    }
    void serve(Manoeuvre manoeuvre) {
        const std::string name(to_string(manoeuvre));
        using Request = std_srvs::TriggerRequest;
        using Response = std_srvs::TriggerResponse;
        const boost::function<bool(Request&, Response&)> call = [this, manoeuvre, name](
                                                                    Request&, Response& response) {
            const companion::Answer answer =
                request(session_, manoeuvre, ::ros::Time::now().toSec());
            response.success = answer.done ? 1 : 0;
            response.message = answer.message;
            ROS_INFO("%s: %s", name.c_str(), answer.message.c_str());
            return true;
        };
        services_.push_back(own_.advertiseService(name, call));
    }

    void tick() {
        const ::ros::Time now = ::ros::Time::now();
        session_.tick(now.toSec());
        if (session_.streams()) {
            std::visit([&](const auto& target) { steer(target, now); }, session_.setpoint().motion);
        }
        actuate(now);
        calls_.want(std::string(session_.wanted_mode()), session_.wanted_armed());
        publish_status(now);
        actions_.tick(now.toSec());
    }

    template <class Target>
    void steer(const Target& target, const ::ros::Time& now) {
        constexpr bool kAttitude = std::is_same_v<Target, AttitudeSetpoint>;
        send(kAttitude ? attitude_ : position_, target_message(target), now);
    }
    /// Motors idle: the attitude that it has, without thrust. Set-points go on.
    void steer(const IdleSetpoint&, const ::ros::Time& now) {
        steer(AttitudeSetpoint{.q_WB = session_.inputs().pose.value.q_WB, .thrust = 0.0}, now);
    }

    void actuate(const ::ros::Time& now) {
        const Setpoint& setpoint = session_.setpoint();
        if (!session_.drives_mechanism() ||
            !pace_.due({.pump_on = setpoint.pump_on, .valve_open = setpoint.valve_open},
                       session_.setup().limits.mechanism_rate_Hz, now.toSec())) {
            return;
        }
        limpet_ros::MechanismCommand command;
        command.pump_on = setpoint.pump_on ? 1 : 0;
        command.valve_open = setpoint.valve_open ? 1 : 0;
        send(mechanism_, command, now);
    }

    void publish(const Event& event) {
        const limpet_ros::PerchingEvent message = event_message(event);
        ROS_INFO("%s%s%s", message.name.c_str(), message.reason.empty() ? "" : ": ",
                 message.reason.c_str());
        send(event_, message, ::ros::Time::now());
    }
    void publish_status(const ::ros::Time& now) {
        const guidance::PerchingMemory& memory = session_.memory();
        limpet_ros::PerchingStatus status;
        status.phase = std::string(to_string(session_.phase()));
        status.obstacle = session_.obstacle();
        const bool flies = session_.phase() == companion::SessionPhase::flying;
        const guidance::PerchingState state =
            flies ? memory.state : guidance::PerchingState::hovering;
        status.state = static_cast<std::uint8_t>(state);
        status.state_name = std::string(guidance::to_string(state));
        status.state_s = flies ? now.toSec() - memory.since_s : 0.0;
        status.place = std::string(companion::to_string(session_.place()));
        status.attempt = static_cast<std::uint8_t>(std::min(memory.attempt, 255));
        status.armed = session_.setpoint().armed ? 1 : 0;
        status.pump_on = session_.setpoint().pump_on ? 1 : 0;
        status.valve_open = session_.setpoint().valve_open ? 1 : 0;
        status.outcome =
            session_.outcome() ? std::string(limpet::to_string(*session_.outcome())) : "";
        status.reason = session_.reason();
        send(status_, status, now);
    }

    void diagnose() {
        const ::ros::Time now = ::ros::Time::now();
        diagnostics_.publish(
            {diagnosis_of_guidance(session_), diagnosis_of_inputs(session_.inputs(), now.toSec())},
            now);
    }

    companion::PerchingSession session_;
    ::ros::NodeHandle node_;
    ::ros::NodeHandle own_;
    AutopilotCalls calls_;
    PerchingActions actions_;
    Diagnostics diagnostics_;
    ::ros::Publisher status_, event_, position_, attitude_, mechanism_;
    std::vector<::ros::Subscriber> subscribers_;
    std::vector<::ros::ServiceServer> services_;
    ::ros::Timer timer_, slow_timer_;
    companion::MechanismPace pace_;
};

void perching_node() {
    PerchingNode node(read_setup());
    ::ros::spin();
}

}  // namespace
}  // namespace limpet::ros

int main(int argc, char** argv) {
    return limpet::ros::run_node(argc, argv, "perching_node", limpet::ros::perching_node);
}
