// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/pressure_model.hpp"

#include <gtest/gtest.h>

#include <set>

#include "limpet/suction/cup.hpp"

namespace limpet::suction {
namespace {

TEST(PressureModels, AreNamedApartAndThePapersIsTheDefault) {
    std::set<std::string_view> names;
    for (const PressureModel& model : pressure_models()) {
        names.insert(model.name);
    }
    EXPECT_EQ(names.size(), pressure_models().size());
    EXPECT_EQ(model_of(CupParameters{}).name, "first_order");
}

TEST(PressureModels, ShareNoKeyWithTheCupOrEachOther) {
    std::multiset<std::string_view> keys;
    const auto take = [&](const auto& table) {
        for (const auto& row : table) {
            keys.insert(row.name);
        }
    };
    take(cup_table());
    take(lip_table());
    for_each_type(PressureModels{}, [&](auto model) { take(decltype(model)::type::table()); });
    EXPECT_EQ(std::set(keys.begin(), keys.end()).size(), keys.size());
}

/// What cup.hpp counts on, of whatever model.
TEST(PressureModels, SuckWhilePumpingAndFillAgainFasterThroughTheValve) {
    const PressureParameters parameters;
    const Surface surface;
    for (const PressureModel& model : pressure_models()) {
        const auto after_s = [&](double from_Pa, bool pump, bool valve, double duration_s) {
            SealedAir air{.surface = surface,
                          .radius_m = 0.04,
                          .pressure_Pa = from_Pa,
                          .pump_running = pump,
                          .valve_open = valve};
            for (int k = 0; k < duration_s * 1e3; ++k) {
                air.pressure_Pa = model.next_Pa(parameters, air, 1e-3);
            }
            return air.pressure_Pa;
        };
        const double sucked_Pa = after_s(kAtmosphere_Pa, true, false, 3.0);
        EXPECT_LT(sucked_Pa, 70e3) << model.name;
        EXPECT_GT(after_s(sucked_Pa, false, false, 0.1), sucked_Pa) << model.name;
        EXPECT_GT(after_s(sucked_Pa, false, true, 0.1), after_s(sucked_Pa, false, false, 0.1))
            << model.name;
        EXPECT_NEAR(after_s(sucked_Pa, false, true, 3.0), kAtmosphere_Pa, 100.0) << model.name;
    }
}

}  // namespace
}  // namespace limpet::suction
