// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/pressure_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "limpet/core/errors.hpp"

namespace limpet::identification {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

PressureTrace read(const std::string& text) {
    std::istringstream stream(text);
    return read_pressure_log(stream, "log.csv");
}

std::string refusal(const std::string& text) {
    try {
        (void)read(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(PressureLog, ColumnsInAnyOrderAmongOthersWithCommentsAndBlankLines) {
    const PressureTrace trace = read(
        "\xEF\xBB\xBF# bench\r\n\r\nnote, pressure_Pa ,\"t_s\"\r\n\"a, b\",101325,0\r\n# stop\n"
        "c,1.01e5,0.5\n\n");
    EXPECT_THAT(trace.t_s, ElementsAre(0.0, 0.5));
    EXPECT_THAT(trace.pressure_Pa, ElementsAre(101325.0, 101000.0));
}

TEST(PressureLog, TakesARecordingWrittenAsCsv) {
    const PressureTrace trace =
        read("time_s,header.stamp_s,fluid_pressure_Pa,frame\n0.01,0,101284,cup\n");
    EXPECT_THAT(trace.t_s, ElementsAre(0.01));
    EXPECT_THAT(trace.pressure_Pa, ElementsAre(101284.0));
}

TEST(PressureLog, TakesWhatOtherToolsWrite) {
    for (const char* text :
         {"t_s;pressure_Pa\n0,25;101001,5\n", "t_s\tpressure_Pa\n0.25\t101001.5\n",
          "t_s;pressure_Pa\n0.25;101001.5\n", "t_s,pressure_Pa,\n0.25,101001.5,\n"}) {
        const PressureTrace trace = read(text);
        EXPECT_THAT(trace.t_s, ElementsAre(0.25)) << text;
        EXPECT_THAT(trace.pressure_Pa, ElementsAre(101001.5)) << text;
    }
    const PressureTrace echoed = read(
        "%time,field.header.seq,field.header.stamp,field.fluid_pressure\n"
        "1710000000000000000,1,1710000000000000000,101001.63\n"
        "1710000000025999872,1,1710000000025999872,101018.59\n");
    EXPECT_EQ(echoed.origin_s, 1.71e9);
    EXPECT_NEAR(echoed.t_s[1], 0.026, 3e-7);
}

TEST(PressureLog, AClocksTimesCountFromTheFirstSample) {
    const PressureTrace unix_time =
        read("t_s,pressure_Pa\n1710000000.000,101325\n1710000000.026,101000\n");
    EXPECT_EQ(unix_time.origin_s, 1710000000.0);
    EXPECT_EQ(unix_time.t_s[0], 0.0);
    EXPECT_NEAR(unix_time.t_s[1], 0.026, 3e-7);
    const PressureTrace of_its_own = read("t_s,pressure_Pa\n5.2,101325\n5.3,101000\n");
    EXPECT_EQ(of_its_own.origin_s, 0.0);
    EXPECT_THAT(of_its_own.t_s, ElementsAre(5.2, 5.3));
}

TEST(PressureLog, RefusesWithTheLineAndWhatIsThere) {
    EXPECT_THAT(refusal(""), HasSubstr("log.csv: is empty"));
    EXPECT_THAT(refusal("# only\n\n"), HasSubstr("is empty"));
    EXPECT_THAT(refusal("t_s,pressure_Pa\n"), HasSubstr("no samples"));
    EXPECT_THAT(
        refusal("# c\nt_s,pressure_hPa\n0,1\n"),
        AllOf(HasSubstr("log.csv:2"), HasSubstr("\"pressure_Pa\""), HasSubstr("\"pressure_hPa\"")));
    EXPECT_THAT(refusal("t_s,pressure_Pa,t_s\n"), HasSubstr("two columns"));
    const std::string header = "t_s,pressure_Pa\n0,101325\n";
    for (const char* cell : {"x", "", "nan", "inf", "-inf", "1e999", "0x10", "1;2", "1 2"}) {
        EXPECT_THAT(refusal(header + "1," + cell + "\n"),
                    AllOf(HasSubstr("log.csv:3"), HasSubstr("pressure_Pa")));
        EXPECT_THAT(refusal(header + cell + ",1e5\n"),
                    AllOf(HasSubstr("log.csv:3"), HasSubstr("t_s")));
    }
    EXPECT_THAT(refusal(header + "-1,1e5\n"), AllOf(HasSubstr(":3"), HasSubstr("earlier")));
    EXPECT_THAT(refusal(header + "0,1e5\n"), AllOf(HasSubstr(":3"), HasSubstr("must rise")));
    EXPECT_THAT(refusal(header + "1,-5\n"), AllOf(HasSubstr(":3"), HasSubstr("below zero")));
    EXPECT_THAT(refusal(header + "1\n"), AllOf(HasSubstr(":3"), HasSubstr("1 fields")));
}

TEST(PressureLog, RubbishIsRefusedInOnePrintableLine) {
    std::string rubbish;
    for (int k = 0; k < 3000; ++k) {
        rubbish += static_cast<char>((k * 7919 + k / 3) % 256);
    }
    const std::string said = refusal(rubbish);
    EXPECT_THAT(said, HasSubstr("log.csv:"));
    EXPECT_THAT(said, Not(HasSubstr("\n")));
    EXPECT_THAT(refusal(std::string("PK\x03\x04\0\0", 6)), HasSubstr("not a text file"));
    EXPECT_THAT(refusal(std::string(200'000, 'a')), HasSubstr("not a text file"));
}

}  // namespace
}  // namespace limpet::identification
