// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "limpet/record/recording.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"
#include "tests/companion/rehearsal.hpp"

// What the simulator flew, told to a companion over its wires: readings and estimates of the
// recording go in, the same decisions must come out. Events may come up to 0.1 s apart: the wire
// carries LiDARs in whole centimetres.

namespace limpet::companion {
namespace {

/// One topic, handed out as time goes on.
class Track {
public:
    Track(const record::Recording& recording, std::string_view topic, double latency_s)
        : table_(recording.table(topic)), latency_s_(latency_s) {}
    /// @return whether there are newer rows by now; the newest is then the current one
    bool advance(double time_s) {
        bool news = false;
        while (next_ < table_.time_s.size() && table_.time_s[next_] + latency_s_ <= time_s + 1e-9) {
            ++next_;
            news = true;
        }
        return news;
    }
    [[nodiscard]] double operator()(std::string_view column) const {
        const record::Column* values = table_.find(column);
        EXPECT_NE(values, nullptr) << column;
        return values->values[next_ - 1];
    }
    [[nodiscard]] bool any() const { return next_ > 0; }

private:
    const record::Table& table_;
    double latency_s_;
    std::size_t next_ = 0;
};

Vector3 position_W(const Track& pose) {
    return record::ros::enu_from_ned(
        {pose("pose.position.x"), pose("pose.position.y"), pose("pose.position.z")});
}

Quaternion attitude_WB(const Track& pose) {
    return record::ros::enu_flu_from_ned_frd(
        {pose("pose.orientation.w"), pose("pose.orientation.x"), pose("pose.orientation.y"),
         pose("pose.orientation.z")});
}

/// A recording's tracks as the companion's outside. Its clock is kLead_s ahead of the flight's.
class Replay {
public:
    static constexpr double kLead_s = 1.0;

    Replay(const record::Recording& recording, const sensors::SensorParameters& sensors,
           const Wires& wires)
        : left_(recording, "/sensors/range_left", sensors.lidar_latency_s),
          right_(recording, "/sensors/range_right", sensors.lidar_latency_s),
          force_(recording, "/sensors/force", 0.0),
          pressure_(recording, "/sensors/cup_pressure", 0.0),
          mocap_(recording, "/sensors/motion_capture", sensors.mocap_latency_s),
          pose_(recording, "/estimate/pose", 0.0),
          twist_(recording, "/estimate/twist", 0.0),
          autopilot_(open_transport(wires.autopilot->transport().address(), wire::Role::connect),
                     {1, 1}),
          sensors_(open_transport(wires.sensors->transport().address(), wire::Role::connect),
                   {1, 25}) {}

    /// @param time_s  of the flight; before 0 its first instant, still on the ground
    void tell(double time_s) {
        hear();
        mavlink::Heartbeat beat;
        beat.type = 2;
        beat.autopilot = 12;
        beat.base_mode =
            armed_ ? std::uint8_t{mavlink::MavModeFlag::safety_armed} : std::uint8_t{0};
        beat.custom_mode = 6U << 16U;
        (void)autopilot_.send(beat);
        mavlink::ExtendedSysState state;
        state.landed_state = time_s >= -1e-9 ? 2 : 1;
        (void)autopilot_.send(state);
        tell_estimate(std::max(time_s, 0.02));
        tell_readings(std::max(time_s, 0.02), time_s < 0.0);
    }

private:
    void hear() {
        while (const auto frame = autopilot_.receive()) {
            const auto command = mavlink::decode<mavlink::CommandLong>(*frame);
            if (command && command->command == mavlink::MavCmd::component_arm_disarm) {
                armed_ = command->param1 > 0.5F;
            }
        }
        while (const auto frame = sensors_.receive()) {
            const auto command = mavlink::decode<mavlink::CommandLong>(*frame);
            if (command && mavlink::mechanism_command(*command, {})) {
                mavlink::CommandAck ack;
                ack.command = command->command;
                (void)sensors_.send(ack);
            }
        }
    }

    void tell_estimate(double time_s) {
        (void)pose_.advance(time_s);
        (void)twist_.advance(time_s);
        Estimate estimate;
        estimate.p_WB_m = position_W(pose_);
        estimate.q_WB = attitude_WB(pose_);
        const Vector3 v_B = record::ros::flu_from_frd(
            {twist_("twist.linear.x"), twist_("twist.linear.y"), twist_("twist.linear.z")});
        estimate.v_WB_m_s = estimate.q_WB * v_B;
        estimate.w_WB_B_rad_s = record::ros::flu_from_frd(
            {twist_("twist.angular.x"), twist_("twist.angular.y"), twist_("twist.angular.z")});
        estimate.valid = true;
        (void)autopilot_.send(mavlink::odometry(estimate, 1));
    }

    /// @param all  again, though nothing is new
    void tell_readings(double time_s, bool all) {
        const auto range = [&](Track& track, std::uint8_t id) {
            if ((track.advance(time_s) || all) && track.any()) {
                const double distance_m = track("range");
                (void)sensors_.send(mavlink::distance_sensor(
                    {.distance_m = distance_m, .valid = std::isfinite(distance_m)}, id, 0.1, 12.0,
                    0));
            }
        };
        range(left_, 0);
        range(right_, 1);
        const auto named = [&](Track& track, std::string_view column, std::string_view name,
                               double scale) {
            if (track.advance(time_s) || all) {
                mavlink::NamedValueFloat message;
                mavlink::set_text(message.name, name);
                message.value = static_cast<float>(scale * track(column));
                (void)sensors_.send(message);
            }
        };
        named(force_, "wrench.force.x", mavlink::kForceName, 1.0);
        named(pressure_, "fluid_pressure", mavlink::kPressureName, 0.01);
        if ((mocap_.advance(time_s) || all) && mocap_.any()) {
            (void)sensors_.send(mavlink::odometry(
                PoseReading{.p_WB_m = position_W(mocap_), .q_WB = attitude_WB(mocap_)}, 1));
        }
    }

    Track left_, right_, force_, pressure_, mocap_, pose_, twist_;
    mavlink::Link autopilot_;
    mavlink::Link sensors_;
    bool armed_ = true;
};

CompanionResult replayed(const record::Recording& recording, const scenario::Scenario& scenario) {
    CompanionConfig config = rehearsal_config({"autopilot.asks_for_mode=false"});
    config.guidance = scenario.guidance;
    Wires wires = open_wires(config);
    Replay replay(recording, scenario.sensors, wires);
    Companion companion(config, wires, nullptr, false, {});
    for (int k = 0; k < 50 * 120 && !companion.over(); ++k) {
        const double time_s = 0.02 * k - Replay::kLead_s;
        replay.tell(time_s);
        companion.tick(time_s + Replay::kLead_s, 0.0, false);
    }
    EXPECT_TRUE(companion.over());
    return companion.result();
}

TEST(Replay, OfASimulatedFlightGivesTheSameDecisions) {
    for (const char* name : {"perch_concrete", "perch_metal_valve", "failed_perch"}) {
        const scenario::Scenario scenario =
            scenario::load_scenario(name, {.data_root = LIMPET_SOURCE_DIR "/data"});
        const std::filesystem::path file =
            std::filesystem::path(testing::TempDir()) / (std::string("replay_") + name + ".mcap");
        const simulation::FlightResult flown =
            simulation::fly(simulation::build_model(scenario), file);
        const CompanionResult result = replayed(record::read_recording(file), scenario);
        std::filesystem::remove(file);
        EXPECT_EQ(result.end, CompanionEnd::mission_over) << name << ": " << result.reason;
        EXPECT_EQ(result.outcome, flown.outcome) << name;
        EXPECT_EQ(result.reason, flown.reason) << name;
        EXPECT_EQ(result.attempts, flown.attempts) << name;
        std::vector<Event> expected;
        for (const Event& event : flown.events) {
            if (event.station == "guidance") {
                expected.push_back(event);
            }
        }
        ASSERT_EQ(result.events.size(), expected.size()) << name;
        for (std::size_t k = 0; k < expected.size(); ++k) {
            EXPECT_EQ(result.events[k].name, expected[k].name) << name << ", event " << k;
            EXPECT_EQ(result.events[k].reason, expected[k].reason) << name;
            EXPECT_NEAR(result.events[k].time_s - Replay::kLead_s, expected[k].time_s, 0.1)
                << name << ": " << to_string(expected[k].name);
        }
    }
}

}  // namespace
}  // namespace limpet::companion
