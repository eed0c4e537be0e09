// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/console.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limpet::px4 {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Px4Console, TellsWhatStandsOut) {
    const Px4Console console = read_px4_console(
        "INFO  [px4] instance: 0\n"
        "\x1b[31mERROR [param] Parameter MPC_USE_HTE not found.\x1b[0m\n"
        "px4> WARN  is the user's word\n"
        "WARN  [health_and_arming_checks] Preflight Fail: ekf2 missing data\r\n"
        "WARN  [health_and_arming_checks] Preflight Fail: ekf2 missing data\r\n"
        "INFO  [commander] Failsafe activated\n"
        "ERROR [param] Parameter COM_ARM_SDCARD not found.");
    EXPECT_EQ(console.errors, 2U);
    EXPECT_EQ(console.warnings, 2U);
    EXPECT_TRUE(console.failsafe);
    EXPECT_THAT(console.lines,
                ElementsAre("ERROR [param] Parameter MPC_USE_HTE not found.",
                            "ERROR [param] Parameter COM_ARM_SDCARD not found.",
                            "INFO  [commander] Failsafe activated",
                            "WARN  [health_and_arming_checks] Preflight Fail: ekf2 missing data"));
    EXPECT_EQ(console_text(console), "2 errors, 2 warnings, failsafe");
}

TEST(Px4Console, SaysNothingOfAQuietOneAndNotAllOfALoudOne) {
    EXPECT_EQ(console_text(read_px4_console("")), "");
    EXPECT_THAT(read_px4_console("INFO  [px4] Startup script returned successfully\n\x1b[").lines,
                IsEmpty());
    std::string loud;
    for (int k = 0; k < 100; ++k) {
        loud += "ERROR [x] number " + std::to_string(k) + "\n";
    }
    const Px4Console console = read_px4_console(loud);
    EXPECT_EQ(console.errors, 100U);
    EXPECT_THAT(console.lines, SizeIs(Px4Console::kMostLines));
    EXPECT_EQ(console_text(console), "100 errors");
    EXPECT_EQ(console_text(read_px4_console("WARN  one")), "1 warning");
}

}  // namespace
}  // namespace limpet::px4
