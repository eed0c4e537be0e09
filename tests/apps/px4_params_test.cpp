// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace limpet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Px4ParamsVerb, WritesBothFilesOfAVehicle) {
    const Bench bench;
    const Finished done = bench.run({"px4-params", "perching_uav", "--out", "px4"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("PX4_SYS_AUTOSTART=22001"));
    EXPECT_THAT(bench.files(), testing::IsSupersetOf(
                                   {"px4/22001_limpet_perching_uav", "px4/perching_uav.params"}));
    const std::string params = text_of(bench.folder() / "px4/perching_uav.params");
    EXPECT_THAT(params, HasSubstr("\n1\t1\tFD_FAIL_P\t0\t6\n"));
    // (sqrt(3.2 x 9.80665 / (4 x 2.5e-5)) - 100) / 700 to 32 bits
    EXPECT_THAT(params, HasSubstr("\n1\t1\tMPC_THR_HOVER\t0.657414"));
}

TEST(Px4ParamsVerb, TakesTheAutopilotOfAScenario) {
    const Bench bench;
    ASSERT_EQ(bench
                  .run({"px4-params", "perch_concrete", "--target", "hitl", "--gps",
                        "--airframe-id", "22017", "--set", "autopilot.MC_PITCHRATE_I=0.125"})
                  .exit_code,
              0);
    const std::string script = text_of(bench.folder() / "out/px4/22017_limpet_perching_uav.hil");
    EXPECT_THAT(script, HasSubstr("param set-default MC_PITCHRATE_I 0.125\n"));
    EXPECT_THAT(script, HasSubstr("param set-default EKF2_GPS_CTRL 7\n"));
    EXPECT_THAT(script, HasSubstr("param set SYS_HITL 1\n"));
}

TEST(Px4ParamsVerb, TakesAVehicleFileOfOnesOwn) {
    const Bench bench;
    const auto file = bench.write("mine.yaml", "base: iris\n");
    std::filesystem::copy_file(std::filesystem::path(LIMPET_SOURCE_DIR) / "data/vehicles/iris.yaml",
                               file, std::filesystem::copy_options::overwrite_existing);
    const Finished done = bench.run({"px4-params", "mine.yaml"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const std::string params = text_of(bench.folder() / "out/px4/mine.params");
    EXPECT_THAT(params, HasSubstr("\n1\t1\tCA_ROTOR1_PY\t-0.2\t9\n"));
    EXPECT_THAT(params, Not(HasSubstr("FD_FAIL_P")));
}

TEST(Px4ParamsVerb, RefusesInOneLineAndWritesNothing) {
    const Bench bench;
    const std::vector<std::vector<std::string>> wrong = {
        {"px4-params"},
        {"px4-params", "perching_ua"},
        {"px4-params", "missing.yaml"},
        {"px4-params", "perching_uav", "--target", "moon"},
        {"px4-params", "perching_uav", "--airframe-id", "4001"},
        {"px4-params", "perching_uav", "--airframe-id", "0"},
        {"px4-params", "perching_uav", "--px4", "nowhere"},
        {"px4-params", "perching_uav", "--px4", "nowhere", "--px4-version", "main"},
        {"px4-params", "perching_uav", "--mocap", "--gps"},
        {"px4-params", "perching_uav", "--set", "autopilot.MPC_THR_HOVER=0.9"},
        {"px4-params", "perching_uav", "--out", "/proc/nowhere"},
    };
    for (const auto& arguments : wrong) {
        const Finished done = bench.run(arguments);
        EXPECT_EQ(done.exit_code, 2) << done.err;
        EXPECT_TRUE(done.one_line_of_error()) << done.err;
        EXPECT_EQ(done.out, "");
    }
    EXPECT_THAT(bench.run({"px4-params", "perching_ua"}).err,
                HasSubstr("no such vehicle or scenario (did you mean perching_uav?)"));
    EXPECT_THAT(bench.files(), ElementsAre());
    EXPECT_THAT(
        bench.run({"px4-params", "perching_uav", "--set", "autopilot.MPC_THR_HOVER=0.9"}).err,
        HasSubstr("PX4 allows 0.1 .. 0.8"));
}

}  // namespace
}  // namespace limpet
