// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <thread>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

/// A vehicle of two masses on a line that runs into a wall: the closed world against which the
/// impact of the whole vehicle is held. Spring, damper, pre-load and stops of the slider between
/// them, the lip's spring and damper before them, and a wall that yields and weighs nothing; no
/// rotors, no control.
struct TwoMasses {
    double slider_peak_N = 0.0;
    double lip_peak_N = 0.0;
};

TwoMasses two_masses(const scenario::Scenario& scenario, double speed_m_s) {
    const vehicle::SliderParameters& slider = scenario.airframe.slider;
    const suction::LipParameters& lip = scenario.cup.lip;
    const double front_kg = slider.mass_kg + scenario.airframe.cup.mass_kg;
    const double back_kg = scenario.airframe.mass_kg - front_kg;
    constexpr double kDt_s = 1e-6;
    double back_m = 0.0;
    double front_m = 0.0;
    double back_m_s = speed_m_s;
    double front_m_s = speed_m_s;
    double lip_m = 0.0;
    TwoMasses peak;
    for (double t_s = 0.0; t_s < 0.2; t_s += kDt_s) {
        const double squeeze_m = back_m - front_m;
        const double squeeze_m_s = back_m_s - front_m_s;
        double slider_N = slider.preload_N + slider.stiffness_N_m * squeeze_m +
                          slider.damping_N_s_m * squeeze_m_s;
        if (squeeze_m < 0.0) {  // outer stop
            slider_N += std::min(0.0, slider.stop_stiffness_N_m * squeeze_m +
                                          slider.stop_damping_N_s_m * squeeze_m_s);
        }
        double lip_N = 0.0;
        if (front_m > 0.0) {
            const bool rigid = scenario.wall.compliance_m_N == 0.0;
            const double wall_N_m = rigid ? 0.0 : 1.0 / scenario.wall.compliance_m_N;
            lip_m = rigid ? front_m : lip_m;
            const double beyond_m = std::max(0.0, lip_m - lip.hard_depth_m);
            const double spring_N =
                lip.stiffness_N_m * (lip_m - beyond_m) + lip.hard_stiffness_N_m * beyond_m;
            const double damping_N_s_m =
                lip.damping_N_s_m * std::min(1.0, lip_m / lip.damping_depth_m);
            // The wall's push is that of the lip: by it the lip's own rate.
            const double wall_N = wall_N_m * (front_m - lip_m);
            const double lip_m_s =
                rigid ? front_m_s : (wall_N - spring_N) / std::max(damping_N_s_m, 0.01);
            lip_N = std::max(0.0, rigid ? spring_N + damping_N_s_m * lip_m_s : wall_N);
            lip_m += rigid ? 0.0 : lip_m_s * kDt_s;
        }
        peak.slider_peak_N = std::max(peak.slider_peak_N, slider_N);
        peak.lip_peak_N = std::max(peak.lip_peak_N, lip_N);
        back_m_s -= slider_N / back_kg * kDt_s;
        front_m_s += (slider_N - lip_N) / front_kg * kDt_s;
        back_m += back_m_s * kDt_s;
        front_m += front_m_s * kDt_s;
    }
    return peak;
}

std::vector<std::string> touch_at(double speed_m_s, double step_s = 2.5e-4) {
    return {"guidance.dock_speed_m_s=" + std::to_string(speed_m_s), "guidance.attempts=1",
            "guidance.pre_distance_m=1.0", "wall.surface=spalled_concrete",
            "simulation.touch_step_s=" + std::to_string(step_s)};
}

class ImpactAt : public testing::TestWithParam<double> {};

TEST_P(ImpactAt, AgreesWithTwoMasses) {
    const auto model = model_of("perch_concrete", touch_at(GetParam()));
    const Metrics m = trace(model).result.metrics;
    const TwoMasses reference = two_masses(*model->scenario, m.impact_speed_m_s);
    EXPECT_NEAR(m.impact_force_N, reference.slider_peak_N, 0.05 * reference.slider_peak_N);
    EXPECT_NEAR(m.cup_press_max_N, reference.lip_peak_N, 0.10 * reference.lip_peak_N);
}

INSTANTIATE_TEST_SUITE_P(Speeds, ImpactAt, testing::Values(0.2, 0.4, 0.6, 0.8, 1.0, 1.1, 1.2));

/// The whole vehicle has lip and wall as one spring and damper; here they are two.
TEST(Impact, OnAWallThatYieldsIsThatOfAThirdSpring) {
    double before_N = std::numeric_limits<double>::infinity();
    for (const char* wall : {"1e-5", "5e-5", "2e-4"}) {
        auto settings = touch_at(0.8);
        settings.push_back("wall.compliance_m_N=" + std::string(wall));
        const auto model = model_of("perch_concrete", settings);
        const Metrics m = trace(model).result.metrics;
        const TwoMasses reference = two_masses(*model->scenario, m.impact_speed_m_s);
        EXPECT_NEAR(m.impact_force_N, reference.slider_peak_N, 0.05 * reference.slider_peak_N);
        EXPECT_NEAR(m.cup_press_max_N, reference.lip_peak_N, 0.10 * reference.lip_peak_N) << wall;
        EXPECT_LT(m.cup_press_max_N, before_N);
        before_N = m.cup_press_max_N;
    }
}

TEST(Impact, PeakConvergesWithTheStep) {
    const Metrics coarse = trace(model_of("perch_concrete", touch_at(1.1, 2.5e-4))).result.metrics;
    const Metrics fine = trace(model_of("perch_concrete", touch_at(1.1, 1.25e-4))).result.metrics;
    EXPECT_NEAR(coarse.cup_press_max_N, fine.cup_press_max_N, 0.05 * fine.cup_press_max_N);
    EXPECT_NEAR(coarse.impact_force_N, fine.impact_force_N, 0.05 * fine.impact_force_N);
    EXPECT_NE(coarse.cup_press_max_N, fine.cup_press_max_N);  // the step did change
}

/// The default step against one of 0.02 ms.
TEST(Impact, PeaksAtTheDefaultStepAreTheConvergedOnes) {
    for (const char* scenario : {"pendulum_concrete", "perch_concrete"}) {
        const std::vector<std::string> until_held = {"simulation.time_limit_s=6"};
        const Metrics coarse = trace(model_of(scenario, until_held)).result.metrics;
        const Metrics fine = trace(model_of(scenario, {until_held[0], "simulation.step_s=0.0001",
                                                       "simulation.touch_step_s=0.00002"}))
                                 .result.metrics;
        EXPECT_NEAR(coarse.cup_press_max_N, fine.cup_press_max_N, 0.01 * fine.cup_press_max_N);
        EXPECT_NEAR(coarse.impact_force_N, fine.impact_force_N, 0.01 * fine.impact_force_N);
    }
}

/// On an overhang the lip is met aslant and slides: friction bears what spring and damper have
/// together, or the shear spring is wound up at every step.
TEST(Impact, PeaksOnAnOverhangAreTheConvergedOnes) {
    for (const char* lean : {"-15", "-10", "10"}) {
        const auto peaks = [lean](const char* touch_step_s) {
            return trace(
                       model_of("perch_concrete",
                                {"wall.lean_deg=" + std::string(lean), "simulation.time_limit_s=6",
                                 "simulation.touch_step_s=" + std::string(touch_step_s)}))
                .result.metrics;
        };
        const Metrics coarse = peaks("0.00025"), fine = peaks("0.00002");
        EXPECT_NEAR(coarse.cup_press_max_N, fine.cup_press_max_N, 0.005 * fine.cup_press_max_N);
        EXPECT_NEAR(coarse.impact_force_N, fine.impact_force_N, 0.005 * fine.impact_force_N);
    }
}

/// A slow press on a cup that hangs a little: its rim gives way first, and the shear has to turn
/// with it. At 1 ms it ends as at 0.1 ms.
TEST(Press, OfALipThatRocksDoesNotDependOnTheStep) {
    const auto press_N = [](const char* step_s) {
        return trace(model_of("press_metal", {"simulation.time_limit_s=3",
                                              "simulation.step_s=" + std::string(step_s),
                                              "simulation.touch_step_s=" + std::string(step_s)}))
            .result.metrics.cup_press_max_N;
    };
    EXPECT_NEAR(press_N("0.001"), press_N("0.0001"), 0.01 * press_N("0.0001"));
}

TEST(SlowTouch, NoneOfTwoHundredSealsOnConcrete) {
    constexpr unsigned kTouches = 200;
    const unsigned workers = std::max(1U, std::thread::hardware_concurrency());
    std::vector<int> sealed(workers, 0);
    std::vector<int> touched(workers, 0);
    std::vector<std::thread> threads;
    for (unsigned worker = 0; worker < workers; ++worker) {
        threads.emplace_back([&, worker] {
            for (unsigned seed = worker; seed < kTouches; seed += workers) {
                const auto model =
                    model_of("perch_concrete",
                             {"guidance.dock_speed_m_s=0.2", "guidance.attempts=1",
                              "guidance.pre_distance_m=0.5", "simulation.start_distance_m=1.0"},
                             seed);
                Flight flight(model);
                while (!flight.ended()) {
                    const guidance::EventList& events = flight.tick();
                    for (std::size_t k = 0; k < events.count; ++k) {
                        sealed[worker] += events.events[k].name == EventName::attached ? 1 : 0;
                    }
                }
                touched[worker] += flight.state().cup.touches > 0 ? 1 : 0;
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    int all_sealed = 0;
    int all_touched = 0;
    for (unsigned worker = 0; worker < workers; ++worker) {
        all_sealed += sealed[worker];
        all_touched += touched[worker];
    }
    EXPECT_EQ(all_touched, static_cast<int>(kTouches));
    EXPECT_EQ(all_sealed, 0);
}

}  // namespace
}  // namespace limpet::simulation
