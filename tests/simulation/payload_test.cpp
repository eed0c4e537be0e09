// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../support/files.hpp"
#include "flown.hpp"
#include "limpet/core/atmosphere.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/record/story.hpp"
#include "limpet/simulation/advance.hpp"
#include "limpet/simulation/flight_log.hpp"

namespace limpet::simulation {
namespace {

constexpr double kHung_kg = 0.2;

std::vector<std::string> hung(std::vector<std::string> changes = {}) {
    changes.insert(changes.begin(),
                   {"vehicle.payload.mass_kg=0.2", "vehicle.payload.cable_length_m=1"});
    return changes;
}

/// Bodies alone, pushed by who asks.
struct Bodies {
    std::shared_ptr<const FlightModel> model;
    std::unique_ptr<plant::Plant> plant;
    FlightState state;

    explicit Bodies(const std::vector<std::string>& changes)
        : model(model_of("hover", hung(changes))),
          plant(model->plant->make()),
          state(start(*model, *plant)) {}

    /// Momentum of the vehicle's parts and of the payload, in W.
    [[nodiscard]] Vector3 momentum() const {
        Vector3 sum = model->airframe.payload.mass_kg * state.truth.payload.v_W_m_s;
        const auto add = [&](plant::Body body, const vehicle::SwellModel::Part& part) {
            const Kinematics at = plant->kinematics(body);
            sum += part.mass_kg * (at.v_WF_W_m_s + at.q_WF * at.w_WF_F_rad_s.cross(part.centre_m));
        };
        add(plant::Body::base, model->swell.base);
        if (model->airframe.has_cup) {
            add(plant::Body::carriage, model->swell.carriage);
            add(plant::Body::cup, model->swell.cup);
        }
        return sum;
    }
};

/// What the engine makes of the cable's pull: with the rotors at rest both together are pulled down
/// by their weight and by nothing else, whatever the swing.
TEST(PayloadInTheLoop, MomentumOfBothIsWhatTheirWeightGives) {
    for (const std::string engine : {"reduced", "mujoco"}) {
        SCOPED_TRACE(engine);
        Bodies both({"simulation.engine=" + engine, "simulation.start_height_m=50",
                     "vehicle.payload.drag_area_m2=0", "vehicle.payload.hook_x_m=0.05",
                     "vehicle.rotor.drag_constant_kg=0"});
        FlightState& state = both.state;
        state.truth.payload.v_W_m_s = Vector3(2.0, 1.0, 3.0);
        const Vector3 at_first = both.momentum();
        std::fill(state.rotors.speed_rad_s.begin(), state.rotors.speed_rad_s.end(), 0.0);
        TickReport report;
        double most_N = 0.0;
        while (state.tick < kTicksPerSecond) {
            const Stride stride = one_tick(*both.model, state);
            advance(*both.model, state, *both.plant, stride, report);
            state.tick += stride.ticks;
            see_motion(*both.model, state.truth, *both.plant);
            most_N = std::max(most_N, state.truth.payload.tension_N);
        }
        EXPECT_GT(most_N, 2.0);
        const Vector3 gained = both.momentum() - at_first;
        const double by_weight = carried_mass_kg(both.model->airframe) * kGravity_m_s2;
        // Rates belong to the middle of steps, poses to their ends: a turning vehicle's parts.
        EXPECT_LT((gained - by_weight * Vector3::UnitZ()).norm(), 2e-3 * by_weight);
    }
}

/// A vehicle that its lift carries and that is free to move: omega^2 = g / L (1 + m / M), made fast
/// at the centre of mass.
TEST(PayloadInTheLoop, SwingsWithAFreeVehicleAsTwoBodiesDo) {
    for (const std::string engine : {"reduced", "mujoco"}) {
        SCOPED_TRACE(engine);
        Bodies both({"simulation.engine=" + engine, "simulation.start_height_m=50",
                     "vehicle.has_cup=false", "vehicle.payload.mass_kg=1",
                     "vehicle.payload.drag_area_m2=0", "vehicle.payload.hook_z_m=0",
                     "vehicle.payload.cable_stretch_m=0.0001"});
        const double hung_kg = both.model->airframe.payload.mass_kg;
        const double vehicle_kg = both.model->airframe.mass_kg;
        PayloadStatus& payload = both.state.truth.payload;
        payload.v_W_m_s.x() = 0.1;
        constexpr double kStep_s = 1e-3;
        double last_m = 0.0, first_s = kNaN, latest_s = kNaN;
        int swings = -1;
        for (int i = 1; i <= 12000; ++i) {
            const Kinematics base = both.plant->kinematics(plant::Body::base);
            both.plant->apply(
                plant::Body::base,
                {.force_N = -(vehicle_kg + hung_kg) * kGravity_m_s2 * Vector3::UnitZ()},
                base.p_WF_m);
            both.plant->apply(plant::Body::base,
                              vehicle::step(both.model->payload, payload, base, {}, kStep_s),
                              base.p_WF_m);
            both.plant->step({.step_s = kStep_s, .contacts = false});
            const double ahead_m =
                payload.p_W_m.x() - both.plant->kinematics(plant::Body::base).p_WF_m.x();
            if (last_m < 0.0 && ahead_m >= 0.0) {
                latest_s = kStep_s * (i - ahead_m / (ahead_m - last_m));
                first_s = swings < 0 ? latest_s : first_s;
                ++swings;
            }
            last_m = ahead_m;
        }
        ASSERT_GT(swings, 4);
        const double wanted_s =
            2.0 * kPi / std::sqrt(kGravity_m_s2 / 1.0 * (1.0 + hung_kg / vehicle_kg));
        EXPECT_NEAR((latest_s - first_s) / swings, wanted_s, 1e-3 * wanted_s);
    }
}

/// How far a hover of 20 s gets from where it began, and what the cable bears.
struct Hovered {
    double off_m = 0.0;
    double mean_N = 0.0;
};

Hovered hovered(const std::string& mass_kg, const std::string& wind_m_s) {
    Flight flight(model_of(
        "hover", {"simulation.start_offset_m=0", "simulation.start_yaw_deg=0",
                  "environment.wind_speed_m_s=" + wind_m_s, "vehicle.payload.mass_kg=" + mass_kg,
                  "vehicle.payload.drag_area_m2=0.02"}));
    const Vector3 from_W_m = flight.state().truth.base.p_WF_m;
    Hovered seen;
    double count = 0.0;
    while (!flight.ended()) {
        flight.tick();
        const Truth& truth = flight.state().truth;
        seen.off_m = std::max(seen.off_m, (truth.base.p_WF_m - from_W_m).norm());
        seen.mean_N += truth.payload.tension_N;
        ++count;
    }
    seen.mean_N /= count;
    return seen;
}

/// A hover begins in trim: with the payload it leaves its place by no more than without, and the
/// cable bears weight and drag.
TEST(PayloadInTheLoop, AHoverBeginsInTrim) {
    for (const std::string wind_m_s : {"0", "4"}) {
        SCOPED_TRACE(wind_m_s);
        const Hovered without = hovered("0", wind_m_s), with = hovered("0.2", wind_m_s);
        EXPECT_LT(with.off_m, 1.25 * without.off_m + 0.005);
        const double drag_N = 0.5 * kAirDensity_kg_m3 * 0.02 * std::pow(std::stod(wind_m_s), 2);
        EXPECT_NEAR(with.mean_N, std::hypot(kHung_kg * kGravity_m_s2, drag_N), 0.01);
        RecordProperty("off_mm_" + wind_m_s, static_cast<int>(1e3 * with.off_m));
        RecordProperty("off_mm_without_" + wind_m_s, static_cast<int>(1e3 * without.off_m));
    }
}

/// The hull's acceleration pulls on the payload as on the vehicle: both fall as if there were none.
TEST(PayloadInTheLoop, AFallingVehicleAndItsPayloadDoNotKnowOfASwell) {
    const auto fallen = [](bool sea) {
        std::vector<std::string> changes = {"simulation.start_height_m=50",
                                            "vehicle.payload.drag_area_m2=0"};
        if (sea) {
            changes.insert(changes.end(),
                           {"environment.swell_into_wall_m=0.4", "environment.swell_up_m=0.5",
                            "environment.swell_period_s=4"});
        }
        Bodies both(changes);
        both.state.truth.payload.v_W_m_s.y() = 1.0;
        std::fill(both.state.rotors.speed_rad_s.begin(), both.state.rotors.speed_rad_s.end(), 0.0);
        TickReport report;
        while (both.state.tick < kTicksPerSecond) {
            const Stride stride = one_tick(*both.model, both.state);
            advance(*both.model, both.state, *both.plant, stride, report);
            both.state.tick += stride.ticks;
            see_motion(*both.model, both.state.truth, *both.plant);
        }
        return std::pair(both.state.truth.payload.p_W_m,
                         swell_motion(both.model->swell, 1.0).p_EW_W_m);
    };
    const auto [calm_W_m, none] = fallen(false);
    const auto [sea_W_m, moved_W_m] = fallen(true);
    EXPECT_GT(moved_W_m.norm(), 0.5);
    EXPECT_LT((sea_W_m + moved_W_m - calm_W_m).norm(), 2e-3);
}

/// The shipped flight, whole: perches, rests with the payload hanging still, takes off, releases.
TEST(PayloadInTheLoop, PerchesRestsAndTakesOff) {
    Flight flight(model_of("perch_payload"));
    double rest_N = 0.0, rest_m_s = 0.0, shear_N = 0.0, count = 0.0;
    while (!flight.ended()) {
        flight.tick();
        const FlightState& state = flight.state();
        ASSERT_LT(state.truth.payload.p_W_m.z(), flight.model().start.ground_z_W_m + 1e-9);
        ASSERT_GT(before_wall_m(flight.model().cup.wall, state.truth.payload.p_W_m), -1e-6);
        if (state.guidance.state == guidance::PerchingState::resting &&
            seconds(state.tick) - state.guidance.since_s > flight.model().guidance.rest_s - 2.0) {
            rest_N += state.truth.payload.tension_N;
            rest_m_s = std::max(rest_m_s, state.truth.payload.v_W_m_s.norm());
            shear_N += state.cup.status.shear_N - flight.plant().contact_force_W().z();
            ++count;
        }
    }
    EXPECT_EQ(flight.state().ending->outcome, Outcome::released)
        << flight.state().ending->reason.view();
    ASSERT_GT(count, 100.0);
    const double hung_kg = flight.model().airframe.payload.mass_kg;
    EXPECT_NEAR(rest_N / count, hung_kg * kGravity_m_s2, 0.02 * hung_kg * kGravity_m_s2);
    // Cup and legs bear both.
    const double weight_N = carried_mass_kg(flight.model().airframe) * kGravity_m_s2;
    EXPECT_NEAR(shear_N / count, weight_N, 0.01 * weight_N);
}

/// The cable parts in a hover: the payload lies on the ground, the vehicle stays where it was told.
TEST(PayloadInTheLoop, ACableThatBreaksLeavesALighterVehicle) {
    Flight flight(model_of("hover", hung({"faults=[{fault: cable_breaks, at_s: 2, for_s: 1}]",
                                          "simulation.hover_s=15"})));
    const double carried_N = carried_mass_kg(flight.model().airframe) * kGravity_m_s2;
    double before_N = 0.0, rose_m = 0.0;
    while (!flight.ended()) {
        flight.tick();
        const Truth& truth = flight.state().truth;
        if (truth.time_s < 2.0) {
            before_N = truth.thrust_N;
        }
        rose_m = std::max(rose_m, -truth.base.p_WF_m.z());
    }
    const Truth& truth = flight.state().truth;
    EXPECT_TRUE(truth.payload.parted);
    EXPECT_EQ(truth.payload.tension_N, 0.0);
    EXPECT_NEAR(truth.payload.p_W_m.z(), flight.model().start.ground_z_W_m, 1e-9);
    EXPECT_NEAR(before_N, carried_N, 0.05 * carried_N);
    EXPECT_NEAR(truth.thrust_N, flight.model().airframe.mass_kg * kGravity_m_s2, 0.05 * carried_N);
    EXPECT_GT(rose_m, 0.01);
    EXPECT_LT(rose_m, 0.5);
    EXPECT_NEAR(truth.base.p_WF_m.z(), 0.0, 0.05);
}

/// Where there is a payload there is its channel, and in it what was true.
TEST(PayloadInTheLoop, IsRecordedWhereThereIsOne) {
    const TestFolder folder;
    const auto recorded = [&](const std::string& mass_kg) {
        const auto model =
            model_of("hover", {"vehicle.payload.mass_kg=" + mass_kg, "simulation.hover_s=0.5"});
        Flight flight(model);
        FlightLog log(folder / "a.mcap", *model, {});
        PayloadStatus last;
        while (!flight.ended()) {
            const guidance::EventList& events = flight.tick();
            log.tick(*model, flight.state(), events);
            last = due(flight.state().tick, model->record_rate_Hz) ? flight.state().truth.payload
                                                                   : last;
        }
        log.finish("{}");
        return std::pair(record::read_recording(folder / "a.mcap"), last);
    };
    const auto [without, none] = recorded("0");
    EXPECT_EQ(find_table(without, record::kPayloadTopic), nullptr);
    const auto [with, last] = recorded("0.2");
    const record::Table* table = find_table(with, record::kPayloadTopic);
    ASSERT_NE(table, nullptr);
    const auto last_of = [&](std::string_view column) {
        const record::Column* found = table->find(column);
        return found == nullptr ? kNaN : found->values.back();
    };
    ASSERT_GT(table->time_s.size(), 40U);
    EXPECT_EQ(last_of("tension_N"), last.tension_N);
    EXPECT_EQ(last_of("down_m"), last.p_W_m.z());
    EXPECT_EQ(last_of("velocity_north_m_s"), last.v_W_m_s.x());
    EXPECT_EQ(last_of("cable_parted"), 0.0);
}

/// More than the rotors lift, a cable that reaches the ground: each in a line.
TEST(PayloadInTheLoop, WhatCannotBeIsRefusedInALine) {
    const auto refused = [](const std::vector<std::string>& changes) -> std::string {
        try {
            (void)scenario::load_scenario("hover", {.overrides = changes, .seed = 1});
        } catch (const InputError& error) {
            return error.what();
        }
        return "taken";
    };
    EXPECT_NE(refused({"vehicle.payload.mass_kg=9"}).find("guidance.hover_thrust follows from it"),
              std::string::npos)
        << refused({"vehicle.payload.mass_kg=9"});
    const std::string low = refused(hung({"vehicle.payload.cable_length_m=1.45"}));
    EXPECT_NE(low.find("vehicle.payload.cable_length_m=1.45: 1.45 m reach the ground at the start, "
                       "allowed is less than 1.45"),
              std::string::npos)
        << low;
    EXPECT_EQ(refused({"vehicle.payload.cable_length_m=1.45"}), "taken");  // nothing hangs there
    EXPECT_NE(refused({"vehicle.payload.mass_kg=-1"}).find("out of range"), std::string::npos);
}

}  // namespace
}  // namespace limpet::simulation
