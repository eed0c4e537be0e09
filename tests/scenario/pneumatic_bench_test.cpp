// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "limpet/identification/identification.hpp"
#include "limpet/scenario/parts.hpp"
#include "limpet/suction/cup.hpp"

namespace limpet::scenario {
namespace {

/// A row of the paper's Table II, written down once more.
struct TableTwo {
    const char* name;
    double vacuum_Pa, tau_1_s, tau_1_tolerance_s, tau_2_s, tau_2_tolerance_s;
};
void PrintTo(const TableTwo& row, std::ostream* out) {
    *out << row.name;
}

/// Second of pressing, then four with the pump on, then as long as it takes.
constexpr double kOn_s = 1.0;
constexpr double kOff_s = 5.0;
constexpr double kPress_N = 20.0;

class PneumaticBench : public testing::TestWithParam<TableTwo> {
protected:
    /// A cup with the shipped pump, pressed on a shipped surface by hand.
    static identification::PressureTrace press_and_release(double step_s) {
        const TableTwo& row = GetParam();
        suction::Surface surface = load_surface(row.name, LIMPET_SOURCE_DIR "/data");
        surface.seal_threshold_median_N = 10.0;
        surface.seal_threshold_sigma = 0.0;
        suction::CupModel model;
        model.parameters.pressure_model = 1;
        EXPECT_EQ(suction::pressure_models()[1].name, suction::Pneumatic::kName);
        suction::CupState state;
        state.random = RandomStream(1, 0, Stream::seal);
        Kinematics cup;
        identification::PressureTrace trace;
        const int steps_a_sample = static_cast<int>(std::lround(0.01 / step_s));
        const double end_s = kOff_s + 4.0 * row.tau_2_s;
        for (int k = 0; k * step_s < end_s; ++k) {
            const double t_s = k * step_s;
            if (k % steps_a_sample == 0) {
                trace.t_s.push_back(t_s);
                trace.pressure_Pa.push_back(state.mean_pressure_Pa);
            }
            cup.p_WF_m.x() = t_s < kOn_s ? -0.01 : kPress_N / model.parameters.lip.stiffness_N_m;
            const suction::CupInput input{
                .time_s = t_s, .press_N = kPress_N, .pump_on = t_s < kOff_s};
            (void)step(model, state, surface, cup, input, step_s);
        }
        return trace;
    }
};

TEST_P(PneumaticBench, OnePumpGivesTableTwoWithinItsTolerances) {
    const TableTwo& row = GetParam();
    const identification::PressureFit fit = identify_pressure(press_and_release(1e-3));
    ASSERT_TRUE(fit.vacuum_Pa && fit.sealing_time_s && fit.unsealing_time_s);
    EXPECT_NEAR(fit.vacuum_Pa->value, row.vacuum_Pa, 0.015 * row.vacuum_Pa);  // none is given
    EXPECT_NEAR(fit.sealing_time_s->value, row.tau_1_s, row.tau_1_tolerance_s);
    EXPECT_NEAR(fit.unsealing_time_s->value, row.tau_2_s, row.tau_2_tolerance_s);
    EXPECT_NEAR(fit.atmosphere_Pa->value, kAtmosphere_Pa,
                500.0);  // concrete's tail is no exponential
    EXPECT_NEAR(fit.sealing_begins_s->value, kOn_s, 0.02);
    EXPECT_NEAR(fit.unsealing_begins_s->value, kOff_s, 0.3);  // metal's pump may rest by then
}

TEST_P(PneumaticBench, StepDoesNotMatter) {
    const identification::PressureTrace coarse = press_and_release(1e-3);
    const identification::PressureTrace fine = press_and_release(2.5e-4);
    ASSERT_EQ(coarse.t_s.size(), fine.t_s.size());
    double worst_Pa = 0.0;
    for (std::size_t i = 0; i < coarse.t_s.size(); ++i) {
        worst_Pa = std::max(worst_Pa, std::abs(coarse.pressure_Pa[i] - fine.pressure_Pa[i]));
    }
    // The touch is seen up to a step later: 1 ms of 3 kPa/10 ms, and of the pump's switch.
    EXPECT_LT(worst_Pa, 350.0);
}

INSTANTIATE_TEST_SUITE_P(TableII, PneumaticBench,
                         testing::Values(TableTwo{"porous_concrete", 65000, 0.33, 0.03, 0.40, 0.03},
                                         TableTwo{"cinder_block", 27500, 0.35, 0.03, 7.5, 0.5},
                                         TableTwo{"turbine_blade", 26500, 0.25, 0.03, 8.0, 0.5},
                                         TableTwo{"metal", 27500, 0.25, 0.03, 16.0, 1.0}),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(PneumaticSurfaces, OnlyMetalPassesTheVacuumSwitch) {
    const suction::PneumaticParameters parameters;
    for (const char* name : {"porous_concrete", "cinder_block", "turbine_blade", "metal"}) {
        const suction::CupAir cup = sealed_cup(
            parameters, load_surface(name, LIMPET_SOURCE_DIR "/data"), 0.04, kPress_N, false);
        double pressure_Pa = kAtmosphere_Pa;
        for (int k = 0; k < 10000; ++k) {
            pressure_Pa = pressure_after(pump_of(parameters, true), cup, pressure_Pa, 1e-3);
        }
        EXPECT_EQ(pressure_Pa < parameters.pump_stop_Pa, std::string(name) == "metal") << name;
    }
}

}  // namespace
}  // namespace limpet::scenario
