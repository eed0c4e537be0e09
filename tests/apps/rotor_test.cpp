// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace limpet {
namespace {

using testing::HasSubstr;

const std::string kTableOne =
    (std::filesystem::path(LIMPET_SOURCE_DIR) / "data/samples/propeller_static.txt").string();

TEST(RotorVerb, PrintsTableOneOfTheGeneratedFile) {
    const Finished text = Bench{}.run({"rotor", kTableOne, "--diameter", "12in"});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("motor_constant_kg_m: 2.5000e-05"));
    EXPECT_THAT(text.out, HasSubstr("moment_constant_m: 1.9000e-02"));
    EXPECT_THAT(text.out, HasSubstr("least squares"));
}

TEST(RotorVerb, JsonHoldsEveryRowAndWhatWasChosen) {
    const Bench bench;
    (void)bench.write("p.txt", "RPM CT CP\n4000 0.10 0.04\n6000 0.12 0.05\n");
    const Finished run = bench.run(
        {"rotor", "p.txt", "--diameter", "25cm", "--density", "1.2", "--rpm", "5000", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto printed = nlohmann::json::parse(run.out);
    EXPECT_EQ(printed["rows"].size(), 2U);
    EXPECT_NEAR(printed["diameter_m"].get<double>(), 0.25, 1e-15);
    // half-way: C_T 0.11 in eq. (3); C_P 0.045 in eq. (4)
    EXPECT_NEAR(printed["rotor"]["motor_constant_kg_m"].get<double>(), 1.1 * 1.187358e-5, 1e-11);
    EXPECT_NEAR(printed["rotor"]["moment_constant_m"].get<double>(), 0.0162772, 1e-7);
    EXPECT_EQ(printed["how"], "at 5000 rpm");
}

TEST(RotorVerb, RefusesInOneLine) {
    const Bench bench;
    (void)bench.write("p.txt", "RPM CT CP\n4000 0.10 0.04\n");
    (void)bench.write("bad.txt", "RPM CT CP\n4000 0.10 0.04\n-1 0.1 0.04\n");
    (void)bench.write("empty.txt", "");
    struct Case {
        std::vector<std::string> arguments;
        const char* error;
    };
    for (const Case& c :
         {Case{{"nowhere.txt", "--diameter", "12in"}, "nowhere.txt"},
          Case{{"empty.txt", "--diameter", "12in"}, "empty.txt: is empty"},
          Case{{"bad.txt", "--diameter", "12in"}, "bad.txt:3: RPM"},
          Case{{".", "--diameter", "12in"}, "directory"}, Case{{"p.txt"}, "--diameter"},
          Case{{"p.txt", "--diameter", "12"}, "needs its unit"},
          Case{{"p.txt", "--diameter", "0in"}, "--diameter"},
          Case{{"p.txt", "--diameter", "1e-300in"}, "--diameter \"1e-300in\": is out of range"},
          Case{{"p.txt", "--diameter", "2mm"}, "motor_constant_kg_m comes out as"},
          Case{{"p.txt", "--diameter=-3in"}, "--diameter"},
          Case{{"p.txt", "--diameter", "12 feet"}, "none of in, cm, mm, m"},
          Case{{"p.txt", "--diameter", "12in", "--density", "0"}, "--density"},
          Case{{"p.txt", "--diameter", "12in", "--density", "nan"}, "--density"},
          Case{{"p.txt", "--diameter", "12in", "--rpm", "9000"}, "--rpm"},
          Case{{"p.txt", "--diameter", "12in", "--rpm", "fast"}, "--rpm"}}) {
        std::vector<std::string> arguments = c.arguments;
        arguments.insert(arguments.begin(), "rotor");
        const Finished run = bench.run(arguments);
        EXPECT_EQ(run.exit_code, 2) << c.error;
        EXPECT_TRUE(run.one_line_of_error()) << run.err;
        EXPECT_THAT(run.err, HasSubstr(c.error));
        EXPECT_EQ(run.out, "");
    }
}

}  // namespace
}  // namespace limpet
