// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "limpet/core/errors.hpp"
#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/outcome.hpp"
#include "limpet/core/signals/readings.hpp"

namespace limpet {
namespace {

TEST(Event, CarriesItsValuesAndNoMore) {
    Event event = make_event(1.5, "cup", EventName::attached, "", {{"pressure_Pa", 87900.0}});
    EXPECT_EQ(event.value_count, 1U);
    EXPECT_EQ(event.values[0].name, "pressure_Pa");
    for (std::size_t i = 1; i < Event::kMaxValues; ++i) {
        event.add("more", 0.0);
    }
    EXPECT_THROW(event.add("one too many", 0.0), InternalError);
}

TEST(Outcome, NamesComeBack) {
    for (const Outcome outcome :
         {Outcome::perched, Outcome::released, Outcome::failed_to_seal, Outcome::release_aborted,
          Outcome::aborted, Outcome::crashed, Outcome::timed_out, Outcome::interrupted}) {
        EXPECT_EQ(outcome_from(to_string(outcome)), outcome);
    }
    EXPECT_FALSE(outcome_from("landed"));
}

TEST(Sample, NeverSeenIsNeverFresh) {
    Sample<RangeReading> sample;
    EXPECT_FALSE(sample.ever());
    EXPECT_FALSE(sample.fresh(0.0, 1e9));
    sample.time_s = 1.0;
    EXPECT_TRUE(sample.fresh(1.2, 0.25));
    EXPECT_FALSE(sample.fresh(1.3, 0.25));
}

}  // namespace
}  // namespace limpet
