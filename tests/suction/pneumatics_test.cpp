// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/pneumatics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "limpet/core/frames.hpp"

namespace limpet::suction {
namespace {

constexpr double kRadius_m = 0.04;

/// A wall whose leak does not know the clamping, so that the law is linear but for the hose.
Surface tight_surface() {
    Surface surface;
    surface.pore_volume_cm3 = 0.0;
    surface.leak_conductance_cm3_s = 8.0;
    surface.leak_clamping_exponent = 0.0;
    return surface;
}

CupAir sealed(const PneumaticParameters& parameters, const Surface& surface) {
    return sealed_cup(parameters, surface, kRadius_m, 0.0, false);
}

double after(const Pump& pump, const CupAir& cup, double pressure_Pa, double duration_s,
             double step_s) {
    const int steps = static_cast<int>(std::lround(duration_s / step_s));
    for (int k = 0; k < steps; ++k) {
        pressure_Pa = pressure_after(pump, cup, pressure_Pa, step_s);
    }
    return pressure_Pa;
}

TEST(Pneumatics, WithAWideHoseAndAConstantLeakItIsEquationsFiveAndSix) {
    PneumaticParameters parameters;
    parameters.hose_bore_mm = 100.0;
    const CupAir cup = sealed(parameters, tight_surface());
    const double S = 14.0 / 60e3;
    const double C = 8e-6;
    const double V = 60e-6;
    const double vacuum_Pa = (S * 24000.0 + C * kAtmosphere_Pa) / (S + C);
    for (const double t_s : {0.1, 0.3, 1.0, 3.0}) {
        const double sealing_Pa =
            vacuum_Pa + (kAtmosphere_Pa - vacuum_Pa) * std::exp(-t_s * (S + C) / V);
        EXPECT_NEAR(after(pump_of(parameters, true), cup, kAtmosphere_Pa, t_s, 1e-3), sealing_Pa,
                    20.0);
        const double unsealing_Pa =
            kAtmosphere_Pa - (kAtmosphere_Pa - 30000.0) * std::exp(-t_s * C / V);
        EXPECT_NEAR(after(pump_of(parameters, false), cup, 30000.0, t_s, 1e-3), unsealing_Pa, 0.1);
    }
}

/// Without a leak and with a wide hose, t(P) of (V_0 + c (2 P - P_atm)) dP/dt = -S (P - P_ult):
/// S t = 2 c (P_atm - P) + (V_0 - c P_atm + 2 c P_ult) ln((P_atm - P_ult) / (P - P_ult)).
TEST(SoftCup, FallsByTheClosedFormAndInALineWhereItGivesWayWhole) {
    PneumaticParameters parameters;
    parameters.hose_bore_mm = 100.0;
    parameters.pump_ultimate_Pa = 5000.0;
    Surface surface = tight_surface();
    surface.leak_conductance_cm3_s = 0.0;
    const double S = 14.0 / 60e3;
    const double V = 60e-6;
    for (const double gives_way : {0.0, 0.4, 1.0}) {
        parameters.cup_gives_way = gives_way;
        const CupAir cup = sealed(parameters, surface);
        const double c = gives_way * V / kAtmosphere_Pa;
        for (const double P : {90000.0, 60000.0, 30000.0, 10000.0}) {
            const double t_s = (2.0 * c * (kAtmosphere_Pa - P) +
                                (V - c * kAtmosphere_Pa + 2.0 * c * 5000.0) *
                                    std::log((kAtmosphere_Pa - 5000.0) / (P - 5000.0))) /
                               S;
            const double here_Pa =
                pressure_after(pump_of(parameters, true), cup, kAtmosphere_Pa, t_s);
            EXPECT_NEAR(here_Pa, P, 60.0) << gives_way;
        }
    }
    // A line: half the time, half the vacuum, within 5 % of it; a rigid cup has 15 % more by then.
    const CupAir soft = sealed(parameters, surface);
    const double half = 0.5 * (kAtmosphere_Pa - pressure_after(pump_of(parameters, true), soft,
                                                               kAtmosphere_Pa, 0.4));
    EXPECT_NEAR(
        kAtmosphere_Pa - pressure_after(pump_of(parameters, true), soft, kAtmosphere_Pa, 0.2), half,
        0.05 * half);
}

TEST(SoftCup, ErrorFallsWithTheSquareOfTheStep) {
    PneumaticParameters parameters;
    parameters.cup_gives_way = 0.8;
    const Pump pump = pump_of(parameters, true);
    const CupAir cup = sealed(parameters, tight_surface());
    const double truth_Pa = after(pump, cup, kAtmosphere_Pa, 0.128, 1e-5);
    const double coarse_Pa = after(pump, cup, kAtmosphere_Pa, 0.128, 1e-3) - truth_Pa;
    const double fine_Pa = after(pump, cup, kAtmosphere_Pa, 0.128, 5e-4) - truth_Pa;
    EXPECT_NEAR(coarse_Pa / fine_Pa, 4.0, 0.8);
}

/// P V is kept: pulled at with N newtons at P_atm, P = P_atm V_0 / (V_0 + s N); let go again it is
/// P_atm, and no more where air leaked in meanwhile.
TEST(SoftCup, PulledItDrawsAVacuumOfItsOwn) {
    PneumaticParameters parameters;
    parameters.cup_stretch_cm3_N = 0.25;
    Surface surface = tight_surface();
    surface.leak_conductance_cm3_s = 0.0;
    SealedAir air{.surface = surface, .radius_m = kRadius_m, .pressure_Pa = kAtmosphere_Pa};
    double pull_N = 0.0;
    while (pull_N < 20.0) {
        air.press_before_N = -pull_N;
        pull_N += 0.5;
        air.press_N = -pull_N;
        air.pressure_Pa = Pneumatic::next_Pa(parameters, air, 1e-3);
        EXPECT_NEAR(air.pressure_Pa, kAtmosphere_Pa * 60.0 / (60.0 + 0.25 * pull_N), 1.0);
    }
    EXPECT_GT((kAtmosphere_Pa - air.pressure_Pa) * kPi * kRadius_m * kRadius_m, pull_N)
        << "it clings";
    surface.leak_conductance_cm3_s = 50.0;
    air.press_before_N = air.press_N;
    for (int k = 0; k < 500; ++k) {
        air.pressure_Pa = Pneumatic::next_Pa(parameters, air, 1e-3);
    }
    air.press_N = 0.0;
    air.pressure_Pa = Pneumatic::next_Pa(parameters, air, 1e-3);
    EXPECT_NEAR(air.pressure_Pa, kAtmosphere_Pa, 1.0);
}

/// P V is kept of a cup that gives way as well, whose volume the vacuum squeezes; a heavier
/// atmosphere squeezes it no further than whole.
TEST(SoftCup, PulledAndSqueezedItKeepsItsAir) {
    PneumaticParameters parameters;
    parameters.cup_stretch_cm3_N = 0.25;
    parameters.cup_gives_way = 1.0;
    Surface surface = tight_surface();
    surface.leak_conductance_cm3_s = 0.0;
    for (const double ambient_Pa : {kAtmosphere_Pa, 1.1 * kAtmosphere_Pa}) {
        SealedAir air{.surface = surface,
                      .radius_m = kRadius_m,
                      .press_N = -40.0,
                      .pressure_Pa = 0.5 * ambient_Pa,
                      .ambient_Pa = ambient_Pa};
        const double P = Pneumatic::next_Pa(parameters, air, 1e-6);
        const double air_before = 0.5 * ambient_Pa * 30.0;  // half squeezed out
        EXPECT_NEAR(P * (60.0 + 10.0 - 60.0 * (ambient_Pa - P) / ambient_Pa), air_before,
                    1e-3 * air_before);
        parameters.pump_ultimate_Pa = 100.0;
        air.press_before_N = air.press_N = 20.0;
        air.pump_running = true;
        for (int k = 0; k < 5000; ++k) {
            air.pressure_Pa = Pneumatic::next_Pa(parameters, air, 1e-3);
            ASSERT_GE(air.pressure_Pa, 100.0);
        }
        EXPECT_LT(air.pressure_Pa, 2000.0);
    }
}

TEST(Pneumatics, StepHardlyMattersWhateverFlows) {
    PneumaticParameters parameters;
    parameters.partial_seal_area_mm2 = 0.3;
    for (const bool valve : {false, true}) {
        for (const bool running : {false, true}) {
            const Pump pump = pump_of(parameters, running);
            const CupAir cup = sealed_cup(parameters, Surface{}, kRadius_m, 10.0, valve);
            for (const double start_Pa : {kAtmosphere_Pa, 30000.0}) {
                const double fine_Pa = after(pump, cup, start_Pa, 0.1, 1e-5);
                EXPECT_NEAR(after(pump, cup, start_Pa, 0.1, 2.5e-4), fine_Pa, 1.0);
                EXPECT_NEAR(after(pump, cup, start_Pa, 0.1, 1e-3), fine_Pa, 8.0);
                EXPECT_NEAR(after(pump, cup, start_Pa, 0.1, 0.1), fine_Pa, 8.0);
            }
        }
    }
}

TEST(Pneumatics, ErrorFallsWithTheSquareOfTheStep) {
    const Pump pump = pump_of({}, true);
    const CupAir cup = sealed({}, Surface{});
    const double exact_Pa = after(pump, cup, kAtmosphere_Pa, 0.256, 1e-5);
    const double coarse = std::abs(after(pump, cup, kAtmosphere_Pa, 0.256, 1e-3) - exact_Pa);
    const double fine = std::abs(after(pump, cup, kAtmosphere_Pa, 0.256, 5e-4) - exact_Pa);
    EXPECT_NEAR(coarse / fine, 4.0, 0.5);
}

TEST(Pneumatics, NothingBlowsUpHoweverOpenTheCupIs) {
    PneumaticParameters parameters;
    parameters.cup_volume_cm3 = 0.1;
    parameters.valve_bore_mm = 50.0;
    const CupAir cup = sealed_cup(parameters, tight_surface(), kRadius_m, -500.0, true);
    double pressure_Pa = 20000.0;
    for (int k = 0; k < 100; ++k) {
        const double next_Pa = pressure_after(pump_of(parameters, true), cup, pressure_Pa, 1e-3);
        ASSERT_GE(next_Pa, std::min(pressure_Pa, 0.9 * kAtmosphere_Pa));
        ASSERT_LE(next_Pa, kAtmosphere_Pa + 1e-6);
        pressure_Pa = next_Pa;
    }
    EXPECT_NEAR(pressure_Pa, kAtmosphere_Pa, 100.0);
}

TEST(Pneumatics, AChokedHoleFlowsByTheTextbook) {
    // 0.6 A P sqrt(k / (R T)) (2/(k+1))^((k+1)/(2(k-1))) is its mass flow, times R T as throughput
    const double RT = 287.05 * 293.15;
    const double mass_kg_s = 0.6 * 1e-6 * 1e5 * std::sqrt(1.4 / RT) * std::pow(1.0 / 1.2, 3.0);
    EXPECT_NEAR(orifice_flow_Pa_m3_s(1e-6, 1e5, 1e4), mass_kg_s * RT, 1e-9 * mass_kg_s * RT);
    EXPECT_EQ(orifice_flow_Pa_m3_s(1e-6, 1e5, 1e4), orifice_flow_Pa_m3_s(1e-6, 1e5, 5e4));
    EXPECT_LT(orifice_flow_Pa_m3_s(1e-6, 1e5, 9e4), orifice_flow_Pa_m3_s(1e-6, 1e5, 5e4));
    EXPECT_EQ(orifice_flow_Pa_m3_s(1e-6, 1e5, 9e4), -orifice_flow_Pa_m3_s(1e-6, 9e4, 1e5));
    // for small differences of pressure it is Bernoulli's: A Cd sqrt(2 rho dP) times R T
    const double bernoulli = 0.6 * 1e-6 * std::sqrt(2.0 * 1e5 / RT * 500.0) * RT;
    EXPECT_NEAR(orifice_flow_Pa_m3_s(1e-6, 1e5, 99500.0), bernoulli, 0.01 * bernoulli);
}

TEST(Pneumatics, TheValveEmptiesACupInOrificeTime) {
    // facts.md item 20: a 2 mm orifice refills 60 cm^3 from 275 to 980 hPa in 0.12 s
    double pressure_Pa = 27500.0;
    const CupAir cup = sealed_cup({}, tight_surface(), kRadius_m, 0.0, true);
    double t_s = 0.0;
    for (; pressure_Pa < 98000.0 && t_s < 1.0; t_s += 1e-3) {
        pressure_Pa = pressure_after(pump_of({}, false), cup, pressure_Pa, 1e-3);
    }
    EXPECT_NEAR(t_s, 0.12, 0.03);
}

TEST(Pneumatics, TheLeakClosesAsTheLipIsPressed) {
    const Surface concrete;
    EXPECT_NEAR(leak_conductance_m3_s(concrete, 100.0), 347e-6, 1e-12);
    EXPECT_NEAR(leak_conductance_m3_s(concrete, 205.0) / leak_conductance_m3_s(concrete, 100.0),
                std::pow(0.5, 0.425), 1e-9);
    EXPECT_TRUE(std::isfinite(leak_conductance_m3_s(concrete, 0.0)));
    EXPECT_EQ(leak_conductance_m3_s(tight_surface(), 0.0), 8e-6);
}

/// Steady pressure on concrete.
double steady_Pa(const PneumaticParameters& parameters, double press_N = 0.0) {
    const CupAir cup = sealed_cup(parameters, Surface{}, kRadius_m, press_N, false);
    return after(pump_of(parameters, true), cup, kAtmosphere_Pa, 20.0, 1e-3);
}

TEST(Pneumatics, APartialSealTakesVacuumUntilTheCupNoLongerAttaches) {
    PneumaticParameters parameters;
    double before_Pa = steady_Pa(parameters);
    for (const double area_mm2 : {0.2, 0.5, 1.0, 2.0, 3.0}) {
        parameters.partial_seal_area_mm2 = area_mm2;
        const double pressure_Pa = steady_Pa(parameters);
        EXPECT_GT(pressure_Pa, before_Pa + 500.0);
        // what the pump takes at that pressure is what hole and pores let in
        const CupAir cup = sealed_cup(parameters, Surface{}, kRadius_m, 0.0, false);
        const double manifold_Pa = manifold_pressure_Pa(
            pump_of(parameters, true), std::span(&cup, 1), std::span(&pressure_Pa, 1));
        const double clamping_N = (kAtmosphere_Pa - pressure_Pa) * kPi * kRadius_m * kRadius_m;
        const double in =
            orifice_flow_Pa_m3_s(1e-6 * area_mm2, kAtmosphere_Pa, pressure_Pa) +
            leak_conductance_m3_s(Surface{}, clamping_N) * (kAtmosphere_Pa - pressure_Pa);
        EXPECT_NEAR(14.0 / 60e3 * (manifold_Pa - 24000.0), in, 1e-4);
        before_Pa = pressure_Pa;
    }
    EXPECT_GT(before_Pa, 88000.0);
}

TEST(Pneumatics, PullingOnTheCupCostsVacuum) {
    EXPECT_GT(steady_Pa({}, -60.0), steady_Pa({}, 0.0) + 1000.0);
    EXPECT_LT(steady_Pa({}, 60.0), steady_Pa({}, 0.0) - 1000.0);
}

TEST(GradedSeal, IsTheIntegralAroundTheLip) {
    for (const double e : {0.0, 0.2, 0.5, 0.9}) {
        const double rest = 1.0 - e * e;
        EXPECT_NEAR(graded_leak(1.0, e).ratio, 1.0 / std::sqrt(rest), 1e-6);
        EXPECT_NEAR(graded_leak(2.0, e).ratio, std::pow(rest, -1.5), 1e-4);
        EXPECT_NEAR(graded_leak(1.0, e).by_grade, e * std::pow(rest, -1.5), 1e-4);
    }
    // 2F1(m/2, (m+1)/2; 1; e^2) by its series
    const double m = 0.425, e = 0.6;
    double sum = 0.0, term = 1.0;
    for (int k = 0; k < 200; ++k) {
        sum += term;
        term *= (0.5 * m + k) * (0.5 * (m + 1.0) + k) / ((k + 1.0) * (k + 1.0)) * e * e;
    }
    EXPECT_NEAR(graded_leak(m, e).ratio, sum, 1e-9);
    EXPECT_TRUE(std::isfinite(graded_leak(0.95, 5.0).ratio));
}

/// Where the lip's law lets go by peeling, M = N R / 2, one side of it bears nothing but itself.
TEST(GradedSeal, AMomentCostsVacuumAndTheStepStaysOfSecondOrder) {
    const Pump pump = pump_of({}, true);
    const auto cup_with = [](double moment_N_m) {
        CupAir cup = sealed({}, Surface{});
        cup.uneven_N = 2.0 * moment_N_m / kRadius_m;
        return cup;
    };
    double before_Pa = 0.0;
    for (const double moment_N_m : {0.0, 0.8, 1.6, 2.4}) {
        const CupAir cup = cup_with(moment_N_m);
        const double pressure_Pa = after(pump, cup, kAtmosphere_Pa, 20.0, 1e-3);
        EXPECT_GT(pressure_Pa, before_Pa);
        const double clamping_N = (kAtmosphere_Pa - pressure_Pa) * kPi * kRadius_m * kRadius_m;
        const double manifold_Pa =
            manifold_pressure_Pa(pump, std::span(&cup, 1), std::span(&pressure_Pa, 1));
        const double grade = 2.0 * moment_N_m / kRadius_m / (clamping_N + 5.0);
        ASSERT_LT(grade, 0.98);
        EXPECT_NEAR(14.0 / 60e3 * (manifold_Pa - 24000.0),
                    leak_conductance_m3_s(Surface{}, clamping_N) *
                        graded_leak(Surface{}.leak_clamping_exponent, grade).ratio *
                        (kAtmosphere_Pa - pressure_Pa),
                    1e-4);
        before_Pa = pressure_Pa;
    }
    const CupAir cup = cup_with(2.0);
    const auto at = [&](double dt_s) { return after(pump, cup, 75000.0, 0.256, dt_s); };
    const double exact_Pa = at(1e-5);
    EXPECT_NEAR(std::abs(at(1e-3) - exact_Pa) / std::abs(at(5e-4) - exact_Pa), 4.0, 0.5);
}

TEST(Pneumatics, ALongHoseIsSlowAndABlockedOneSucksNothing) {
    PneumaticParameters wide;
    PneumaticParameters narrow;
    narrow.hose_bore_mm = 1.0;
    narrow.hose_length_m = 2.0;
    PneumaticParameters blocked;
    blocked.hose_bore_mm = 0.0;
    const Surface surface = tight_surface();
    const auto at = [&](const PneumaticParameters& parameters, double t_s) {
        return after(pump_of(parameters, true), sealed(parameters, surface), kAtmosphere_Pa, t_s,
                     1e-3);
    };
    EXPECT_GT(at(narrow, 0.5), at(wide, 0.5) + 10000.0);
    EXPECT_NEAR(at(blocked, 1.0), kAtmosphere_Pa, 1e-6);
}

/// A hose's throughput from 260 hPa and a drop above it.
double through_hose(double bore_mm, double length_m, double drop_Pa) {
    return hose_flow_Pa_m3_s(hose_of(bore_mm, length_m), 26000.0 + drop_Pa, 26000.0);
}

TEST(HoseFlow, IsPoiseuillesBelow) {
    // pi d^4 / (128 mu L) times the mean pressure and the drop: 31 hPa through 2 m of 1.5 mm
    const double d4_m4 = std::pow(1.5e-3, 4);
    const double conductance_m3_Pa_s = kPi * d4_m4 / (128.0 * 1.81e-5 * 2.0);
    for (const double drop_Pa : {0.01, 10.0, 1000.0, 3100.0}) {
        const double closed = conductance_m3_Pa_s * (26000.0 + 0.5 * drop_Pa) * drop_Pa;
        EXPECT_NEAR(through_hose(1.5, 2.0, drop_Pa) / closed, 1.0, 0.02) << drop_Pa;
        EXPECT_EQ(hose_flow_Pa_m3_s(hose_of(1.5, 2.0), 26000.0, 26000.0 + drop_Pa),
                  -through_hose(1.5, 2.0, drop_Pa));
    }
    // Without a length it is Sampson's orifice, d^3 dP / (24 mu).
    const double sampson = 1e-12 / (24.0 * 1.81e-5) * 26000.0 * 1e-4;
    EXPECT_NEAR(through_hose(0.1, 0.0, 1e-4) / sampson, 1.0, 1e-3);
}

TEST(HoseFlow, IsWeymouthsAbove) {
    for (const double length_m : {0.0, 0.05, 0.5, 2.0}) {
        const double G =
            0.25 * kPi * 1e-4 * std::sqrt(287.05 * 293.15 / (0.03 * length_m / 0.01 + 1.5));
        const double closed = G * std::sqrt(9e4 * 9e4 - 26000.0 * 26000.0);
        EXPECT_NEAR(through_hose(10.0, length_m, 64000.0) / closed, 1.0, 2e-3) << length_m;
    }
}

TEST(HoseFlow, BetweenTheTwoItIsSmoothAndBelowBoth) {
    // 4 mm x 0.5 m: the two laws meet at Re 2133, a throughput of Re pi d mu R T / 4
    const double meet = 2133.3 * 0.25 * kPi * 4e-3 * 1.81e-5 * 287.05 * 293.15;
    const double G = 0.25 * kPi * 16e-6 * std::sqrt(287.05 * 293.15 / (0.03 * 0.5 / 4e-3 + 1.5));
    const double K = kPi * std::pow(4e-3, 4) / (256.0 * 1.81e-5 * 0.5);
    bool below = false, above = false;
    double before = 0.0, slope_before = 0.0;
    for (double drop_Pa = 20.0; drop_Pa < 4000.0; drop_Pa *= 1.02) {
        const double flow = through_hose(4.0, 0.5, drop_Pa);
        const double squares = (26000.0 + drop_Pa) * (26000.0 + drop_Pa) - 26000.0 * 26000.0;
        EXPECT_LT(flow, K * squares);
        EXPECT_LT(flow, G * std::sqrt(squares));
        EXPECT_GT(flow, 0.75 * std::min(K * squares, G * std::sqrt(squares)));
        const double slope = std::log(flow / before) / std::log(1.02);
        if (before > 0.0 && slope_before > 0.0) {
            EXPECT_LT(slope, slope_before + 1e-3);  // from 1 down to 1/2
            EXPECT_GT(slope, slope_before - 0.02);  // no corner
        }
        slope_before = before > 0.0 ? slope : 0.0;
        before = flow;
        (flow < meet ? below : above) = true;
    }
    EXPECT_TRUE(below && above);
}

/// Valve, gap and leak have no laminar range of their own to miss: what creeps through a round hole
/// (Sampson) is more than what the orifice's law lets through, down to 0.2 % of equal pressures.
TEST(HoseFlow, HolesFromATenthOfAMillimetreAreOrificesThroughout) {
    for (const double bore_m : {1e-4, 1e-3, 2e-3}) {
        for (const double ratio : {0.998, 0.99, 0.9, 0.5}) {
            const double up_Pa = 26000.0, down_Pa = ratio * up_Pa;
            const double creeping =
                std::pow(bore_m, 3) / (48.0 * 1.81e-5) * (up_Pa * up_Pa - down_Pa * down_Pa);
            EXPECT_GT(creeping, orifice_flow_Pa_m3_s(0.25 * kPi * bore_m * bore_m, up_Pa, down_Pa));
        }
    }
}

TEST(Pneumatics, TheManifoldBalancesPumpAndHose) {
    PneumaticParameters parameters;
    parameters.hose_bore_mm = 1.5;
    parameters.hose_length_m = 1.0;
    const CupAir cup = sealed(parameters, tight_surface());
    const double cup_Pa = 80000.0;
    const double manifold_Pa =
        manifold_pressure_Pa(pump_of(parameters, true), std::span(&cup, 1), std::span(&cup_Pa, 1));
    const double hose = hose_flow_Pa_m3_s(hose_of(1.5, 1.0), cup_Pa, manifold_Pa);
    EXPECT_NEAR(hose, 14.0 / 60e3 * (manifold_Pa - 24000.0), 1e-3 * hose);
}

/// Two cups on one pump.
class TwoCups : public testing::Test {
protected:
    void run(bool pump_on, double duration_s, double step_s = 1e-3) {
        const int steps = static_cast<int>(std::lround(duration_s / step_s));
        for (int k = 0; k < steps; ++k) {
            advance_network(pump_of(parameters_, pump_on), cups_, pressures_Pa_, step_s);
        }
    }
    PneumaticParameters parameters_;
    std::array<CupAir, 2> cups_;
    std::array<double, 2> pressures_Pa_ = {kAtmosphere_Pa, kAtmosphere_Pa};
};

TEST_F(TwoCups, BothGoodTheyShareThePump) {
    cups_ = {sealed(parameters_, tight_surface()), sealed(parameters_, tight_surface())};
    run(true, 0.3);
    EXPECT_NEAR(pressures_Pa_[0], pressures_Pa_[1], 1e-6);
    PneumaticParameters half = parameters_;  // alone on half a pump: the same, but for the hose
    half.pump_speed_L_min /= 2.0;
    EXPECT_NEAR(
        pressures_Pa_[0],
        after(pump_of(half, true), sealed(half, tight_surface()), kAtmosphere_Pa, 0.3, 1e-3),
        500.0);
}

TEST_F(TwoCups, OneOffTheWallTakesTheOthersVacuumUnlessItsHoseIsNarrow) {
    cups_ = {sealed(parameters_, tight_surface()), cup_off_the_wall(parameters_, 0.01)};
    run(true, 5.0);
    EXPECT_GT(pressures_Pa_[0], 88000.0);

    parameters_.hose_bore_mm = 0.6;  // a restrictor for each cup, as multi-cup grippers have
    cups_ = {sealed(parameters_, tight_surface()), cup_off_the_wall(parameters_, 0.01)};
    run(true, 5.0);
    EXPECT_LT(pressures_Pa_[0], 60000.0);
    EXPECT_GT(pressures_Pa_[1], 95000.0);
}

TEST_F(TwoCups, WithThePumpOffAirMovesFromOneToTheOtherAndNoneIsLost) {
    Surface airtight = tight_surface();
    airtight.leak_conductance_cm3_s = 0.0;
    cups_ = {sealed(parameters_, airtight), sealed(parameters_, airtight)};
    cups_[1].volume_m3 *= 2.0;
    pressures_Pa_ = {90000.0, 30000.0};
    run(false, 2.0);
    EXPECT_NEAR(pressures_Pa_[0], 50000.0, 50.0);
    EXPECT_NEAR(pressures_Pa_[1], 50000.0, 50.0);
}

TEST_F(TwoCups, LongStepsAreDamped) {
    cups_ = {sealed(parameters_, tight_surface()), sealed_cup(parameters_, {}, 0.04, 0.0, false)};
    const auto start = pressures_Pa_;
    run(true, 1.0, 2.5e-4);
    const auto fine = pressures_Pa_;
    pressures_Pa_ = start;
    run(true, 1.0, 0.05);
    EXPECT_NEAR(pressures_Pa_[0], fine[0], 60.0);
    EXPECT_NEAR(pressures_Pa_[1], fine[1], 60.0);
}

}  // namespace
}  // namespace limpet::suction
