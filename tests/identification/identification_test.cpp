// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/identification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/random.hpp"

namespace limpet::identification {
namespace {

using testing::HasSubstr;

/// A log of one press and release, as a bench or a flight gives it.
struct Bench {
    double atmosphere_Pa = 101900.0;  ///< a sensor off by 6 hPa
    double vacuum_Pa = 65600.0;
    double tau_1_s = 0.33;
    double tau_2_s = 0.40;
    double begin_s = 0.0;
    double on_s = 1.003;
    double off_s = 4.517;
    double end_s = 8.0;
    double step_s = 0.01;
    double ripple_Pa = 600.0;
    double ripple_Hz = 8.0;
    double noise_Pa = 100.0;
    double quantum_Pa = 50.0;
    bool gaps = false;  ///< dropped samples, a hole, uneven times
};

double truth_Pa(const Bench& b, double t_s) {
    const auto sealed = [&](double t) {
        return b.vacuum_Pa + (b.atmosphere_Pa - b.vacuum_Pa) * std::exp(-(t - b.on_s) / b.tau_1_s);
    };
    if (t_s < b.on_s) {
        return b.atmosphere_Pa;
    }
    if (t_s < b.off_s) {
        return sealed(t_s);
    }
    return b.atmosphere_Pa -
           (b.atmosphere_Pa - sealed(b.off_s)) * std::exp(-(t_s - b.off_s) / b.tau_2_s);
}

PressureTrace log_of(const Bench& b, std::uint32_t run) {
    RandomStream random(7, run, Stream::test);
    const double phase = 2.0 * kPi * random.uniform();
    PressureTrace trace;
    const int samples = static_cast<int>(std::ceil((b.end_s - b.begin_s) / b.step_s - 1e-9));
    for (int k = 0; k < samples; ++k) {
        const double t_s = b.begin_s + k * b.step_s;
        const double at_s = t_s + (b.gaps ? 0.4 * b.step_s * random.uniform() : 0.0);
        const bool lost = b.gaps && (random.uniform() < 0.1 || (t_s > 2.4 && t_s < 2.7));
        const double noise_Pa = b.noise_Pa * random.normal();
        if (lost) {
            continue;
        }
        const double mean_Pa = truth_Pa(b, at_s);
        const bool runs = at_s >= b.on_s && at_s < b.off_s;
        const double ripple_Pa = runs ? b.ripple_Pa * (b.atmosphere_Pa - mean_Pa) /
                                            (b.atmosphere_Pa - b.vacuum_Pa) *
                                            std::sin(2.0 * kPi * b.ripple_Hz * at_s + phase)
                                      : 0.0;
        const double raw_Pa = mean_Pa + ripple_Pa + noise_Pa;
        trace.t_s.push_back(at_s);
        trace.pressure_Pa.push_back(
            b.quantum_Pa > 0.0 ? b.quantum_Pa * std::round(raw_Pa / b.quantum_Pa) : raw_Pa);
    }
    return trace;
}

bool covers(const std::optional<Fitted>& fitted, double truth) {
    return fitted && std::abs(fitted->value - truth) <= fitted->half_width;
}

/// Searches step by shares of a number: a time of 1.7e9 s swamped tau_1 of 50 ms.
TEST(Identification, DoesNotDependOnWhereTimeBegins) {
    const PressureTrace log = log_of({.tau_1_s = 0.05, .tau_2_s = 0.12, .step_s = 0.026}, 1);
    const PressureFit here = identify_pressure(log);
    for (const double begins_s : {5.0, -40.0, 3600.0, 1.71e9}) {
        PressureTrace later = log;
        for (double& t_s : later.t_s) {
            t_s += begins_s;
        }
        const PressureFit there = identify_pressure(later);
        const double grid_s = 1e-6;  // of a double at 1.71e9 s, a few steps
        for (const auto member : {&PressureFit::sealing_time_s, &PressureFit::unsealing_time_s}) {
            ASSERT_TRUE(here.*member && there.*member);
            EXPECT_NEAR((there.*member)->value, (here.*member)->value, grid_s) << begins_s;
            EXPECT_NEAR((there.*member)->half_width, (here.*member)->half_width, grid_s);
        }
        EXPECT_NEAR(there.vacuum_Pa->value, here.vacuum_Pa->value, 0.01);
        EXPECT_NEAR(there.unsealing_begins_s->value - begins_s, here.unsealing_begins_s->value,
                    grid_s);
        EXPECT_NEAR(pressure_Pa(there.curve, begins_s + 2.0), pressure_Pa(here.curve, 2.0), 0.5);
        EXPECT_THAT(there.notes, testing::Eq(here.notes));
    }
}

TEST(Identification, UnitsThatAreNoneAreSaid) {
    PressureTrace slow = log_of({}, 1);
    for (double& t_s : slow.t_s) {
        t_s *= 1e3;
    }
    slow.t_s.resize(400);
    slow.pressure_Pa.resize(400);
    EXPECT_THAT(identify_pressure(slow).notes, testing::Contains(HasSubstr("milliseconds?")));
    PressureTrace hectopascals = log_of({}, 1);
    for (double& pressure_Pa : hectopascals.pressure_Pa) {
        pressure_Pa *= 0.01;
    }
    try {
        (void)identify_pressure(hectopascals);
        ADD_FAILURE() << "hPa went for Pa";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("hPa?"));
    }
}

TEST(Identification, WithoutNoiseItIsExact) {
    Bench bench;
    bench.ripple_Pa = bench.noise_Pa = bench.quantum_Pa = 0.0;
    const PressureFit fit = identify_pressure(log_of(bench, 0));
    EXPECT_NEAR(fit.atmosphere_Pa->value, bench.atmosphere_Pa, 0.01);
    EXPECT_NEAR(fit.vacuum_Pa->value, bench.vacuum_Pa, 0.01);
    EXPECT_NEAR(fit.sealing_time_s->value, bench.tau_1_s, 1e-6);
    EXPECT_NEAR(fit.unsealing_time_s->value, bench.tau_2_s, 1e-6);
    EXPECT_NEAR(fit.sealing_begins_s->value, bench.on_s, 1e-6);
    EXPECT_NEAR(fit.unsealing_begins_s->value, bench.off_s, 1e-6);
    EXPECT_FALSE(fit.ripple_Hz);
    EXPECT_TRUE(fit.notes.empty());
}

/// Of 200 logs: how often each interval holds the truth.
struct Coverage {
    int vacuum = 0;
    int tau_1 = 0;
    int tau_2 = 0;
};
Coverage coverage(const Bench& bench) {
    Coverage count;
    for (std::uint32_t run = 0; run < 200; ++run) {
        const PressureFit fit = identify_pressure(log_of(bench, run));
        count.vacuum += covers(fit.vacuum_Pa, bench.vacuum_Pa) ? 1 : 0;
        count.tau_1 += covers(fit.sealing_time_s, bench.tau_1_s) ? 1 : 0;
        count.tau_2 += covers(fit.unsealing_time_s, bench.tau_2_s) ? 1 : 0;
    }
    return count;
}

void expect_honest(const Coverage& count) {
    for (const int held : {count.vacuum, count.tau_1, count.tau_2}) {
        EXPECT_GE(held, 180);  // 90 % of 200
        EXPECT_LE(held, 198);  // 99 %
    }
    testing::Test::RecordProperty("vacuum", count.vacuum);
    testing::Test::RecordProperty("tau_1", count.tau_1);
    testing::Test::RecordProperty("tau_2", count.tau_2);
}

TEST(Identification, IntervalsCoverTheTruthOnConcreteWithRippleNoiseAndGaps) {
    expect_honest(coverage({.gaps = true}));
}

TEST(Identification, IntervalsCoverTheTruthWhenTheSensorIsCoarse) {
    expect_honest(coverage({.noise_Pa = 60.0, .quantum_Pa = 200.0}));
}

TEST(Identification, TheRippleIsFoundAndTakenOut) {
    const PressureFit fit = identify_pressure(log_of({.gaps = true}, 3));
    ASSERT_TRUE(fit.ripple_Hz);
    EXPECT_NEAR(fit.ripple_Hz->value, 8.0, 0.02);
    EXPECT_NEAR(fit.ripple_Pa, 600.0, 30.0);
    EXPECT_LT(fit.residual_Pa, 130.0);
}

TEST(Identification, OfMetalWithALongDecay) {
    const Bench metal{
        .vacuum_Pa = 27500.0, .tau_1_s = 0.25, .tau_2_s = 16.0, .end_s = 40.0, .ripple_Pa = 200.0};
    const PressureFit fit = identify_pressure(log_of(metal, 1));
    EXPECT_NEAR(fit.unsealing_time_s->value, 16.0, 2.0 * fit.unsealing_time_s->half_width);
    EXPECT_LT(fit.unsealing_time_s->half_width, 0.3);
    EXPECT_NEAR(fit.sealing_time_s->value, 0.25, 0.01);
}

TEST(Identification, OnlyASealing) {
    Bench bench;
    bench.end_s = 4.5;
    const PressureFit fit = identify_pressure(log_of(bench, 1));
    EXPECT_FALSE(fit.unsealing_time_s);
    EXPECT_FALSE(fit.unsealing_begins_s);
    EXPECT_NEAR(fit.sealing_time_s->value, 0.33, 2.0 * fit.sealing_time_s->half_width);
    EXPECT_THAT(fit.notes, testing::Contains(HasSubstr("no unsealing")));
}

TEST(Identification, AnUnsealingThatHasOnlyBegun) {
    const Bench metal{
        .vacuum_Pa = 27500.0, .tau_1_s = 0.25, .tau_2_s = 16.0, .end_s = 5.5, .ripple_Pa = 400.0};
    const PressureFit fit = identify_pressure(log_of(metal, 1));  // a rise by 6 %
    ASSERT_TRUE(fit.unsealing_time_s);
    EXPECT_NEAR(fit.unsealing_time_s->value, 16.0, 2.0 * fit.unsealing_time_s->half_width);
    EXPECT_LT(fit.unsealing_time_s->half_width, 1.0);
}

TEST(Identification, OnlyAnUnsealing) {
    Bench bench;
    bench.begin_s = 3.5;
    const PressureFit fit = identify_pressure(log_of(bench, 1));
    EXPECT_FALSE(fit.sealing_time_s);
    EXPECT_NEAR(fit.unsealing_time_s->value, 0.40, 2.0 * fit.unsealing_time_s->half_width);
    EXPECT_NEAR(fit.atmosphere_Pa->value, 101900.0, 2.0 * fit.atmosphere_Pa->half_width);
    EXPECT_THAT(fit.notes, testing::Contains(HasSubstr("no sealing")));
}

TEST(Identification, ALogThatBeginsInTheMiddleOfTheUnsealing) {
    Bench metal{.vacuum_Pa = 27500.0, .tau_1_s = 0.25, .tau_2_s = 16.0, .end_s = 30.0};
    metal.begin_s = 5.5;
    metal.atmosphere_Pa = kAtmosphere_Pa;
    const PressureFit fit = identify_pressure(log_of(metal, 1));
    EXPECT_FALSE(fit.unsealing_begins_s);
    EXPECT_NEAR(fit.unsealing_time_s->value, 16.0, 2.0 * fit.unsealing_time_s->half_width);
    EXPECT_LT(fit.unsealing_time_s->half_width, 0.2);
    EXPECT_FALSE(fit.vacuum_Pa);
    EXPECT_THAT(fit.notes, testing::Contains(HasSubstr("P_vac is not fitted")));
    EXPECT_THAT(fit.notes, testing::Contains(HasSubstr("taken as given")));
}

TEST(Identification, ALogThatBeginsInTheMiddleOfTheSealing) {
    Bench bench;
    bench.begin_s = 1.1;
    const PressureFit fit = identify_pressure(log_of(bench, 1));
    EXPECT_FALSE(fit.sealing_begins_s);
    EXPECT_NEAR(fit.sealing_time_s->value, 0.33, 2.0 * fit.sealing_time_s->half_width);
    EXPECT_NEAR(fit.unsealing_time_s->value, 0.40, 2.0 * fit.unsealing_time_s->half_width);
}

TEST(Identification, GivenTimesAreTaken) {
    const Bench bench;
    const PressureFit fit =
        identify_pressure(log_of(bench, 1), {.pump_on_s = 1.003, .pump_off_s = 4.517});
    EXPECT_FALSE(fit.sealing_begins_s);
    EXPECT_EQ(fit.curve.on_s, 1.003);
    EXPECT_EQ(fit.curve.off_s, 4.517);
    EXPECT_NEAR(fit.sealing_time_s->value, 0.33, 2.0 * fit.sealing_time_s->half_width);
}

TEST(Identification, ASecondPressIsLeftOutAndSaid) {
    const Bench bench;
    PressureTrace twice = log_of(bench, 1);
    const PressureTrace again = log_of(bench, 2);
    for (std::size_t i = 0; i < again.t_s.size(); ++i) {
        twice.t_s.push_back(again.t_s[i] + 8.0);
        twice.pressure_Pa.push_back(again.pressure_Pa[i]);
    }
    const PressureFit fit = identify_pressure(twice);
    EXPECT_NEAR(fit.unsealing_time_s->value, 0.40, 2.0 * fit.unsealing_time_s->half_width);
    EXPECT_THAT(fit.notes, testing::Contains(HasSubstr("seals again")));
    // Also where the user says when the first ended.
    const PressureFit told = identify_pressure(twice, {.pump_off_s = 4.517});
    EXPECT_NEAR(told.unsealing_time_s->value, 0.40, 2.0 * told.unsealing_time_s->half_width);
    EXPECT_THAT(told.notes, testing::Contains(HasSubstr("seals again")));
}

TEST(Identification, TheJacobianIsThatOfTheCurve) {
    PressureCurve curve{.atmosphere_Pa = 101900.0,
                        .start_Pa = 99000.0,
                        .vacuum_Pa = 65000.0,
                        .tau_1_s = 0.33,
                        .on_s = 1.0,
                        .tau_2_s = 0.4,
                        .off_s = 2.0,
                        .ripple_cos_Pa = 300.0,
                        .ripple_sin_Pa = -500.0,
                        .ripple_Hz = 8.0,
                        .baseline = false};
    for (const double t_s : {0.5, 1.01, 1.4, 1.9, 2.1, 3.5}) {
        const CurvePoint point = point_of(curve, t_s);
        for (int k = 0; k < kCurveParameters; ++k) {
            const auto parameter = static_cast<CurveParameter>(k);
            const double h = 1e-6 * std::max(1.0, std::abs(curve.*member_of(parameter)));
            PressureCurve up = curve;
            PressureCurve down = curve;
            up.*member_of(parameter) += h;
            down.*member_of(parameter) -= h;
            const double slope =
                (point_of(up, t_s).pressure_Pa - point_of(down, t_s).pressure_Pa) / (2.0 * h);
            EXPECT_NEAR(point.gradient[k], slope, 1e-4 * std::max(1.0, std::abs(slope)))
                << "parameter " << k << " at " << t_s;
        }
    }
}

std::string refusal(const PressureTrace& trace, const IdentificationOptions& options = {}) {
    try {
        (void)identify_pressure(trace, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Identification, RefusesWhatHoldsNothing) {
    Bench air;
    air.end_s = 1.0;
    EXPECT_THAT(refusal(log_of(air, 1)), HasSubstr("no change of pressure"));
    Bench noise = air;
    noise.noise_Pa = 3000.0;
    EXPECT_THAT(refusal(log_of(noise, 1)), HasSubstr("no change of pressure"));
    Bench few;
    few.step_s = 0.5;
    EXPECT_THAT(refusal(log_of(few, 1)), HasSubstr("16 samples are too few"));
    EXPECT_THAT(refusal(log_of({}, 1), {.pump_on_s = 99.0}), HasSubstr("outside the log"));
    EXPECT_THAT(refusal(log_of({}, 1), {.pump_on_s = 5.0, .pump_off_s = 4.0}),
                HasSubstr("on before it goes off"));
}

TEST(Identification, NeverDiesOnOddTraces) {
    for (std::uint32_t run = 0; run < 300; ++run) {
        RandomStream random(11, run, Stream::test);
        PressureTrace trace;
        double t_s = 0.0;
        double pressure_Pa = 1e5;
        const int samples = 20 + static_cast<int>(200.0 * random.uniform());
        for (int k = 0; k < samples; ++k) {
            t_s += 0.001 + random.uniform() * random.uniform();
            pressure_Pa = std::max(0.0, pressure_Pa + 1e4 * random.normal());
            trace.t_s.push_back(t_s);
            trace.pressure_Pa.push_back(run % 3 == 0 ? (k < samples / 2 ? 1e5 : 3e4) : pressure_Pa);
        }
        try {
            const PressureFit fit = identify_pressure(trace);
            EXPECT_TRUE(std::isfinite(fit.residual_Pa));
        } catch (const InputError&) {
            continue;  // as good an answer
        }
    }
}

}  // namespace
}  // namespace limpet::identification
