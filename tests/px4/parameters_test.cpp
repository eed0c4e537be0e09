// SPDX-License-Identifier: Apache-2.0
#include "limpet/autopilot/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "limpet/core/errors.hpp"
#include "limpet/px4/params.hpp"
#include "tests/core/whole_table.hpp"

namespace limpet::px4 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Px4Params : public testing::Test {
protected:
    void write(const std::string& text) { std::ofstream(path_) << text; }
    void TearDown() override { std::filesystem::remove(path_); }

    std::string error() {
        try {
            static_cast<void>(load_px4_params(path_, parameters_));
        } catch (const InputError& problem) {
            return problem.what();
        }
        return "";
    }

    std::string path_ = testing::TempDir() +
                        testing::UnitTest::GetInstance()->current_test_info()->name() + ".params";
    autopilot::AutopilotParameters parameters_;
};

TEST(AutopilotTable, CoversEveryField) {
    test::expect_whole(autopilot::autopilot_table(), "autopilot");
    std::set<std::string_view> names;
    for (const auto& row : autopilot::autopilot_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
    }
}

TEST(AutopilotTable, DefaultsAreWithinTheirRanges) {
    const autopilot::AutopilotParameters defaults;
    for (const auto& row : autopilot::autopilot_table()) {
        EXPECT_GE(row.get(defaults), row.minimum) << row.name;
        EXPECT_LE(row.get(defaults), row.maximum) << row.name;
        EXPECT_FALSE(row.description.empty()) << row.name;
        EXPECT_FALSE(row.source.empty()) << row.name;
    }
}

TEST_F(Px4Params, LoadsWhatItModelsAndNamesTheRest) {
    write(
        "# Onboard parameters for Vehicle 1\n"
        "#\n"
        "# Vehicle-Id Component-Id Name Value Type\n"
        "1\t1\tMPC_XY_P\t1.100000023841857910\t9\n"
        "\n"
        "1\t1\tBAT1_N_CELLS\t6\t6\n"
        "1\t1\tEKF2_GPS_CTRL\t7\t6\r\n"
        "1\t191\tMPC_Z_P\t0.5\t9\n"
        "1\t1\tMC_PITCHRATE_D\t4e-3\t9\n");
    EXPECT_THAT(load_px4_params(path_, parameters_), ElementsAre("BAT1_N_CELLS", "MPC_Z_P"));
    EXPECT_NEAR(parameters_.MPC_XY_P, 1.1, 1e-6);
    EXPECT_EQ(parameters_.EKF2_GPS_CTRL, 7.0);
    EXPECT_EQ(parameters_.MC_PITCHRATE_D, 0.004);
    EXPECT_EQ(parameters_.MPC_Z_P, 1.0);
}

TEST_F(Px4Params, RefusesWhatIsOutOfRangeAndChangesNothing) {
    write("1\t1\tMPC_XY_P\t1.5\t9\n1\t1\tMPC_THR_HOVER\t65.7\t9\n");
    EXPECT_THAT(error(), HasSubstr(path_ + ":2: MPC_THR_HOVER = 65.7 is outside of 0.1 to 0.95"));
    EXPECT_EQ(parameters_.MPC_XY_P, 0.95);
}

TEST_F(Px4Params, RefusesWhatIsNoNumber) {
    for (const char* value : {"fast", "1.2x", "nan", "inf", "1,5"}) {
        write(std::string("# c\n1\t1\tMPC_XY_P\t") + value + "\t9\n");
        EXPECT_THAT(error(), HasSubstr(":2: MPC_XY_P = '" + std::string(value) + "'"));
    }
}

TEST_F(Px4Params, RefusesAWrongNumberOfColumns) {
    write("1\t1\tMPC_XY_P\t1.0\n");
    EXPECT_THAT(error(), HasSubstr(":1: expected five columns"));
    write("1\t1\tMPC_XY_P\t1.0\t9\t9\n");
    EXPECT_THAT(error(), HasSubstr(":1: expected five columns"));
}

TEST_F(Px4Params, RefusesAMissingFileAndAFolder) {
    EXPECT_THAT(error(), HasSubstr("cannot be read"));
    path_ = testing::TempDir() + "folder.params";
    std::filesystem::create_directory(path_);
    EXPECT_THAT(error(), HasSubstr("is a directory"));
}

}  // namespace
}  // namespace limpet::px4
