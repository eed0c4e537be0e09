// SPDX-License-Identifier: Apache-2.0
#include "limpet/remarks/remarks.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <utility>

#include "limpet/remarks/digits.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "tests/scenario/test_data.hpp"

namespace limpet::remarks {
namespace {

using namespace scenario;  // what a scenario is made of

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> of(const std::string& name, std::vector<std::string> overrides = {}) {
    return warnings(load_scenario(name, {.overrides = std::move(overrides)}));
}

std::vector<std::string> of_vehicle(const std::string& yaml) {
    const Scenario scenario = load_scenario_text("mission: hover\nvehicle: " + yaml + "\n", "mine");
    return vehicle_remarks(scenario.airframe, scenario.inherited);
}

/// A quad of 1.2 kg with a 3 cm cup.
constexpr const char* kSmall =
    "{mass_kg: 1.2, inertia_kg_m2: [0.009, 0.012, 0.018], rotors: ["
    "{x_m: 0.117, y_m: 0.117, direction: ccw}, {x_m: -0.117, y_m: -0.117, direction: ccw}, "
    "{x_m: 0.117, y_m: -0.117, direction: cw}, {x_m: -0.117, y_m: 0.117, direction: cw}], "
    "rotor: {motor_constant_kg_m: 5.3e-6, moment_constant_m: 0.013, radius_m: 0.1016, "
    "speed_scale_rad_s: 1300, speed_offset_rad_s: 100, speed_max_rad_s: 1400, height_m: 0.03}, "
    "cup: {radius_m: 0.015, joint_x_m: 0.27, lip_offset_m: 0.02, mass_kg: 0.03, mass_offset_m: "
    "0.005}, slider: {stiffness_N_m: 300, damping_N_s_m: 12, travel_m: 0.05, mass_kg: 0.04}, "
    "legs: {tip_x_m: -0.03, tip_y_m: 0.09, tip_z_m: 0.14}}";

std::string on_steel(const std::string& vehicle) {
    return "wall: {surface: metal}\nvehicle: " + vehicle + "\n";
}

TEST(Remarks, NumbersAreWrittenAsAPersonDoes) {
    const double infinite = std::numeric_limits<double>::infinity();
    for (const auto& [value, text] : {std::pair(479.6, "480"),
                                      {0.03512, "0.035"},
                                      {95.9, "96"},
                                      {99.7, "100"},
                                      {1234567.0, "1200000"},
                                      {-0.00012345, "-0.00012"},
                                      {0.0, "0"},
                                      {infinite, "inf"}}) {
        EXPECT_EQ(about(value), text);
    }
    EXPECT_EQ(about(0.0951, 1), "0.1");
    EXPECT_THAT(of("perch_concrete", {"vehicle.mass_kg=5.5"}),
                Contains(HasSubstr("damping_N_s_m is 30, 100 throws nothing back")));
}

TEST(Remarks, GainsOfNothingAreNamed) {
    EXPECT_THAT(of("perch_concrete", {"autopilot.MC_PITCHRATE_P=0"}),
                ElementsAre(HasSubstr("the pitch rate does not follow at all: "
                                      "autopilot.MC_PITCHRATE_K is 1, MC_PITCHRATE_P 0")));
}

TEST(Remarks, WhatShipsHasNone) {
    const auto root = data_root();
    for (const std::string& name : names_in(root / "vehicles")) {
        EXPECT_THAT(of("hover", {"vehicle=" + name}), IsEmpty()) << name;
    }
    for (const char* name : {"perch_concrete", "perch_metal", "perch_cinder_block", "perch_blade",
                             "perch_payload", "hover", "pendulum_concrete", "press_metal"}) {
        EXPECT_THAT(of(name), IsEmpty()) << name;
    }
}

/// The lip of 15 mm in radius on metal: 738 hPa pi R^2 R/2 = 0.39 N m; 0.3 N m/rad at some 65 deg.
TEST(Remarks, SpringsOfTheHingesThatPeelTheLip) {
    const Scenario scenario = load_scenario_text(on_steel(kSmall), "steel");
    EXPECT_THAT(
        warnings(scenario),
        Contains(AllOf(HasSubstr("bend the lip by 0.3"), HasSubstr("peels beyond 0.39 N m"),
                       HasSubstr("vehicle.cup.centring_stiffness_N_m_rad is 0.3, some 0.1"))));
    const Scenario mended =
        load_scenario_text(on_steel(kSmall), "steel",
                           {.overrides = {"vehicle.cup.centring_stiffness_N_m_rad=0.1",
                                          "vehicle.slider.damping_N_s_m=40"}});
    EXPECT_THAT(warnings(mended), IsEmpty());
    EXPECT_THAT(notes_of(mended)[1].text, HasSubstr("it peels beyond 0.39 N m, 3"));
}

/// Beside shear, where nothing is amiss.
TEST(Remarks, PeelIsPrintedBesideShear) {
    const std::vector<Note> notes = notes_of(load_scenario("perch_concrete"));
    ASSERT_EQ(notes.size(), 2U);
    EXPECT_THAT(notes[0].text, HasSubstr("times the weight along the wall"));
    EXPECT_THAT(notes[1].text, HasSubstr("springs of the hinges bend the lip by 0.35 N m"));
}

TEST(Remarks, ASliderThatThrowsTheVehicleBack) {
    const Scenario scenario = load_scenario_text(on_steel(kSmall), "steel");
    EXPECT_THAT(
        warnings(scenario),
        Contains(AllOf(HasSubstr("the slider throws the vehicle back at 35 %"),
                       HasSubstr("vehicle.slider.damping_N_s_m is 12, 38 throws nothing"))));
}

TEST(Remarks, AStartThatDoesNotSeeTheWall) {
    EXPECT_THAT(of("perch_concrete", {"simulation.start_distance_m=8"}),
                ElementsAre(AllOf(HasSubstr("guidance.wall_near_limit_m 6"),
                                  HasSubstr("simulation.start_distance_m is 8"))));
    EXPECT_THAT(of("perch_concrete", {"simulation.start_distance_m=8", "wall.width_m=20",
                                      "guidance.wall_near_limit_m=9"}),
                IsEmpty());
    EXPECT_THAT(of("perch_concrete", {"simulation.start_yaw_deg=45"}),
                ElementsAre(AllOf(HasSubstr("LiDAR looks past the wall"),
                                  HasSubstr("simulation.start_yaw_deg is 45"),
                                  HasSubstr("wall.width_m 4"))));
    EXPECT_THAT(of("perch_concrete", {"simulation.start_offset_m=3"}),
                Contains(HasSubstr("start_offset_m 3")));
    EXPECT_THAT(of("hover", {"simulation.start_distance_m=8"}), IsEmpty());
}

TEST(Remarks, WhatAVehicleLeavesToThePapersWhereItDoesNotFit) {
    EXPECT_THAT(of_vehicle("{mass_kg: 0.565}"),
                AllOf(Contains(HasSubstr("rotors is not given")),
                      Contains(HasSubstr("inertia_kg_m2 is not given")),
                      Contains(AllOf(HasSubstr("motor command 0.19"),
                                     HasSubstr("rotor.motor_constant_kg_m"))),
                      Contains(AllOf(HasSubstr("slider.stiffness_N_m, slider.damping_N_s_m"),
                                     HasSubstr("88 N/m, 5.3 N s/m")))));
    EXPECT_THAT(of_vehicle("{mass_kg: 3.6}"), IsEmpty());
    EXPECT_THAT(of_vehicle(kSmall),
                ElementsAre(AllOf(HasSubstr("cup.centring_stiffness_N_m_rad is not given"),
                                  HasSubstr("at most some 0.09"))));
    EXPECT_THAT(of_vehicle("{base: perching_uav, legs: {tip_z_m: 0.9}}"),
                ElementsAre(HasSubstr("legs.tip_z_m: the legs reach 0.9 m")));
    EXPECT_THAT(of_vehicle("{base: perching_uav, cup: {joint_x_m: 0.3}}"),
                ElementsAre(HasSubstr("they meet the wall first")));
    EXPECT_THAT(of_vehicle("{base: perching_uav, inertia_kg_m2: [5, 5, 9]}"),
                ElementsAre(HasSubstr("inertia_kg_m2 is [5, 5, 9]; a vehicle of 3.2 kg")));
}

/// A section keeps what its base gives.
TEST(Remarks, AKeyIsLeftOutWhereNobodyGivesIt) {
    const TestData data;
    const auto inherited = [&](const std::string& vehicle) {
        return data.load_text("mission: hover\nvehicle: " + vehicle + "\n").inherited;
    };
    EXPECT_THAT(inherited("small"),
                AllOf(Contains("rotors"), Contains("slider.damping_N_s_m"),
                      Not(Contains("mass_kg")), Not(Contains("slider.stiffness_N_m"))));
    EXPECT_THAT(inherited("{base: small, slider: {damping_N_s_m: 20}}"),
                AllOf(Contains("rotors"), Not(Contains("slider.damping_N_s_m")),
                      Not(Contains("slider.stiffness_N_m"))));
    const Scenario flown = data.load("first");
    EXPECT_THAT(data.load_text(to_yaml(flown)).inherited, IsEmpty());
}

}  // namespace
}  // namespace limpet::remarks
