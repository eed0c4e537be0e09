// SPDX-License-Identifier: Apache-2.0
// The cup in two halves, plugin and node, against the one in one piece.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "adapters/ros/src/apart_lip.hpp"
#include "adapters/ros/src/setup.hpp"
#include "adapters/ros/src/suction_cup.hpp"

namespace limpet::ros {
namespace {

constexpr double kStep_s = 2.5e-4;

/// Where the lip is and how hard it is pressed, at a time: comes, presses, hangs, is pulled off
/// after the pump went off at 3 s.
struct Script {
    double depth_m = 0.0;
    double press_N = 0.0;
    bool pump_on = true;
};
Script script(double t_s) {
    if (t_s < 0.5) {
        return {.depth_m = -0.1 + 0.2 * t_s};  // touches at 0.5 s
    }
    if (t_s < 0.6) {
        return {.depth_m = 0.001, .press_N = 60.0};
    }
    if (t_s < 3.0) {
        return {.depth_m = 0.0005, .press_N = -20.0};
    }
    // Let in the air, then drawn away.
    return {.depth_m = t_s < 5.0 ? 0.0005 : 0.0005 - 0.02 * (t_s - 5.0),
            .press_N = 0.0,
            .pump_on = false};
}

struct Happened {
    std::vector<Event> events;
    std::vector<double> pressure_Pa;  ///< every 10 ms
};

Kinematics cup_at(double depth_m) {
    Kinematics cup;
    cup.p_WF_m.x() = depth_m;
    return cup;
}

scenario::Scenario scenario() {
    return load_setup({.seed = 4}).scenario;
}

/// @param step  of a cup: (where it is, input) -> output; it changes `state`
template <class Step>
Happened play(const suction::CupState& state, Step step) {
    Happened happened;
    for (long k = 0; k < 24000; ++k) {
        const double t_s = static_cast<double>(k) * kStep_s;
        const Script now = script(t_s);
        const suction::CupOutput output =
            step(cup_at(now.depth_m),
                 suction::CupInput{.time_s = t_s, .press_N = now.press_N, .pump_on = now.pump_on});
        if (output.event) {
            happened.events.push_back(*output.event);
        }
        if (k % 40 == 0) {
            happened.pressure_Pa.push_back(state.mean_pressure_Pa);
        }
    }
    return happened;
}

/// @param delay_s  from a report to its answer
Happened in_two_halves(const scenario::Scenario& scenario, double delay_s) {
    const suction::CupModel model{.parameters = scenario.cup, .wall = {}};
    ApartLip lip;
    SuctionCup far(scenario);
    suction::CupState state;
    std::deque<std::pair<double, limpet_ros::CupState>> on_the_way;  // when each arrives
    return play(state, [&](const Kinematics& cup, const suction::CupInput& input) {
        while (!on_the_way.empty() && on_the_way.front().first < input.time_s) {
            lip.receive(on_the_way.front().second);
            on_the_way.pop_front();
        }
        const auto output = lip.step(model, state, scenario.wall.surface, cup, input);
        if (const auto report = lip.take_report()) {
            far.command(input.pump_on, false);
            (void)far.feel(*lip_contact(*report), report->header.stamp.toSec());
            on_the_way.emplace_back(input.time_s + delay_s, cup_message(far.state()));
            on_the_way.back().second.contact = report->number;
        }
        return output;
    });
}

Happened in_one_piece(const scenario::Scenario& scenario) {
    const suction::CupModel model{.parameters = scenario.cup, .wall = {}};
    suction::CupState state;
    state.random = RandomStream(scenario.seed, 0, Stream::seal);
    return play(state, [&](const Kinematics& cup, const suction::CupInput& input) {
        return suction::step(model, state, scenario.wall.surface, cup, input, kStep_s);
    });
}

void expect_alike(const Happened& one, const Happened& two, double late_s, double pressure_Pa) {
    ASSERT_EQ(one.events.size(), 2U);
    ASSERT_EQ(two.events.size(), one.events.size());
    for (std::size_t i = 0; i < one.events.size(); ++i) {
        EXPECT_EQ(two.events[i].name, one.events[i].name);
        EXPECT_NEAR(two.events[i].time_s, one.events[i].time_s, late_s) << i;
    }
    for (std::size_t i = 0; i < one.pressure_Pa.size(); ++i) {
        ASSERT_NEAR(two.pressure_Pa[i], one.pressure_Pa[i], pressure_Pa) << 0.01 * double(i);
    }
}

TEST(ApartCup, DoesWhatTheWholeOneDoes) {
    const Happened whole = in_one_piece(scenario());
    ASSERT_EQ(whole.events.size(), 2U);
    EXPECT_EQ(whole.events[0].name, EventName::attached);
    EXPECT_EQ(whole.events[1].name, EventName::detached);
    // A report is a tick old, the answer counts in the next. The steepest pressure of concrete,
    // 36 kPa over 0.33 s, moves by 110 Pa a tick.
    expect_alike(whole, in_two_halves(scenario(), 0.0), 0.005, 500.0);
}

TEST(ApartCup, AnswersThatComeLateDelayAndDoNotConfuse) {
    expect_alike(in_one_piece(scenario()), in_two_halves(scenario(), 0.02), 0.04,
                 36000.0 * 0.03 / 0.33);
}

TEST(ApartCup, AnOldAnswerDoesNotSealALipThatHasLetGo) {
    const scenario::Scenario s = scenario();
    const suction::CupModel model{.parameters = s.cup, .wall = {}};
    ApartLip lip;
    suction::CupState state;
    double t_s = 0.0;
    std::uint32_t last = 0;
    const auto hold = [&](double depth_m, double duration_s) {
        for (const double end_s = t_s + duration_s; t_s < end_s; t_s += 1e-3) {
            (void)lip.step(model, state, s.wall.surface, cup_at(depth_m), {.time_s = t_s});
            if (const auto report = lip.take_report()) {
                last = report->number;
            }
        }
    };
    hold(0.001, 0.05);
    limpet_ros::CupState holds;
    holds.contact = last;
    holds.phase = limpet_ros::CupState::ATTACHED;
    holds.pressure_Pa = holds.mean_pressure_Pa = 65000.0;
    lip.receive(holds);
    hold(0.001, 0.01);
    EXPECT_EQ(state.status.phase, CupPhase::attached);
    hold(-0.05, 0.002);  // a thousand newtons: no vacuum holds that
    EXPECT_EQ(state.status.phase, CupPhase::free);
    hold(0.001, 0.002);  // touches again, and receives an older answer
    lip.receive(holds);
    hold(0.001, 0.002);
    EXPECT_EQ(state.status.phase, CupPhase::touching);
    limpet_ros::CupState missed = holds;
    missed.contact = last + 1000;  // of no report of ours
    lip.receive(missed);
    hold(0.001, 0.002);
    EXPECT_EQ(state.status.phase, CupPhase::touching);
}

TEST(SuctionCup, TheSameInputsAndSeedGiveTheSameStates) {
    const auto run = [](std::uint64_t seed) {
        scenario::Scenario s = scenario();
        s.seed = seed;
        SuctionCup cup(s);
        cup.command(true, false);
        std::vector<double> out;
        for (int k = 0; k < 600; ++k) {
            const suction::LipContact contact{.touches = k > 100,
                                              .gap_m = k > 100 ? -0.001 : 0.01,
                                              .press_N = k > 100 ? 200.0 : 0.0};
            (void)cup.feel(contact, 1.0 + 1e-3 * k);
            out.push_back(cup.state().status.pressure_Pa);
            out.push_back(cup.pressure().value.pressure_Pa);
            out.push_back(cup.state().status.seal_threshold_N);
        }
        return out;
    };
    EXPECT_EQ(run(1), run(1));
    EXPECT_NE(run(1), run(2));
}

// Eq. (5) by hand: attached when the pressure has fallen to 880 hPa, tau_1 ln(36325 / 23000).
TEST(SuctionCup, AttachesAfterThePapersDwell) {
    SuctionCup cup(scenario());
    cup.command(true, false);
    double attached_s = -1.0;
    for (int k = 0; k <= 1000 && attached_s < 0.0; ++k) {
        const double t_s = 1.0 + 1e-3 * k;
        const auto event = cup.feel({.touches = true, .gap_m = -0.001, .press_N = 500.0}, t_s);
        if (event && event->name == EventName::attached) {
            attached_s = t_s - 1.0;
        }
    }
    EXPECT_NEAR(attached_s, 0.33 * std::log(36325.0 / 23000.0), 3e-3);
    EXPECT_NEAR(cup.pressure().value.pressure_Pa, 88000.0, 1500.0);  // noise, ripple, 10 ms old
}

TEST(SuctionCup, TimeThatRunsBackBeginsAnew) {
    SuctionCup cup(scenario());
    cup.command(true, false);
    for (int k = 0; k < 1000; ++k) {
        (void)cup.feel({.touches = true, .gap_m = -0.001, .press_N = 500.0}, 10.0 + 1e-3 * k);
    }
    EXPECT_LT(cup.state().mean_pressure_Pa, 70000.0);
    (void)cup.feel({.gap_m = 1.0}, 1.0);
    EXPECT_NEAR(cup.state().mean_pressure_Pa, kAtmosphere_Pa, 1.0);
    EXPECT_EQ(cup.state().status.phase, CupPhase::free);
}

}  // namespace
}  // namespace limpet::ros
