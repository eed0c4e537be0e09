// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/propeller_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::identification {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;

/// What reading this text as a file complains of, after the file's name; "" when it does not.
std::string complaint(const std::string& text) {
    const fs::path path =
        fs::path(testing::TempDir()) / ("propeller_" + std::to_string(::getpid()) + ".txt");
    std::ofstream(path, std::ios::binary) << text;
    std::string said;
    try {
        (void)read_propeller_file(path);
    } catch (const InputError& error) {
        said = std::string(error.what()).substr(path.string().size());
    }
    fs::remove(path);
    return said;
}

TEST(PropellerFile, GivesTableOneBack) {
    const auto rows =
        read_propeller_file(fs::path(LIMPET_SOURCE_DIR) / "data/samples/propeller_static.txt");
    EXPECT_EQ(rows.size(), 12U);
    const RotorConstants fit = fitted_constants(rows, 0.3048, kAirDensity_kg_m3);
    EXPECT_NEAR(fit.motor_constant_kg_m, 2.5e-5, 1e-9);
    EXPECT_NEAR(fit.moment_constant_m, 1.9e-2, 1e-6);
}

/// By hand: C_T 0.1, C_P 0.04 at D 0.25 m, rho 1.2.
TEST(PropellerFile, ConstantsByHand) {
    const RotorConstants one = rotor_constants({6000.0, 0.1, 0.04}, 0.25, 1.2);
    EXPECT_NEAR(one.motor_constant_kg_m, 1.187358e-5, 1e-11);  // 0.1 * 1.2 * 0.25^4 / (4 pi^2)
    EXPECT_NEAR(one.moment_constant_m, 0.0159155, 1e-7);       // 0.04 / 2 pi / 0.1 * 0.25
}

/// Thrusts 1, 3.9 at speeds 1, 2 (k of 1 and 0.975): k = (1 + 0.975 * 16) / 17.
TEST(PropellerFile, FitWeighsRowsByTheFourthPowerOfTheirSpeed) {
    const std::vector<PropellerRow> rows = {{1000.0, 0.1, 0.05}, {2000.0, 0.0975, 0.04}};
    const double k = rotor_constants(rows[0], 0.3, 1.2).motor_constant_kg_m;
    const RotorConstants fit = fitted_constants(rows, 0.3, 1.2);
    EXPECT_NEAR(fit.motor_constant_kg_m / k, (1.0 + 0.975 * 16.0) / 17.0, 1e-12);
    const double slow = rotor_constants(rows[0], 0.3, 1.2).moment_constant_m;
    const double fast = rotor_constants(rows[1], 0.3, 1.2).moment_constant_m;
    EXPECT_NEAR(fit.moment_constant_m, (slow + fast * 3.9 * 3.9) / (1.0 + 3.9 * 3.9), 1e-12);
}

TEST(PropellerFile, LooksBetweenRowsInAnyOrder) {
    const std::vector<PropellerRow> rows = {{3000.0, 0.12, 0.05}, {1000.0, 0.10, 0.03}};
    const PropellerRow between = row_at(rows, 1500.0);
    EXPECT_NEAR(between.thrust_coefficient, 0.105, 1e-12);
    EXPECT_NEAR(between.power_coefficient, 0.035, 1e-12);
    EXPECT_EQ(row_at(rows, 1000.0).thrust_coefficient, 0.10);
    EXPECT_EQ(row_at(rows, 3000.0).thrust_coefficient, 0.12);
    EXPECT_THROW((void)row_at(rows, 999.0), InputError);
    EXPECT_THROW((void)row_at(rows, 3001.0), InputError);
}

TEST(PropellerFile, TakesWhatUiucFilesHold) {
    EXPECT_EQ(complaint("RPM        CT          CP\n1500.000   0.0933   0.0366\n"), "");
    EXPECT_EQ(complaint("RPM\tCT\tCP\r\n1500\t0.0933\t0.0366\r\n\r\n"), "");
    EXPECT_EQ(complaint("rpm ct cp fom\n1500 0.0933 3.66e-2 -\n"), "");
    EXPECT_EQ(complaint("\xEF\xBB\xBFRPM CT CP\n3000 0.10 0.04\n"), "");
    EXPECT_EQ(complaint("RPM,CT,CP\n3000,0.10,0.04\n5000, 0.11 ,0.045\n"), "");
    EXPECT_EQ(complaint("\"RPM\",\"CT\",\"CP\"\r\n\"3000\",\"0.10\",\"0.04\"\r\n"), "");
    EXPECT_EQ(complaint("rpm;ct;cp\n3000;0.10;0.04\n"), "");
    EXPECT_EQ(complaint("rpm;ct;cp\n3000;0,10;0,04\n"), "") << "decimal commas, as in a log";
    EXPECT_EQ(complaint("# a remark\n\nCP RPM CT\n0.0366 1500 0.0933\n"), "");
}

TEST(PropellerFile, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(complaint(""), ": is empty, must begin with a header RPM CT CP");
    EXPECT_EQ(complaint("# nothing\n\n"), ": is empty, must begin with a header RPM CT CP");
    EXPECT_EQ(complaint("RPM CT CP\n"), ": has a header and no rows");
    EXPECT_EQ(complaint("RPM CT\n1500 0.09\n"),
              ":1: the header has no column CP, must name RPM, CT and CP");
    EXPECT_EQ(complaint("1500 0.0933 0.0366\n"),
              ":1: the header has no column RPM, must name RPM, CT and CP");
    EXPECT_EQ(complaint("RPM CT CP\n1500 0.09 0.03\n2000 0.09\n"),
              ":3: CP is missing, the row has 2 of the columns");
    EXPECT_EQ(complaint("RPM CT CP\n1500 high 0.03\n"),
              ":2: CT: must be a number above 0, at most 2, is \"high\"");
    for (const char* bad : {"0", "-1500", "nan", "inf", "0x10", "1.2.3", "1e999", "1500,0"}) {
        EXPECT_EQ(
            complaint(std::string("RPM CT CP\n") + bad + " 0.09 0.03\n"),
            std::string(":2: RPM: must be a number above 0, at most 1e+06, is \"") + bad + "\"");
    }
    EXPECT_EQ(complaint("RPM CT CP\n1500 1e300 0.03\n"),
              ":2: CT: must be a number above 0, at most 2, is \"1e300\"");
    EXPECT_EQ(complaint("RPM CT CP\n1500 0 0.03\n"),
              ":2: CT: must be a number above 0, at most 2, is \"0\"");
    EXPECT_THAT(complaint("RPM CT CP\n1500 " + std::string(500, 'x') + " 1\n"), EndsWith("...\""));
    EXPECT_THAT(complaint(std::string("\x7f"
                                      "ELF\0\1\2\n",
                                      8)),
                HasSubstr(":1: not a text file"));
    EXPECT_EQ(complaint("RPM,CT,CP\n1500,0.09\n"),
              ":2: CP is missing, the row has 2 of the columns");
}

TEST(PropellerFile, ConstantsThatNoVehicleTakesAreRefused) {
    EXPECT_NO_THROW(require_usable(rotor_constants({6000.0, 0.1, 0.04}, 0.25, 1.2)));
    EXPECT_THROW(require_usable({1e-12, 0.02}), InputError);
    EXPECT_THROW(require_usable({2.5e-5, 0.0}), InputError);
    try {
        require_usable({3e-13, 0.02});
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "motor_constant_kg_m comes out as 3e-13 kg m, allowed 1e-08..0.01");
    }
}

TEST(PropellerFile, RefusesFoldersAndNothing) {
    for (const char* path : {"/nowhere/prop.txt", "/tmp"}) {
        EXPECT_THROW((void)read_propeller_file(path), InputError) << path;
    }
}

TEST(Length, NeedsItsUnit) {
    EXPECT_NEAR(length_m("12in", "d"), 0.3048, 1e-15);
    EXPECT_NEAR(length_m("30.48 cm", "d"), 0.3048, 1e-15);
    EXPECT_NEAR(length_m("304.8mm", "d"), 0.3048, 1e-15);
    EXPECT_NEAR(length_m("0.3048m", "d"), 0.3048, 1e-15);
    for (const char* bad : {"12", "", "in", "0in", "-12in", "12 feet", "12inch", "nan m", "1e5m",
                            "1e-300in", "0.5mm", "12in 3", "in12"}) {
        EXPECT_THROW((void)length_m(bad, "--diameter"), InputError) << bad;
    }
    try {
        (void)length_m("12", "--diameter");
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "--diameter 12: needs its unit: 12in, 12cm, 12mm or 12m");
    }
}

}  // namespace
}  // namespace limpet::identification
