// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/log_beside.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "../support/files.hpp"
#include "flown.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"

namespace limpet::simulation {
namespace {

namespace fs = std::filesystem;

TEST(LogBeside, WritesWhatTheLogWouldHaveWritten) {
    const TestFolder folder;
    const auto model = model_of("perch_metal_valve");
    FlightLog plain(folder / "plain.mcap", *model, {});
    FlightLog log(folder / "beside.mcap", *model, {});
    LogBeside beside(log, model);
    Flight flight(model);
    while (!flight.ended()) {
        const guidance::EventList& events = flight.tick();
        plain.tick(*model, flight.state(), events);
        beside.tick(flight.state(), events);
    }
    beside.finish();
    plain.finish("{}");
    log.finish("{}");
    const std::string expected = load_text(folder / "plain.mcap");
    EXPECT_GT(expected.size(), 100'000U);
    EXPECT_TRUE(expected == load_text(folder / "beside.mcap"));
}

TEST(LogBeside, WritesWhatIsLeftWhereAFlightBreaksOff) {
    const TestFolder folder;
    const auto model = model_of("hover");
    constexpr int kTicks = 100;  // fewer than are handed over at once
    double last_s = 0.0;
    {
        FlightLog log(folder / "broken.mcap", *model, {});
        LogBeside beside(log, model);
        Flight flight(model);
        for (int tick = 0; tick < kTicks; ++tick) {
            const guidance::EventList& events = flight.tick();
            beside.tick(flight.state(), events);
        }
        last_s = seconds(flight.state().tick);
    }
    const record::Recording recording = record::read_recording(folder / "broken.mcap.part");
    EXPECT_NEAR(recording.table("/rotor_command").time_s.back(), last_s, 0.02);
}

/// As a full disk: no more than the first messages get into the file.
TEST(LogBeside, HandsOnWhatTheLogThrows) {
    const TestFolder folder;
    const auto model = model_of("hover");
    FlightLog log(folder / "full.mcap", *model, {});
    LogBeside beside(log, model);
    Flight flight(model);
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = fs::file_size(folder / "full.mcap.part") + 1000;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto fly = [&] {
        while (!flight.ended()) {
            const guidance::EventList& events = flight.tick();
            beside.tick(flight.state(), events);
        }
        beside.finish();
    };
    EXPECT_THROW(fly(), InputError);
    EXPECT_THROW(beside.finish(), InputError) << "and nothing is written behind the gap";
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, ignored);
}

}  // namespace
}  // namespace limpet::simulation
