// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "limpet/suction/cup.hpp"

/// Seals that leak more as they last and as their load rises and falls.
namespace limpet::suction {
namespace {

constexpr double kStep_s = 1e-3;

/// A cup that sealed, on metal whose fresh leak is 1 / tau_2 = 1 / 16 s.
struct Sealed {
    explicit Sealed(const CupParameters& with) : parameters(with) {
        surface.vacuum_pressure_Pa = 27500.0;
        surface.sealing_time_constant_s = 0.25;
        surface.unsealing_time_constant_s = 16.0;
        surface.seal_threshold_sigma = 0.0;
        state.random = RandomStream(1, 0, Stream::seal);
        contact.press_N = 100.0;
        input.pump_on = true;
        run(0.01);
        EXPECT_EQ(state.status.phase, CupPhase::sealing);
    }
    void run(double duration_s) {
        for (int k = 0; k < std::lround(duration_s / kStep_s); ++k) {
            (void)step(parameters, state, surface, contact, input, kStep_s);
            input.time_s += kStep_s;
        }
    }

    CupParameters parameters;
    Surface surface;
    CupState state;
    LipContact contact{.touches = true};
    CupInput input;
};

/// A leak of (1 + c t) / tau_2: P = P_atm - (P_atm - P_0) exp(-(t + c t^2 / 2) / tau_2).
TEST(SealWear, ACreepingSealUnsealsByTheClosedForm) {
    CupParameters parameters;
    parameters.seal_creep_1_s = 0.2;
    Sealed cup(parameters);
    cup.run(2.0);
    cup.input.pump_on = false;
    cup.run(kStep_s);
    const double age_s = cup.state.leak_growth / 0.2;
    EXPECT_NEAR(age_s, 2.01, 5e-3);
    const double begin_Pa = cup.state.mean_pressure_Pa;
    cup.run(8.0);
    const double exponent = (8.0 * (1.0 + 0.2 * age_s) + 0.5 * 0.2 * 8.0 * 8.0) / 16.0;
    const double expected_Pa = kAtmosphere_Pa - (kAtmosphere_Pa - begin_Pa) * std::exp(-exponent);
    EXPECT_NEAR(cup.state.mean_pressure_Pa, expected_Pa, 10.0);
}

/// Where the pump holds it: rates add, P = (P_vac / tau_1 + g P_atm / tau_2) / (1 / tau_1 + g /
/// tau_2) with g the growth. Both pressure models, the pneumatic with a leak that pressing does not
/// close, where S (P - P_ult) = C (1 + g) (P_atm - P).
TEST(SealWear, AWornSealHoldsTheVacuumThatItsLeakLeaves) {
    CupParameters parameters;
    parameters.seal_creep_1_s = 1.0;
    Sealed first_order(parameters);
    first_order.run(3.0);
    first_order.parameters.seal_creep_1_s = 1e-12;  // stays as it is
    const double growth = first_order.state.leak_growth;
    EXPECT_NEAR(growth, 3.0, 0.05);
    first_order.run(5.0);
    const double in = 1.0 / 0.25, more = growth / 16.0;
    EXPECT_NEAR(first_order.state.mean_pressure_Pa,
                (27500.0 * in + more * kAtmosphere_Pa) / (in + more), 1.0);

    parameters.pressure_model = 1;
    parameters.pressure.hose_bore_mm = 100.0;
    parameters.pressure.pump_stop_Pa = 100.0;
    Sealed pneumatic(parameters);
    pneumatic.surface.leak_clamping_exponent = 0.0;
    pneumatic.surface.leak_conductance_cm3_s = 60.0;
    pneumatic.run(3.0);
    pneumatic.parameters.seal_creep_1_s = 1e-12;
    pneumatic.run(5.0);
    const double pump = 14.0 / 60e3, leak = 60e-6 * (1.0 + pneumatic.state.leak_growth);
    EXPECT_NEAR(pneumatic.state.mean_pressure_Pa,
                (pump * 24000.0 + leak * kAtmosphere_Pa) / (pump + leak), 30.0);
}

/// A pull of amplitude A at f rises and falls by 4 A f in a second.
TEST(SealWear, VibrationWearsByWhatThePullRisesAndFalls) {
    CupParameters parameters;
    parameters.seal_wear_1_N = 1e-3;
    Sealed cup(parameters);
    constexpr double kAmplitude_N = 5.0, kRate_Hz = 10.0, kFor_s = 4.0;
    const double fresh = cup.state.leak_growth;
    for (int k = 0; k < std::lround(kFor_s / kStep_s); ++k) {
        cup.contact.pull_N = kAmplitude_N * std::sin(2.0 * kPi * kRate_Hz * k * kStep_s);
        cup.run(kStep_s);
    }
    EXPECT_NEAR(cup.state.leak_growth - fresh, 1e-3 * 4.0 * kAmplitude_N * kRate_Hz * kFor_s, 5e-3);
}

TEST(SealWear, ANewTouchBeginsFreshAndByDefaultNoneWears) {
    CupParameters parameters;
    parameters.seal_creep_1_s = 1.0;
    Sealed cup(parameters);
    cup.run(1.0);
    EXPECT_GT(cup.state.leak_growth, 0.9);
    cup.contact.let_go = LetGo::pulled;
    cup.contact.touches = false;
    cup.contact.gap_m = 0.01;
    cup.run(kStep_s);
    EXPECT_EQ(cup.state.status.phase, CupPhase::free);
    cup.contact = {.touches = true, .press_N = 100.0};
    cup.run(3 * kStep_s);
    EXPECT_TRUE(is_sealed(cup.state.status.phase));
    EXPECT_LT(cup.state.leak_growth, 0.01);
    Sealed fresh(CupParameters{});
    fresh.run(5.0);
    EXPECT_EQ(fresh.state.leak_growth, 0.0);
}

/// The moment of the lip's load comes to the leak, where that is asked for.
TEST(GradedSeal, OfAWholeCupLeaksByItsMoment) {
    const auto held_Pa = [](bool graded, double peel_N_m) {
        CupParameters parameters;
        parameters.pressure_model = 1;
        parameters.pressure.graded_seal = graded;
        Sealed cup(parameters);
        cup.contact.peel_N_m = peel_N_m;
        cup.run(5.0);
        return cup.state.mean_pressure_Pa;
    };
    EXPECT_GT(held_Pa(true, 2.0), held_Pa(true, 0.0) + 100.0);
    EXPECT_EQ(held_Pa(false, 2.0), held_Pa(false, 0.0));
}

}  // namespace
}  // namespace limpet::suction
