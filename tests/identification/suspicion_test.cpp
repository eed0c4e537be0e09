// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/suspicion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "limpet/core/frames.hpp"

namespace limpet::identification {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A cup that falls from the atmosphere to 650 hPa and rises again, each number scaled and shifted.
std::vector<double> pressures(double scale, double shift_Pa = 0.0) {
    std::vector<double> all;
    for (const double absolute_Pa : {101325.0, 101300.0, 80000.0, 66000.0, 65000.0, 90000.0}) {
        all.insert(all.end(), 30, scale * (absolute_Pa + shift_Pa));
    }
    return all;
}

TEST(Suspicion, NothingIsWrongWithAbsolutePressureInPascals) {
    EXPECT_THAT(suspected_pressure_unit(pressures(1.0), kAtmosphere_Pa), IsEmpty());
    EXPECT_THAT(suspected_pressure_unit({}, kAtmosphere_Pa), IsEmpty());
    EXPECT_THAT(suspected_pressure_unit(std::vector<double>(100, 65000.0), kAtmosphere_Pa),
                IsEmpty());  // sealed throughout
    EXPECT_THAT(suspected_pressure_unit({30000.0, 500.0, 30000.0}, 31000.0), IsEmpty());
}

TEST(Suspicion, TheUnitIsNamedWithItsFactor) {
    EXPECT_THAT(suspected_pressure_unit(pressures(1e-2), kAtmosphere_Pa),
                HasSubstr("hPa? It must be in Pa: times 100"));
    EXPECT_THAT(suspected_pressure_unit(pressures(1e-3), kAtmosphere_Pa),
                HasSubstr("kPa? It must be in Pa: times 1000"));
    EXPECT_THAT(suspected_pressure_unit(pressures(1e-5), kAtmosphere_Pa), HasSubstr(": bar?"));
    EXPECT_THAT(suspected_pressure_unit(pressures(1.0 / 6895.0), kAtmosphere_Pa),
                HasSubstr(": psi?"));
}

TEST(Suspicion, GaugePressureOfEitherSignInAnyUnit) {
    for (const double unit : {1.0, 1e-2, 1e-3}) {
        EXPECT_THAT(suspected_pressure_unit(pressures(unit, -101325.0), kAtmosphere_Pa),
                    HasSubstr("gauge pressure? It must be absolute"));
        EXPECT_THAT(suspected_pressure_unit(pressures(-unit, -101325.0), kAtmosphere_Pa),
                    HasSubstr("positive gauge pressure?"));
    }
}

TEST(Suspicion, OneWildSampleIsNoUnit) {
    std::vector<double> log = pressures(1.0);
    log[50] = 0.0;
    log[51] = -5.0;
    EXPECT_THAT(suspected_pressure_unit(log, kAtmosphere_Pa), IsEmpty());
    std::vector<double> hectopascals = pressures(1e-2);
    hectopascals[50] = 101325.0;
    EXPECT_THAT(suspected_pressure_unit(hectopascals, kAtmosphere_Pa), HasSubstr("hPa?"));
}

TEST(Suspicion, TimesThatStepTooFar) {
    std::vector<double> t_s;
    for (int k = 0; k < 100; ++k) {
        t_s.push_back(0.026 * k);
    }
    EXPECT_THAT(suspected_time_unit(t_s), IsEmpty());
    EXPECT_THAT(suspected_time_unit({}), IsEmpty());
    for (const auto& [factor, unit] :
         {std::pair(1e3, "milliseconds? It must be in s: times 0.001"),
          std::pair(1e6, "microseconds?"), std::pair(1e9, "nanoseconds?")}) {
        std::vector<double> scaled = t_s;
        std::for_each(scaled.begin(), scaled.end(), [by = factor](double& t) { t *= by; });
        EXPECT_THAT(suspected_time_unit(scaled), HasSubstr(unit));
        EXPECT_DOUBLE_EQ(median_step_s(scaled), 0.026 * factor);
    }
}

}  // namespace
}  // namespace limpet::identification
