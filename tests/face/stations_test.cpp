// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limpet/limpet.hpp>

namespace {

using limpet::Vector3;

/// Holds height and attitude alone, by an integral that lives in the flight.
class HoldsHeight final : public limpet::Autopilot {
public:
    [[nodiscard]] std::size_t memory_size() const override { return 2; }
    void start(const limpet::Estimate& initial, std::span<double> memory) const override {
        memory[1] = initial.p_WB_m.z();
    }
    [[nodiscard]] limpet::AutopilotOutput control(const limpet::AutopilotInput& input,
                                                  std::span<double> memory) const override {
        const double below_m = input.estimate.p_WB_m.z() - memory[1];
        memory[0] += below_m * input.dt_s;
        const Vector3 tilt_rad =
            limpet::rotation_vector_from_quaternion(input.estimate.q_WB.conjugate());
        return {.thrust = input.vehicle.hover_thrust + 0.2 * below_m + 0.1 * memory[0] +
                          0.1 * input.estimate.v_WB_m_s.z(),
                .torque = 0.8 * tilt_rad - 0.15 * input.estimate.w_WB_B_rad_s};
    }
};

/// Ends the flight after a while of its own counting.
class Counts final : public limpet::Guidance {
public:
    [[nodiscard]] std::size_t memory_size() const override { return 1; }
    [[nodiscard]] limpet::GuidanceOutput update(const limpet::GuidanceInput&,
                                                std::span<double> memory) const override {
        limpet::GuidanceOutput output{
            .setpoint = {.motion = limpet::PositionSetpoint{}, .armed = true}};
        if (++memory[0] > 100.0) {
            output.outcome = limpet::Outcome::released;
            output.reason = "counted to a hundred";
        }
        return output;
    }
};

/// Never falls below what it has been told.
class Weak final : public limpet::CupPressure {
public:
    [[nodiscard]] double next_Pa(const limpet::CupPressureInput& air,
                                 std::span<double>) const override {
        return std::max(air.pressure_Pa - 1e5 * air.dt_s, 95000.0);
    }
};

/// Goes by the paper's law and keeps what it was told last.
class Told final : public limpet::CupPressure {
public:
    explicit Told(limpet::CupPressureInput& last) : last_(last) {}
    [[nodiscard]] double next_Pa(const limpet::CupPressureInput& air,
                                 std::span<double>) const override {
        last_ = air;
        const bool sucks = air.pump_running && !air.valve_open;
        const double end_Pa = sucks ? air.vacuum_pressure_Pa : air.ambient_Pa;
        const double tau_s = sucks ? air.sealing_time_constant_s : air.unsealing_time_constant_s;
        return end_Pa + (air.pressure_Pa - end_Pa) * std::exp(-air.dt_s / tau_s);
    }

private:
    limpet::CupPressureInput& last_;
};

/// A rigid ball of the vehicle's mass, without walls.
class Ball final : public limpet::Plant {
public:
    void apply(limpet::Body, const limpet::Wrench& wrench_W, const Vector3&) override {
        force_W_N_ += wrench_W.force_N;
    }
    void step(const limpet::StepMode& mode) override {
        v_m_s_ += (force_W_N_ / 3.2 + Vector3(0.0, 0.0, limpet::kGravity_m_s2)) * mode.step_s;
        p_m_ += v_m_s_ * mode.step_s;
        force_W_N_.setZero();
    }
    [[nodiscard]] limpet::Kinematics kinematics(limpet::Body) const override {
        return {.p_WF_m = p_m_, .v_WF_W_m_s = v_m_s_};
    }
    [[nodiscard]] limpet::SliderMotion slider() const override { return {}; }
    [[nodiscard]] std::optional<double> ray(const Vector3&, const Vector3&) const override {
        return std::nullopt;
    }
    [[nodiscard]] Vector3 contact_force_W() const override { return Vector3::Zero(); }
    [[nodiscard]] limpet::PlantState save() const override {
        return {.values = {p_m_.x(), p_m_.y(), p_m_.z(), v_m_s_.x(), v_m_s_.y(), v_m_s_.z()}};
    }
    void restore(const limpet::PlantState& state) override {
        p_m_ = Eigen::Map<const Vector3>(state.values.data());
        v_m_s_ = Eigen::Map<const Vector3>(state.values.data() + 3);
    }
    void set_pose(const Vector3& p_WB_m, const limpet::Quaternion&, const Vector3& v_WB_W_m_s,
                  const Vector3&) override {
        p_m_ = p_WB_m;
        v_m_s_ = v_WB_W_m_s;
    }

private:
    Vector3 p_m_ = Vector3::Zero();
    Vector3 v_m_s_ = Vector3::Zero();
    Vector3 force_W_N_ = Vector3::Zero();
};
class BallModel final : public limpet::PlantModel {
public:
    [[nodiscard]] std::unique_ptr<limpet::Plant> make() const override {
        return std::make_unique<Ball>();
    }
};

/// Saved half-way, a flight with such stations comes to the same end.
limpet::Result branched(const std::string& name, const limpet::Stations& stations, double at_s) {
    const limpet::Scenario scenario = limpet::load(name);
    limpet::Flight flight(scenario, stations);
    while (flight.time_s() < at_s && flight.tick()) {
    }
    limpet::Flight branch(scenario, flight.save(), stations);
    const limpet::Result result = flight.fly();
    const limpet::Result other = branch.fly();
    EXPECT_EQ(other.state_hash, result.state_hash) << name;
    EXPECT_EQ(other.simulated_s, result.simulated_s) << name;
    return result;
}

TEST(OwnAutopilot, FliesAndItsMemoryBranchesWithTheFlight) {
    const limpet::Stations own = {.autopilot = std::make_shared<HoldsHeight>()};
    const limpet::Result result = branched("hover", own, 7.0);
    EXPECT_EQ(result.outcome, limpet::Outcome::released);
    EXPECT_NE(result.state_hash, limpet::Flight(limpet::load("hover")).fly().state_hash);
}

TEST(OwnAutopilot, TakesOverInMidFlightWithAMemoryOfItsOwn) {
    const limpet::Scenario hover = limpet::load("hover");
    limpet::Flight flight(hover);
    while (flight.time_s() < 3.0 && flight.tick()) {
    }
    limpet::Flight taken(hover, flight.save(), {.autopilot = std::make_shared<HoldsHeight>()});
    EXPECT_EQ(taken.fly().outcome, limpet::Outcome::released);
}

TEST(OwnGuidance, CountsOnInABranch) {
    const limpet::Result result = branched("hover", {.guidance = std::make_shared<Counts>()}, 1.0);
    EXPECT_EQ(result.reason, "counted to a hundred");
    EXPECT_NEAR(result.simulated_s, 2.0, 0.02);  // 50 Hz
}

TEST(OwnCup, DecidesThePressureAndNothingElse) {
    const limpet::Result result =
        branched("perch_concrete", {.cup = std::make_shared<Weak>()}, 5.3);
    EXPECT_EQ(result.outcome, limpet::Outcome::failed_to_seal);
    EXPECT_DOUBLE_EQ(result.metric("pressure_min_Pa"), 95000.0);
}

/// What the cup is told last of a seal that holds or, with a fault, until it lets go.
limpet::CupPressureInput told_at_rest(const std::vector<std::string>& changes) {
    limpet::CupPressureInput last;
    const limpet::Scenario scenario = limpet::load("perch_concrete", changes);
    limpet::Flight flight(scenario, {.cup = std::make_shared<Told>(last)});
    while (flight.time_s() < 15.0 && flight.tick()) {
    }
    return last;
}

TEST(OwnCup, IsToldWhatHasWornAndWhatHasBroken) {
    const limpet::CupPressureInput sound = told_at_rest({});
    EXPECT_TRUE(sound.pump_running);
    EXPECT_EQ(sound.hole_mm2, 0.0);
    EXPECT_EQ(sound.leak_growth, 0.0);
    EXPECT_GT(std::abs(sound.peel_N_m), 0.1);

    const limpet::CupPressureInput creeping = told_at_rest({"suction.seal_creep_1_s=0.01"});
    EXPECT_NEAR(creeping.leak_growth, 0.01 * 9.8, 0.01 * 0.3);  // sealed from 5.2 s on

    const limpet::CupPressureInput leaking =
        told_at_rest({"faults.fault=hose_leaks", "faults.phase=resting", "faults.size=0.4"});
    EXPECT_DOUBLE_EQ(leaking.hole_mm2, 0.4);
    EXPECT_TRUE(leaking.pump_running);

    EXPECT_FALSE(told_at_rest({"faults.fault=pump_lost", "faults.phase=resting"}).pump_running);
}

TEST(OwnPlant, MovesWhatTheLoopAsks) {
    const limpet::Result result = branched("hover", {.plant = std::make_shared<BallModel>()}, 4.0);
    EXPECT_EQ(result.outcome, limpet::Outcome::released);
}

}  // namespace
