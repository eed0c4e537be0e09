// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "limpet/scenario/parts.hpp"
#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

constexpr const char* kWhole =
    "description: all that a vehicle file can say\n"
    "has_cup: true\n"
    "mass_kg: 2.4\n"
    "inertia_kg_m2: [0.04, 0.09, 0.12]\n"
    "rotors:\n"
    "  - {x_m: 0.21, y_m: 0.22, direction: ccw}\n"
    "  - {x_m: -0.21, y_m: -0.22, direction: ccw}\n"
    "  - {x_m: 0.21, y_m: -0.22, direction: cw}\n"
    "  - {x_m: -0.21, y_m: 0.22, direction: cw}\n"
    "lidar: {x_m: 0.19, separation_m: 0.40, z_m: 0.01}\n"
    "pump: {x_m: -0.1, z_m: 0.02}\n"
    "rotor: {height_m: 0.05}\n"
    "slider: {travel_m: 0.08}\n"
    "cup: {radius_m: 0.035}\n"
    "legs: {tip_z_m: 0.26}\n"
    "battery: {cells: 4}\n";

class VehicleFile : public ::testing::Test {
protected:
    vehicle::Airframe load(const std::string& text) const {
        data_.write("vehicles/mine.yaml", text);
        return load_vehicle("mine", data_.root());
    }
    /// Without the file's path, which the other tests check.
    std::string error(const std::string& text) const {
        const std::string what = error_of([&] { return load(text); });
        const std::string path = (data_.root() / "vehicles" / "mine.yaml").string();
        return what.rfind(path, 0) == 0 ? what.substr(path.size()) : what;
    }
    TestData data_;
};

TEST_F(VehicleFile, IsReadWhole) {
    const vehicle::Airframe a = load(kWhole);
    EXPECT_EQ(a.name, "mine");
    EXPECT_EQ(a.description, "all that a vehicle file can say");
    EXPECT_TRUE(a.has_cup);
    EXPECT_EQ(a.mass_kg, 2.4);
    EXPECT_EQ(a.inertia_kg_m2, Vector3(0.04, 0.09, 0.12));
    EXPECT_EQ(a.rotors[3].p_B_m, Vector3(-0.21, 0.22, -0.05));  // z by the rotors' height
    EXPECT_EQ(a.rotors[0].direction, +1);
    EXPECT_EQ(a.rotors[3].direction, -1);
    EXPECT_EQ(a.lidar_x_m, 0.19);
    EXPECT_EQ(a.lidar_separation_m, 0.40);
    EXPECT_EQ(a.lidar_z_m, 0.01);
    EXPECT_EQ(a.pump_B_m, Vector3(-0.1, 0.0, 0.02));
    EXPECT_EQ(a.slider.travel_m, 0.08);
    EXPECT_EQ(a.slider.stiffness_N_m, vehicle::SliderParameters{}.stiffness_N_m);
    EXPECT_EQ(a.cup.radius_m, 0.035);
    EXPECT_EQ(a.legs.tip_z_m, 0.26);
    EXPECT_EQ(a.battery.cells, 4.0);
}

TEST_F(VehicleFile, TakesAnyListOfRotorsThatCanFly) {
    const vehicle::Airframe a = load(
        "rotor: {height_m: 0.05}\n"
        "rotors:\n"
        "  - {x_m: 0.2, y_m: 0.2, direction: ccw}\n"
        "  - {x_m: -0.2, y_m: -0.2, direction: ccw}\n"
        "  - {x_m: 0.2, y_m: -0.2, direction: cw}\n"
        "  - {x_m: -0.2, y_m: 0.2, direction: cw}\n"
        "  - {x_m: 0.2, y_m: 0.2, direction: cw, below_m: 0.08, thrust_share: 0.7}\n"
        "  - {x_m: -0.2, y_m: -0.2, direction: cw, below_m: 0.08, thrust_share: 0.7}\n");
    ASSERT_EQ(a.rotors.size(), 6U);
    EXPECT_NEAR(a.rotors[5].p_B_m.z(), 0.03, 1e-15);
    EXPECT_EQ(a.rotors[5].thrust_share, 0.7);
    EXPECT_EQ(a.rotors[0].thrust_share, 1.0);
}

TEST_F(VehicleFile, RefusesRotorsThatCannotFlyInOneLine) {
    const std::string four =
        "  - {x_m: 0.2, y_m: 0.2, direction: ccw}\n"
        "  - {x_m: -0.2, y_m: -0.2, direction: ccw}\n"
        "  - {x_m: 0.2, y_m: -0.2, direction: cw}\n";
    EXPECT_EQ(error("rotors:\n" + four), ":1: rotors: must be a list of 4 to 12 rotors, has 3");
    EXPECT_EQ(error("rotors:\n" + four + "  - {x_m: -0.2, y_m: 0.2, direction: cw}\n" +
                    "  - {x_m: 0.3, y_m: 0}\n"),
              ":6: rotors[4]: has no direction, must be ccw or cw");
    EXPECT_EQ(error("rotors:\n" + four + "  - {x_m: -0.2, direction: cw}\n"),
              ":5: rotors[3]: has no y_m");
    const std::string alike = error(
        "rotors:\n"
        "  - {x_m: 0.2, y_m: 0.2, direction: cw}\n"
        "  - {x_m: -0.2, y_m: -0.2, direction: cw}\n"
        "  - {x_m: 0.2, y_m: -0.2, direction: cw}\n"
        "  - {x_m: -0.2, y_m: 0.2, direction: cw}\n");
    EXPECT_NE(alike.find("cannot make roll, pitch, yaw and thrust independently"),
              std::string::npos)
        << alike;
    EXPECT_EQ(alike.find('\n'), std::string::npos);
}

TEST_F(VehicleFile, IsFoundByPath) {
    data_.write("mine/other.yaml", kWhole);
    EXPECT_EQ(load_vehicle((data_.root() / "mine" / "other.yaml").string(), data_.root()).name,
              "other");
    // From a scenario, relative to it.
    const std::string scenario =
        data_.write("mine/hover.yaml", "mission: hover\nvehicle: ./other.yaml\n");
    EXPECT_EQ(data_.load(scenario).airframe.mass_kg, 2.4);
}

TEST_F(VehicleFile, ErrorsNameTheirLine) {
    EXPECT_EQ(error("mass_kg: 2\ninertia_kg_m2: [0.1, 0.1]\n"),
              ":2: inertia_kg_m2: needs 3 numbers, has 2");
    EXPECT_EQ(error("inertia_kg_m2: [0.1, 0, 0.1]\n"),
              ":1: inertia_kg_m2[1]: 0 is out of range, allowed 1e-06..100 kg m2");
    EXPECT_EQ(error("rotors: [{x_m: 1}]\n"), ":1: rotors: must be a list of 4 to 12 rotors, has 1");
    EXPECT_EQ(error("rotors:\n  - {x_m: 0.2, y_m: 0.2}\n  - {}\n  - {}\n  - {}\n"),
              ":2: rotors[0]: has no direction, must be ccw or cw");
    EXPECT_EQ(error("rotors:\n  - {direction: left}\n  - {}\n  - {}\n  - {}\n"),
              ":2: rotors[0].direction: must be ccw or cw, is \"left\"");
    EXPECT_EQ(error("has_cup: maybe\n"), ":1: has_cup: must be true or false, is \"maybe\"");
    EXPECT_EQ(error("base: small\n"),
              ":1: base: unknown key; there are name, description, has_cup, rotors, model, "
              "inertia_kg_m2, lidar, pump, rotor, slider, cup, legs, battery, payload, mass_kg");
    EXPECT_EQ(error("mas_kg: 2\n"), ":1: mas_kg: unknown key, did you mean mass_kg?");
}

TEST_F(VehicleFile, MustDescribeABody) {
    const std::string triangle = error("mass_kg: 2\ninertia_kg_m2: [0.01, 0.01, 0.1]\n");
    EXPECT_EQ(triangle.substr(0, 8), ": mine: ") << triangle;
    EXPECT_EQ(error_of([&] {
                  return data_.load_text(
                      "mission: hover\nvehicle: {base: small, inertia_kg_m2: "
                      "[0.01, 0.01, 0.1]}\n");
              }).substr(0, 26),
              "x.yaml:2: vehicle: small: ");
}

}  // namespace
}  // namespace limpet::scenario
