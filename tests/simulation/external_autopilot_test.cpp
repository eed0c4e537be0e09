// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <filesystem>

#include "flown.hpp"
#include "limpet/autopilot/builtin.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/simulation/bring_up.hpp"
#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/pace.hpp"

namespace limpet::simulation {
namespace {

using testing::HasSubstr;

/// The built-in autopilot as one from outside: no wire, but a boot, an estimator that begins with
/// what it measures, and, when told to, an end.
class Outsider final : public autopilot::ExternalAutopilot {
public:
    explicit Outsider(const FlightModel& model, double boot_s = 1.0)
        : model_(model.autopilot), boot_s_(boot_s) {}

    /// Fails that long after the vehicle has been armed.
    void fail_after(double armed_s) { fail_after_s_ = armed_s; }

    /// Its position is off by so much, and by half a metre more that wanders in a minute: as GPS.
    void misplace(const Vector3& off_m) { off_m_ = off_m; }

    Estimate estimate(double time_s) override {
        Estimate estimate = state_.estimate;
        estimate.p_WB_m += off_now_m();
        estimate.time_s = time_s;
        estimate.valid = started_ && estimate.valid;
        return estimate;
    }
    void tell(const Readings& readings, const Setpoint& setpoint, double) override {
        clock_s_ += 0.004;
        if (clock_s_ < boot_s_ || !readings.motion_capture.ever()) {
            return;
        }
        Readings mine = readings;
        shift(mine);
        if (!started_) {
            Estimate begin;
            begin.time_s = clock_s_;
            begin.p_WB_m = readings.motion_capture.value.p_WB_m;
            begin.q_WB = readings.motion_capture.value.q_WB;
            begin.valid = true;
            state_ = start(model_, begin);
            started_ = true;
        }
        limpet::autopilot::estimate(model_, state_, mine);
        Setpoint mine_too = setpoint;
        if (auto* position = std::get_if<PositionSetpoint>(&mine_too.motion)) {
            position->p_W_m -= off_now_m();
        }
        command_ = limpet::autopilot::control(model_, state_, mine_too, clock_s_);
        armed_s_ += command_.armed ? 0.004 : 0.0;
    }
    RotorCommand command() override { return command_; }
    std::optional<std::string_view> failure() const override {
        return armed_s_ > fail_after_s_ ? std::optional<std::string_view>("as told") : std::nullopt;
    }
    double waited_s() const override { return 0.0; }
    std::string obstacle() const override { return started_ ? "" : "it boots"; }

private:
    [[nodiscard]] Vector3 off_now_m() const {
        return off_m_.isZero()
                   ? off_m_
                   : Vector3(off_m_ + Vector3(0.5 * std::sin(2.0 * kPi * clock_s_ / 60.0), 0, 0));
    }
    /// Stamps of a clock of its own, which goes on when the flight's begins.
    void shift(Readings& readings) const {
        const double ahead_s = clock_s_ - readings.imu.time_s;
        readings.imu.time_s += ahead_s;
        readings.motion_capture.time_s += ahead_s;
    }

    autopilot::AutopilotModel model_;
    autopilot::AutopilotState state_;
    RotorCommand command_;
    double boot_s_;
    double clock_s_ = 0.0;
    double armed_s_ = 0.0;
    double fail_after_s_ = 1e9;
    Vector3 off_m_ = Vector3::Zero();
    bool started_ = false;
};

/// Looks at the flight when it is told something and when its command is asked for.
class Onlooker final : public autopilot::ExternalAutopilot {
public:
    explicit Onlooker(Outsider& inner) : inner_(inner) {}

    void look_at(const Flight& flight) { flight_ = &flight; }
    [[nodiscard]] int told() const { return told_; }
    [[nodiscard]] int moved_meanwhile() const { return moved_; }

    Estimate estimate(double time_s) override { return inner_.estimate(time_s); }
    void tell(const Readings& readings, const Setpoint& setpoint, double time_s) override {
        inner_.tell(readings, setpoint, time_s);
        thrust_N_ = now_N();
    }
    RotorCommand command() override {
        told_ += flight_ != nullptr;
        moved_ += flight_ != nullptr && now_N() != thrust_N_;
        return inner_.command();
    }
    std::optional<std::string_view> failure() const override { return inner_.failure(); }
    double waited_s() const override { return 0.0; }
    std::string obstacle() const override { return inner_.obstacle(); }

private:
    [[nodiscard]] double now_N() const {
        return flight_ != nullptr ? flight_->state().truth.thrust_N : 0.0;
    }

    Outsider& inner_;
    const Flight* flight_ = nullptr;
    double thrust_N_ = 0.0;
    int told_ = 0;
    int moved_ = 0;
};

/// In a stride whose forces are those of its start, the command has no part in the motion.
TEST(ExternalAutopilot, TheBodiesMoveWhileItComputes) {
    const auto model = model_of("hover");
    Outsider outsider(*model);
    Onlooker onlooker(outsider);
    const Outside outside{.autopilot = &onlooker};
    Flight flight(model, bring_up(*model, outside, {}), outside);
    onlooker.look_at(flight);
    while (flight.state().tick < kTicksPerSecond) {
        flight.tick();
    }
    EXPECT_EQ(onlooker.told(), 250);
    EXPECT_GT(onlooker.moved_meanwhile(), 200);
}

TEST(BringUp, BeginsTheFlightInHoverAtTheStartWithAllClocksAtZero) {
    const auto model = model_of("perch_concrete");
    Outsider outsider(*model);
    std::vector<std::string> obstacles;
    BringUp options;
    options.on_obstacle = [&](const std::string& text) { obstacles.push_back(text); };
    const Snapshot first = bring_up(*model, {.autopilot = &outsider}, options);
    EXPECT_EQ(first.state.tick, 0);
    EXPECT_EQ(first.state.truth.time_s, 0.0);
    EXPECT_LT((first.state.truth.base.p_WF_m - model->scenario->start.p_WB_m).norm(), 0.15);
    EXPECT_LT(first.state.truth.base.v_WF_W_m_s.norm(), 0.1);
    EXPECT_TRUE(first.state.command.armed);
    EXPECT_FALSE(first.state.sensors.readings.imu.ever());
    EXPECT_EQ(first.state.truth.battery.energy_used_J, 0.0);
    EXPECT_THAT(obstacles, testing::ElementsAre("it boots", ""));
}

/// With GPS: what it believes has another origin, and wanders; it begins where that settles.
TEST(BringUp, BeginsWhereItsEstimateSettles) {
    const auto model = model_of("perch_concrete");
    const Vector3 off_m(3.0, -2.0, 1.0);
    Outsider outsider(*model);
    outsider.misplace(off_m);
    const Snapshot first = bring_up(*model, {.autopilot = &outsider}, {});
    const Vector3 start_m = model->scenario->start.p_WB_m;
    EXPECT_LT((first.state.truth.base.p_WF_m - start_m).norm(), 1.2);  // wandered by 1 m at most
    EXPECT_LT((first.state.autopilot.estimate.p_WB_m - start_m - off_m).norm(), 0.7);
    EXPECT_EQ(first.state.guidance.line_W_m, first.state.autopilot.estimate.p_WB_m);
}

TEST(BringUp, IsDoneInTheMeanWindForInGustsNothingStandsStill) {
    const auto model = model_of("perch_concrete",
                                {"environment.wind_speed_m_s=2", "environment.gust_sigma_m_s=1.5"});
    Outsider outsider(*model);
    const Snapshot first = bring_up(*model, {.autopilot = &outsider}, {});
    EXPECT_LT(first.state.truth.base.v_WF_W_m_s.norm(), 0.1);
    EXPECT_GT(std::abs(first.state.wind.along.first) + std::abs(first.state.wind.down.first), 0.0);
}

TEST(BringUp, GivesUpWithWhatItWaitedFor) {
    const auto model = model_of("hover");
    Outsider outsider(*model, 1e9);
    BringUp options;
    options.limit_s = 3.0;
    try {
        (void)bring_up(*model, {.autopilot = &outsider}, options);
        FAIL() << "nobody flew";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("3 s of simulated time"));
        EXPECT_THAT(error.what(), HasSubstr("it boots"));
    }
}

TEST(BringUp, SaysWhyTheAutopilotFailed) {
    const auto model = model_of("hover");
    Outsider outsider(*model);
    outsider.fail_after(0.5);
    try {
        (void)bring_up(*model, {.autopilot = &outsider}, {});
        FAIL() << "nobody flew";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("failed before the start: as told"));
    }
}

TEST(BringUp, HearsCtrlC) {
    const auto model = model_of("hover");
    Outsider outsider(*model);
    const std::atomic<bool> stop = true;
    BringUp options;
    options.stop = &stop;
    EXPECT_THROW((void)bring_up(*model, {.autopilot = &outsider}, options), Interrupted);
}

TEST(ExternalAutopilot, FliesTheMissionAsTheBuiltInOne) {
    const auto model = model_of("perch_concrete");
    Outsider outsider(*model);
    const FlightResult builtin = fly(model);
    const FlightResult outside = fly(model, {}, {}, 0, {.outside = {.autopilot = &outsider}});
    EXPECT_EQ(outside.outcome, Outcome::released) << outside.reason;
    ASSERT_EQ(outside.events.size(), builtin.events.size());
    for (std::size_t k = 0; k < builtin.events.size(); ++k) {
        EXPECT_EQ(outside.events[k].name, builtin.events[k].name);
        EXPECT_NEAR(outside.events[k].time_s, builtin.events[k].time_s, 0.5)
            << to_string(builtin.events[k].name);
    }
}

TEST(ExternalAutopilot, ItsEndInTheAirIsACrashWithTheReasonAndAWholeRecording) {
    const auto model = model_of("perch_concrete");
    Outsider outsider(*model);
    outsider.fail_after(8.0);  // it took off within five
    const auto path = std::filesystem::path(testing::TempDir()) / "outsider_fails.mcap";
    const FlightResult result = fly(model, path, {}, 0, {.outside = {.autopilot = &outsider}});
    EXPECT_EQ(result.outcome, Outcome::crashed);
    EXPECT_EQ(result.reason, "as told");
    const record::Recording recording = record::read_recording(path);
    EXPECT_EQ(recording.damage, "");
    EXPECT_NE(recording.attachment("summary.json"), nullptr);
    std::filesystem::remove(path);
}

TEST(ExternalAutopilot, ItsEndOnTheWallLeavesTheVehicleHanging) {
    const auto model = model_of("perch_concrete");
    Outsider outsider(*model);
    outsider.fail_after(17.0);  // while it lands on its legs
    const FlightResult result = fly(model, {}, {}, 0, {.outside = {.autopilot = &outsider}});
    EXPECT_EQ(result.outcome, Outcome::timed_out);
    EXPECT_EQ(result.reason, "as told");
}

TEST(Flight, StopsWhenToldWithTheRecordingWhole) {
    const auto model = model_of("hover");
    const std::atomic<bool> stop = true;
    const auto path = std::filesystem::path(testing::TempDir()) / "stopped.mcap";
    const FlightResult result = fly(model, path, {}, 0, {.stop = &stop});
    EXPECT_EQ(result.outcome, Outcome::interrupted);
    EXPECT_EQ(result.reason, "interrupted");
    EXPECT_EQ(record::read_recording(path).damage, "");
    std::filesystem::remove(path);
}

TEST(Pace, HoldsSimulatedTimeBackAndNeverAhead) {
    Pace pace(10.0);
    pace.wait_until(0.5);
    EXPECT_GE(pace.elapsed_s(), 0.05);
    Pace free(0.0);
    free.wait_until(1e6);
    EXPECT_LT(free.elapsed_s(), 10.0);
}

}  // namespace
}  // namespace limpet::simulation
