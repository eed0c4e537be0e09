// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "limpet/companion/session.hpp"

namespace limpet::companion {

/// A session by request, as the ROS node has it: a puppet's inputs, an autopilot that does as it is
/// asked.
class Session : public testing::Test {
protected:
    Session() : session_(setup(), watch()) {}

    static SessionSetup setup() {
        SessionSetup setup;
        setup.task.take_off = false;
        setup.by_request = setup.asks_for_mode = true;
        setup.watches_motion_capture = false;
        setup.guidance.land_pitch_s = 0.5;
        setup.guidance.rest_s = 1.0;
        setup.guidance.slip_limit_m = 10.0;  // the puppet pitches about itself, not about its cup
        return setup;
    }

    CompanionWatch watch() {
        return {.on_event = [this](const Event& event) { events_.push_back(event.name); },
                .on_line = {}};
    }

    /// What the vehicle is like now, as all sensors tell it.
    void feed() {
        SessionInputs& in = session_.inputs();
        in.pose = {time_s_,
                   {.p_WB_m = p_WB_m_, .q_WB = quaternion_from_euler({.pitch_rad = pitch_rad_})}};
        in.velocity_W_m_s = {time_s_, Vector3::Zero()};
        in.rate_B_rad_s = {time_s_, Vector3::Zero()};
        const RangeReading range{.distance_m = 1.5 - p_WB_m_.x(), .valid = true};
        in.readings.lidar_left = in.readings.lidar_right = {time_s_, range};
        if (force_works_) {
            in.readings.force = {time_s_, {force_N_}};
        }
        in.readings.cup_pressure = {time_s_, {pressure_Pa_}};
        in.readings.battery = {time_s_, {.remaining = 1.0}};
        in.autopilot = {time_s_, word_};
    }
    void run(double duration_s) {
        for (const double end_s = time_s_ + duration_s; time_s_ < end_s - 1e-9; time_s_ += 0.02) {
            if (alive_) {
                feed();
            }
            session_.tick(time_s_);
            if (session_.wanted_mode() == "OFFBOARD") {
                word_.offboard = true;
            } else if (session_.wanted_mode() == "AUTO.LOITER") {
                word_.offboard = false;
            }
            word_.armed = session_.wanted_armed().value_or(word_.armed);
            if (after_tick_) {
                after_tick_();
            }
        }
    }
    /// Through the manoeuvre, by its signs, to a state.
    void run_until(guidance::PerchingState state, double limit_s) {
        const double end_s = time_s_ + limit_s;
        while (session_.memory().state != state && time_s_ < end_s) {
            run(0.02);
        }
        ASSERT_EQ(session_.memory().state, state);
    }
    void perch_until_rest() {
        run(0.5);
        ASSERT_TRUE(session_.perch(time_s_).done);
        run_until(guidance::PerchingState::approaching, 5.0);
        force_N_ = -50.0;
        run_until(guidance::PerchingState::holding, 1.0);
        pressure_Pa_ = 70000.0;
        run_until(guidance::PerchingState::pitching_up, 2.0);
        pitch_rad_ = radians(66.0);
        run_until(guidance::PerchingState::resting, 10.0);
        run(0.1);
    }

    std::function<void()> after_tick_;
    std::vector<EventName> events_;
    PerchingSession session_;
    double time_s_ = 1.0;
    Vector3 p_WB_m_ = Vector3::Zero();
    double pitch_rad_ = 0.0;
    double force_N_ = 0.0;
    double pressure_Pa_ = kAtmosphere_Pa;
    AutopilotWord word_{.connected = true, .armed = true, .offboard = false};
    bool alive_ = true;
    bool force_works_ = true;
};

}  // namespace limpet::companion
