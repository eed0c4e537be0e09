// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "../support/null_modem.hpp"
#include "flown.hpp"
#include "loopback.hpp"

namespace limpet::simulation {
namespace {

void print(const char* what, const wire::DurationHistogram& histogram) {
    std::printf("%s: %llu, median %.3f ms, p99 %.3f ms, largest %.3f ms\n", what,
                static_cast<unsigned long long>(histogram.count()), 1e3 * histogram.quantile_s(0.5),
                1e3 * histogram.quantile_s(0.99), 1e3 * histogram.largest_s());
    for (std::size_t bin = 0; bin < wire::DurationHistogram::kBins; ++bin) {
        if (histogram.bins()[bin] > 0) {
            std::printf("  up to %9.3f ms  %6llu\n", 1e3 * wire::DurationHistogram::edge_s(bin),
                        static_cast<unsigned long long>(histogram.bins()[bin]));
        }
    }
}

mavlink::Link simulator_end(const NullModem& cable) {
    return {
        open_transport({.medium = wire::Medium::serial, .device = cable.device(0), .baud = 921600},
                       wire::Role::listen),
        {.system = 255, .component = mavlink::kCompanionComponent}};
}

/// Simulated and wall time: they are one. LIMPET_SERIAL_S=60 is the long version.
double duration_s() {
    const char* text = std::getenv("LIMPET_SERIAL_S");
    return text != nullptr ? std::atof(text) : 10.0;
}

TEST(SerialHil, AtTwoHundredAndFiftyHertzNothingIsLost) {
    const auto model =
        model_of("hover", {"simulation.hover_s=" + std::to_string(duration_s()),
                           "simulation.time_limit_s=" + std::to_string(duration_s() + 10.0)});
    const NullModem cable;
    px4::StandInOptions options = Loopback::perching();
    options.hil = {.medium = wire::Medium::serial, .device = cable.device(1), .baud = 921600};
    StandInThread board(model->autopilot, options);
    mavlink::Link wire = simulator_end(cable);
    px4::Px4Options px4;
    px4.hil.timing = mavlink::HilTiming::real_time;
    px4::Px4Autopilot autopilot(wire, wire, px4);

    const FlightResult result =
        fly(model, {}, {}, 0, {.outside = {.autopilot = &autopilot}, .speed = 1.0});
    EXPECT_EQ(result.outcome, Outcome::released) << result.reason;
    // never ahead of real time; a machine that stalls is behind it by its stalls
    EXPECT_GE(result.performance.wall_s, 0.99 * result.performance.simulated_s);
    EXPECT_LE(result.performance.wall_s, 1.2 * result.performance.simulated_s);
    // the last answer may still be on its way
    const mavlink::HilCount& count = autopilot.count();
    board.end();
    print("send jitter", count.send_jitter);
    print("round trip", count.round_trip);
    EXPECT_GE(count.sensors_sent, static_cast<std::uint64_t>(250.0 * duration_s()));
    EXPECT_GE(count.answers + 2, count.sensors_sent);
    EXPECT_EQ(count.unanswered, 0U);
    EXPECT_GE(board.stand_in().count().sensors + 2, count.sensors_sent);
    for (const mavlink::LinkCount& link : {wire.count(), board.stand_in().hil().count()}) {
        EXPECT_EQ(link.lost, 0U);
        EXPECT_EQ(link.damaged, 0U);
        EXPECT_EQ(link.not_sent, 0U);
    }
    // half a period is waited for an answer: most must come in it
    EXPECT_LT(count.round_trip.quantile_s(0.5), 0.002);
}

}  // namespace
}  // namespace limpet::simulation
