// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "compare_flights.hpp"
#include "limpet/compare/compare.hpp"
#include "limpet/models/model_writer.hpp"

namespace limpet::compare {
namespace {

using test::ComparedTape;
using test::Held;

/// A contact by eqs. (5) and (6) of the paper, from a touch until the pump is off and on from
/// there.
struct Contact {
    double touch_s = 3.0;
    double pump_off_s = 7.0;
    double vacuum_Pa = 65000.0;
    double ripple_Pa = 0.0;
    bool loads = true;

    [[nodiscard]] CupStatus at(double t) const {
        constexpr double kSeal_s = 0.33;
        constexpr double kUnseal_s = 0.40;
        constexpr double kArea_m2 = 4.0e-3;
        CupStatus cup;
        if (t < touch_s) {
            return cup;
        }
        const double full_Pa = kAtmosphere_Pa - vacuum_Pa;
        const double off_Pa = full_Pa * (1.0 - std::exp(-(pump_off_s - touch_s) / kSeal_s));
        const double drawn_Pa = t < pump_off_s
                                    ? full_Pa * (1.0 - std::exp(-(t - touch_s) / kSeal_s))
                                    : off_Pa * std::exp(-(t - pump_off_s) / kUnseal_s);
        cup.phase = t >= pump_off_s      ? CupPhase::unsealing
                    : t < touch_s + 0.15 ? CupPhase::sealing
                                         : CupPhase::attached;
        const bool pumps = t < pump_off_s;
        cup.pressure_Pa =
            kAtmosphere_Pa - drawn_Pa +
            (pumps ? ripple_Pa * drawn_Pa / full_Pa * std::sin(2.0 * kPi * 30.0 * t) : 0.0);
        if (loads) {
            cup.pull_N = 10.0 + std::sin(t);
            cup.pull_margin_N = drawn_Pa * kArea_m2 - cup.pull_N;
        }
        return cup;
    }
};

ComparedTape tape_of(const Contact& contact) {
    return {.truth =
                [contact](double t) {
                    Truth truth;
                    truth.cup_status = contact.at(t);
                    return truth;
                },
            .events = {{3.1, EventName::impact}}};
}

std::vector<ContactDifference> contacts(const Contact& a, const Contact& b) {
    return Held(tape_of(a), tape_of(b)).comparison.contacts;
}

TEST(CompareContact, AContactBetweenTwoSamplesIsTheSameContact) {
    // 3.7 ms later: the recording, a sample each 10 ms, does not say so.
    const auto found = contacts({}, {.touch_s = 3.0037, .pump_off_s = 7.0061});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_TRUE(found[0].sealing);
    EXPECT_NEAR(found[0].shift_s, 0.0037, 2e-4);
    EXPECT_FALSE(found[1].sealing);
    EXPECT_NEAR(found[1].shift_s, 0.0061, 2e-4);
    // A chord lies below an exponential by at most P'' dt^2 / 8: 363 / 0.33^2 * 1e-4 / 8 = 0.042.
    EXPECT_LT(found[0].largest_hPa, 0.045);
    EXPECT_LT(found[1].largest_hPa, 0.045);
    // Without the shift it were 363 hPa / 0.33 s * 3.7 ms = 4 hPa.
}

TEST(CompareContact, AnotherVacuumIsAnotherPressure) {
    const auto found = contacts({}, {.vacuum_Pa = 64800.0});
    ASSERT_GE(found.size(), 1u);
    EXPECT_NEAR(found[0].largest_hPa, 2.0, 0.1);
}

TEST(CompareContact, ThePumpsRippleIsTakenOutWhereLoadsTellThePressureThatActs) {
    const Contact calm;
    const Contact rippling{.ripple_Pa = 600.0};
    EXPECT_LT(contacts(calm, rippling).at(0).largest_hPa, 0.2);
    const Contact without{.ripple_Pa = 600.0, .loads = false};
    EXPECT_GT(contacts(calm, without).at(0).largest_hPa, 4.0) << "else it is there";
}

TEST(CompareContact, ATouchThatDidNotLastIsNone) {
    EXPECT_TRUE(contacts({}, {.touch_s = 30.0}).empty());
    EXPECT_EQ(contacts({}, {.touch_s = 6.95}).size(), 0u) << "50 ms, then it unseals: not the same";
}

/// A vehicle at rest, held by forces that the test chooses in the world.
ComparedTape resting(const Vector3& cup_W_N, const Vector3& legs_W_N) {
    const Quaternion q_WB = quaternion_from_euler(
        {.roll_rad = radians(2.0), .pitch_rad = radians(66.8), .yaw_rad = radians(-7.0)});
    const Quaternion q_WC = q_WB * Eigen::AngleAxisd(radians(-64.0), Vector3::UnitY()) *
                            Eigen::AngleAxisd(radians(4.0), Vector3::UnitZ());
    vehicle::Airframe airframe;
    airframe.has_cup = true;
    return {.truth =
                [=](double) {
                    Truth truth;
                    truth.base.q_WF = q_WB;
                    truth.cup.q_WF = q_WC;
                    truth.cup_status.wrench_C.force_N = q_WC.conjugate() * cup_W_N;
                    truth.legs_force_W_N = legs_W_N;
                    return truth;
                },
            .state = [](double t) { return std::string(t < 2.0 ? "standing" : "resting"); },
            .model = write_mjcf(airframe, models::Scene{})};
}

TEST(CompareRest, TheWallCarriesWhatCupAndLegsTakeTogether) {
    // 3.2 kg: 31.38 N up, shared by cup and legs; what the cup pulls in, the legs push out.
    const double weight_N = 3.2 * kGravity_m_s2;
    const auto rest =
        rest_of(test::record(resting({9.7, 0.3, -27.0}, {-9.7, -0.3, 27.0 - weight_N})));
    ASSERT_TRUE(rest);
    EXPECT_NEAR(rest->hanging_load_N, weight_N, 1e-9);
    EXPECT_NEAR(rest->weight_N, weight_N, 1e-6);
    EXPECT_NEAR(rest->wall_push_N, 0.0, 1e-9);
    EXPECT_NEAR(rest->pitch_deg, 66.8, 1e-6);
}

TEST(CompareRest, AFlightThatDoesNotRestHasNone) {
    ComparedTape tape = resting({9.7, 0.0, -27.0}, {-9.7, 0.0, -4.4});
    tape.state = [](double) { return std::string("hovering"); };
    EXPECT_FALSE(rest_of(test::record(tape)));
}

}  // namespace
}  // namespace limpet::compare
