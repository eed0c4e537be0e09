// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/overrides.hpp"

#include <gtest/gtest.h>

#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

class Overrides : public ::testing::Test {
protected:
    std::string error(const std::string& assignment) const {
        return error_of([&] { return data_.load("first", {assignment}); });
    }
    TestData data_;
};

TEST_F(Overrides, ReachEveryRoom) {
    const Scenario s = data_.load(
        "first",
        {"guidance.hold_s=0.6", "autopilot.MPC_XY_P=0.8", "sensors.lidar_noise_m=0",
         "suction.valve_fitted=true", "suction.tilt_stiffness_N_m_rad=30",
         "suction.pressure_model=pneumatic", "simulation.hover_s=7", "wall.heading_deg=90",
         "wall.surface.friction=0.5", "vehicle.mass_kg=2.5", "vehicle.slider.stiffness_N_m=400",
         "seed=7", "mission=perch", "vehicle.inertia_kg_m2=[0.04, 0.09, 0.12]",
         "vehicle.lidar.x_m=0.3", "description=by hand"});
    EXPECT_EQ(s.guidance.hold_s, 0.6);
    EXPECT_EQ(s.autopilot.MPC_XY_P, 0.8);
    EXPECT_EQ(s.sensors.lidar_noise_m, 0.0);
    EXPECT_EQ(s.cup.valve_fitted, true);
    EXPECT_EQ(suction::model_of(s.cup).name, "pneumatic");
    EXPECT_EQ(data_.load_text(to_yaml(s)).cup.pressure_model, s.cup.pressure_model);
    EXPECT_EQ(s.cup.lip.tilt_stiffness_N_m_rad, 30.0);
    EXPECT_EQ(s.simulation.hover_s, 7.0);
    EXPECT_EQ(s.wall.heading_deg, 90.0);
    EXPECT_EQ(s.wall.surface.friction, 0.5);
    EXPECT_EQ(s.wall.surface.name, "stone");
    EXPECT_EQ(s.airframe.mass_kg, 2.5);
    EXPECT_EQ(s.airframe.slider.stiffness_N_m, 400.0);
    EXPECT_EQ(s.seed, 7U);
    EXPECT_EQ(s.mission, Mission::perch);
    EXPECT_EQ(s.airframe.inertia_kg_m2, Vector3(0.04, 0.09, 0.12));
    EXPECT_EQ(s.airframe.lidar_x_m, 0.3);
    EXPECT_EQ(s.description, "by hand");
}

/// Where the user stands, or the campaign's file lies, before the scenario's folder.
TEST_F(Overrides, TakeARelativePathFromTheirOwnFolderFirst) {
    data_.write("here/mine.yaml", "mass_kg: 1.5\n");
    data_.write("scenarios/mine.yaml", "mass_kg: 2.5\n");
    data_.write("scenarios/beside.yaml", "mass_kg: 2.6\n");
    const auto mass_kg = [&](const std::string& assignment, const std::filesystem::path& folder) {
        const LoadOptions options{
            .overrides = {assignment}, .data_root = data_.root(), .folder = folder};
        return load_scenario("first", options).airframe.mass_kg;
    };
    EXPECT_EQ(mass_kg("vehicle=mine.yaml", data_.root() / "here"), 1.5);
    EXPECT_EQ(mass_kg("vehicle.base=mine.yaml", data_.root() / "here"), 1.5);
    EXPECT_EQ(mass_kg("vehicle=../here/mine.yaml", data_.root() / "here"), 1.5);
    EXPECT_EQ(mass_kg("vehicle=mine.yaml", {}), 2.5);  // the working folder has none
    EXPECT_EQ(mass_kg("vehicle=beside.yaml", data_.root() / "here"), 2.6);
    EXPECT_EQ(mass_kg("vehicle=small", data_.root() / "here"), 2.0);
    EXPECT_EQ(with_files_of("guidance.hold_s=1", data_.root()), "guidance.hold_s=1");
    EXPECT_EQ(with_files_of("vehicle=here/mine.yaml", data_.root()),
              "vehicle=" + (data_.root() / "here/mine.yaml").string());
}

TEST_F(Overrides, OneKeySaysWhatTellsThePosition) {
    const Scenario gps = data_.load("first", {"autopilot.aiding=gps"});
    EXPECT_EQ(gps.autopilot.EKF2_EV_CTRL, 0);
    EXPECT_EQ(gps.autopilot.EKF2_GPS_CTRL, 7);
    EXPECT_EQ(gps.autopilot.EKF2_BARO_CTRL, 1);
    EXPECT_EQ(gps.autopilot.EKF2_MAG_TYPE, 0);
    EXPECT_EQ(data_.load("first", {"autopilot.aiding=gps", "autopilot.EKF2_BARO_CTRL=0"})
                  .autopilot.EKF2_BARO_CTRL,
              0);
    const Scenario again = data_.load_text(to_yaml(gps));
    EXPECT_EQ(again.aiding, &autopilot::kGpsAiding);
    EXPECT_EQ(again.autopilot.EKF2_GPS_CTRL, 7);
    EXPECT_EQ(to_yaml(again), to_yaml(gps));
    EXPECT_EQ(data_.load("first").autopilot.EKF2_EV_CTRL, 15);
    EXPECT_EQ(to_yaml(data_.load("first")).find("aiding"), std::string::npos);
    EXPECT_NE(error("autopilot.aiding=glonass").find("there are motion_capture, gps"),
              std::string::npos);
}

TEST_F(Overrides, KeepWhatTheyDoNotName) {
    const Scenario s = data_.load("first", {"vehicle.slider.damping_N_s_m=25"});
    EXPECT_EQ(s.airframe.name, "small");
    EXPECT_EQ(s.airframe.mass_kg, 2.0);
    EXPECT_EQ(s.airframe.slider.stiffness_N_m, 600.0);
    EXPECT_EQ(s.airframe.slider.damping_N_s_m, 25.0);
}

TEST_F(Overrides, ReplaceWholeParts) {
    const Scenario s =
        data_.load("first", {"wall.surface=glass", "wall.first_touches=[stone, glass]"});
    EXPECT_EQ(s.wall.surface.name, "glass");
    ASSERT_EQ(s.wall.first_touches.size(), 2U);
    EXPECT_EQ(s.wall.first_touches[0].friction, 0.7);
    EXPECT_FALSE(data_.load("first", {"wall=none", "mission=hover"}).wall.present);
}

TEST_F(Overrides, TheLastOneWins) {
    const Scenario s = data_.load("first", {"wall.surface.friction=0.5", "wall.surface=glass",
                                            "guidance.hold_s=0.6", "guidance.hold_s=0.7"});
    EXPECT_EQ(s.wall.surface.friction, 0.4);
    EXPECT_EQ(s.guidance.hold_s, 0.7);
}

TEST_F(Overrides, TheSeedOptionWinsOverAll) {
    const LoadOptions options{{"seed=7"}, 9, data_.root()};
    EXPECT_EQ(load_scenario("first", options).seed, 9U);
}

TEST_F(Overrides, AreNamedInErrors) {
    EXPECT_EQ(error("simulation.hover_s=-1"),
              "--set simulation.hover_s=-1: -1 is out of range, allowed 0.1..3600 s");
    EXPECT_EQ(error("simulation.hovers=1"),
              "--set simulation.hovers=1: unknown key, did you mean hover_s?");
    EXPECT_EQ(error("vehicle.slider.travel=1"),
              "--set vehicle.slider.travel=1: unknown key, did you mean travel_m?");
    EXPECT_EQ(
        error("simulation={hovers: 1}"),
        "--set simulation={hovers: 1}: simulation.hovers: unknown key, did you mean hover_s?");
    EXPECT_EQ(error("wall.surface=wood"),
              "--set wall.surface=wood: \"wood\": no such surface; there are stone, glass");
    EXPECT_EQ(error("simulation.hover_s="),
              "--set simulation.hover_s=: must be a number, is empty, allowed 0.1..3600 s");
    EXPECT_EQ(error("simulation.hover_s.x=1"),
              "--set simulation.hover_s.x=1: simulation.hover_s: must be a number, is a section, "
              "allowed 0.1..3600 s");
}

TEST_F(Overrides, MustBeWrittenAsKeyAndValue) {
    const std::string help = ": write it as key=value, as in guidance.dock_speed_m_s=1.0";
    EXPECT_EQ(error("guidance.hold_s"), "--set guidance.hold_s" + help);
    EXPECT_EQ(error("=1"), "--set =1" + help);
    EXPECT_EQ(error("guidance..hold_s=1"), "--set guidance..hold_s=1: a part of the key is empty");
    EXPECT_EQ(error("seed={a: [1}"),
              "--set seed={a: [1}: is not valid YAML: did not find expected ',' or ']' (column 7)");
    EXPECT_EQ(
        error_of([&] {
            return data_.load("first",
                              {"wall.first_touches=[stone]", "wall.first_touches.friction=1"});
        }),
        "--set wall.first_touches.friction=1: wall.first_touches is a list, set it as a whole");
}

}  // namespace
}  // namespace limpet::scenario
