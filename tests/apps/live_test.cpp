// SPDX-License-Identifier: Apache-2.0
// A viewer of the programs that run in real time; flights that are watched:
// adapters/web/test/live.test.ts.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "../serve/client.hpp"
#include "free_port.hpp"
#include "limpet/record/recording.hpp"
#include "program.hpp"

namespace limpet {
namespace {

using namespace std::chrono_literals;
using serve::test::SocketClient;
using testing::HasSubstr;

/// Who takes the address as it was printed.
std::unique_ptr<SocketClient> watch(const Started& program) {
    const std::string printed = program.output();
    std::smatch found;
    EXPECT_TRUE(
        std::regex_search(printed, found, std::regex(R"(ws://127\.0\.0\.1:(\d+)(/\?token=\w+))")))
        << printed;
    auto viewer =
        std::make_unique<SocketClient>(static_cast<std::uint16_t>(std::stoul(found[1].str())));
    viewer->shake_hands(found[2].str(), "foxglove.websocket.v1");
    return viewer;
}

nlohmann::json next(SocketClient& viewer, const std::string& op) {
    for (;;) {
        const std::string frame = viewer.receive();
        if (frame.empty()) {
            ADD_FAILURE() << "no " << op;
            return {};
        }
        if (viewer.got_text() && nlohmann::json::parse(frame).at("op") == op) {
            return nlohmann::json::parse(frame);
        }
    }
}

TEST(LiveView, ACompanionIsWatchedAndToldToHandBack) {
    const Bench bench;
    Started companion(
        bench.folder(), "companion",
        {"companion", "simulation", "--set", "autopilot.address=udp:" + free_port(SOCK_DGRAM),
         "--set", "sensors.address=udp:" + free_port(SOCK_DGRAM), "--out", "o", "--live", "0"});
    ASSERT_TRUE(companion.prints("waits: no", 20s)) << companion.output();
    const auto viewer = watch(companion);
    EXPECT_EQ(next(*viewer, "serverInfo").at("name"), "limpet companion: simulation");
    EXPECT_GT(next(*viewer, "advertise").at("channels").size(), 15U);
    EXPECT_EQ(next(*viewer, "advertiseServices").at("services").at(0).at("name"), "/abort");
    viewer->send(
        R"({"op":"setParameters","parameters":[{"name":"limits.pose_limit_s","value":1}]})");
    EXPECT_THAT(next(*viewer, "status").at("message"), HasSubstr("cannot be changed in flight"));
    viewer->send_binary(std::string("\2\0\0\0\0\5\0\0\0\3\0\0\0cdr", 16));
    const Finished finished = companion.wait(20s);
    EXPECT_EQ(finished.exit_code, 130) << finished.err;
    EXPECT_THAT(finished.out, HasSubstr("1 came to watch"));
    EXPECT_EQ(record::read_recording(bench.folder() / "o/flight.mcap").damage, "");
}

TEST(LiveView, TheSurroundingsAreWatchedAlone) {
    const Bench bench;
    Started surroundings(
        bench.folder(), "surroundings",
        {"sim-io", "perch_concrete", "--hil", "tcp:" + free_port(SOCK_STREAM), "--sensors",
         "udp:" + free_port(SOCK_DGRAM), "--no-figures", "--out", "o", "--live", "0"});
    ASSERT_TRUE(surroundings.prints("ws://", 20s)) << surroundings.output();
    const auto viewer = watch(surroundings);
    const nlohmann::json info = next(*viewer, "serverInfo");
    EXPECT_EQ(info.at("name"), "limpet sim-io: perch_concrete");
    EXPECT_EQ(info.at("capabilities"),
              nlohmann::json({"time", "assets", "parameters", "parametersSubscribe"}));
}

}  // namespace
}  // namespace limpet
