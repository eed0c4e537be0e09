// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

// One test a kind of bad input, with the line that the user gets.

class BadInput : public ::testing::Test {
protected:
    /// Of a text that is read as x.yaml; line 1 names the vehicle.
    std::string text_error(const std::string& text) const {
        return error_of([&] { return data_.load_text("vehicle: small\n" + text); });
    }
    std::string hover_error(const std::string& text) const {
        return text_error("mission: hover\n" + text);
    }

    TestData data_;
};

TEST_F(BadInput, OutOfRange) {
    EXPECT_EQ(hover_error("simulation:\n  start_height_m: 0.10\n"),
              "x.yaml:4: simulation.start_height_m: 0.10 is out of range, allowed 0.3..100 m");
    EXPECT_EQ(hover_error("simulation: {step_s: 1e400}\n"),
              "x.yaml:3: simulation.step_s: 1e400 is out of range, allowed 1e-05..0.001 s");
    EXPECT_EQ(hover_error("wall: {surface: {friction: -1}}\n"),
              "x.yaml:3: wall.surface.friction: -1 is out of range, allowed 0..3");
}

TEST_F(BadInput, NoPressureModel) {
    EXPECT_EQ(hover_error("suction: {pressure_model: linear}\n"),
              "x.yaml:3: suction.pressure_model: \"linear\" is none of first_order, pneumatic");
    EXPECT_EQ(hover_error("suction: {pneumatic: 1}\n"),
              "x.yaml:3: suction.pneumatic: is no key any more: for 0 say pressure_model: "
              "first_order, for 1 pressure_model: pneumatic");
}

TEST_F(BadInput, NamesOfRegistries) {
    EXPECT_EQ(hover_error("simulation: {engine: mujocko}\n"),
              "x.yaml:3: simulation.engine: \"mujocko\": no such engine (did you mean mujoco?); "
              "there are reduced, mujoco");
    EXPECT_EQ(hover_error("wall: {surface: stone, shape: sphere}\n"),
              "x.yaml:3: wall.shape: \"sphere\": no such shape of a wall; there are plane, "
              "cylinder");
}

TEST_F(BadInput, AWallThatYieldsOnMujoco) {
    const std::string wall = "wall: {surface: stone, compliance_m_N: 1e-4}\n";
    EXPECT_EQ(hover_error(wall + "simulation: {engine: mujoco}\n"),
              "x.yaml:3: wall.compliance_m_N: MuJoCo's contacts are no springs, allowed with "
              "simulation.engine reduced");
    EXPECT_EQ(hover_error("wall: {surface: stone, compliance_m_N: 0.1}\n"),
              "x.yaml:3: wall.compliance_m_N: 0.1 is out of range, allowed 0..0.001 m/N");
}

TEST_F(BadInput, AMotorThatCannotHover) {
    const std::string error = error_of([&] {
        return data_.load_text(
            "vehicle: {base: small, rotor: {motor_kv_rpm_V: 20}}\nmission: hover\n");
    });
    EXPECT_TRUE(
        error.starts_with("x.yaml:1: vehicle.rotor.motor_kv_rpm_V: 20 rpm/V turn the "
                          "propeller by "))
        << error;
}

TEST_F(BadInput, AnEmptyPackForRotorsThatFollowItsVoltage) {
    EXPECT_EQ(error_of([&] {
                  return data_.load_text(
                      "vehicle: {base: small, battery: {initial_charge: 0}, rotor: "
                      "{speed_follows_voltage: true}}\nmission: hover\n");
              }),
              "x.yaml:1: vehicle.battery.initial_charge: 0 leaves rotors whose speed follows the "
              "voltage without any, allowed above 0");
}

TEST_F(BadInput, NotFinite) {
    for (const std::string value : {".nan", ".NaN", "nan", ".inf", "-.inf", "+inf", "Infinity"}) {
        EXPECT_EQ(hover_error("simulation: {hover_s: " + value + "}\n"),
                  "x.yaml:3: simulation.hover_s: " + value +
                      " is not a finite number, allowed 0.1..3600 s");
    }
}

TEST_F(BadInput, WrongType) {
    const std::string at = "x.yaml:3: simulation.hover_s: must be a number, is ";
    const std::string allowed = ", allowed 0.1..3600 s";
    EXPECT_EQ(hover_error("simulation: {hover_s: long}\n"), at + "\"long\"" + allowed);
    EXPECT_EQ(hover_error("simulation: {hover_s: 5 s}\n"), at + "\"5 s\"" + allowed);
    EXPECT_EQ(hover_error("simulation: {hover_s: '5'}\n"), at + "\"5\"" + allowed);
    EXPECT_EQ(hover_error("simulation: {hover_s: 1.2.3}\n"), at + "\"1.2.3\"" + allowed);
    EXPECT_EQ(hover_error("simulation: {hover_s: 0x10}\n"), at + "\"0x10\"" + allowed);
    EXPECT_EQ(hover_error("simulation: {hover_s: true}\n"), at + "\"true\"" + allowed);
    EXPECT_EQ(hover_error("simulation: {hover_s: [5]}\n"), at + "a list" + allowed);
    EXPECT_EQ(hover_error("simulation: {hover_s: {a: 5}}\n"), at + "a section" + allowed);
    EXPECT_EQ(hover_error("simulation: {hover_s: }\n"), at + "empty" + allowed);
    EXPECT_EQ(hover_error("simulation: fast\n"),
              "x.yaml:3: simulation: must be a section (key: value), is \"fast\"");
    EXPECT_EQ(hover_error("description: [a, b]\n"),
              "x.yaml:3: description: must be text, is a list");
    EXPECT_EQ(error_of([&] { return data_.load_text("- hover\n"); }),
              "x.yaml: must be a section (key: value), is a list");
    EXPECT_EQ(error_of([&] { return data_.load_text("\n<?xml version=\"1.0\"?>\n<robot/>\n"); }),
              "x.yaml:1: is XML, not YAML; a URDF or MJCF is named in a vehicle's file, under "
              "`model` (docs/own_vehicle.md)");
}

TEST_F(BadInput, UnknownKey) {
    EXPECT_EQ(hover_error("simulation: {hovers: 5}\n"),
              "x.yaml:3: simulation.hovers: unknown key, did you mean hover_s?");
    EXPECT_EQ(hover_error("simulatoin: {hover_s: 5}\n"),
              "x.yaml:3: simulatoin: unknown key, did you mean simulation?");
    EXPECT_EQ(
        hover_error("wind: 5\n"),
        "x.yaml:3: wind: unknown key; there are description, mission, mount, vehicle, seed, "
        "noise, wall, pendulum, press_rig, environment, faults, suction, guidance, autopilot, "
        "sensors, simulation");
    EXPECT_EQ(
        hover_error("autopilot: {gain: 5}\n"),
        "x.yaml:3: autopilot.gain: unknown key; `limpet params autopilot` lists what there is");
    EXPECT_EQ(hover_error("autopilot: {MPC_XY_p: 1}\n"),
              "x.yaml:3: autopilot.MPC_XY_p: unknown key, did you mean MPC_XY_P?");
}

TEST_F(BadInput, MissingKey) {
    EXPECT_EQ(error_of([&] { return data_.load_text("mission: hover\n"); }),
              "x.yaml: vehicle: is missing, as in `vehicle: perching_uav`");
    EXPECT_EQ(hover_error("wall: {heading_deg: 3}\n"),
              "x.yaml:3: wall: has no surface, as in `surface: porous_concrete`");
}

TEST_F(BadInput, DuplicateKey) {
    EXPECT_EQ(hover_error("seed: 1\nseed: 2\n"),
              "x.yaml:4: seed: is given twice, first at x.yaml:3");
}

TEST_F(BadInput, SyntaxError) {
    EXPECT_EQ(hover_error("simulation: {hover_s: 5\n"),
              "x.yaml:4: is not valid YAML: did not find expected ',' or '}' (column 1)");
}

TEST_F(BadInput, Seed) {
    const std::string allowed = "must be a whole number 0..18446744073709551615, is ";
    EXPECT_EQ(hover_error("seed: -1\n"), "x.yaml:3: seed: " + allowed + "\"-1\"");
    EXPECT_EQ(hover_error("seed: 1.5\n"), "x.yaml:3: seed: " + allowed + "\"1.5\"");
    EXPECT_EQ(hover_error("seed: 18446744073709551616\n"),
              "x.yaml:3: seed: " + allowed + "\"18446744073709551616\"");
    EXPECT_EQ(hover_error("seed: []\n"), "x.yaml:3: seed: " + allowed + "a list");
    EXPECT_EQ(hover_error("seed: 18446744073709551615\n"), "");
    EXPECT_EQ(hover_error("noise: [[1, 0.6], [2, -0.8]]\n"), "");
    EXPECT_EQ(hover_error("noise: []\n"), "");
    EXPECT_NE(hover_error("noise: 7\n").find("as in [[1, 0.6], [2, 0.8]]"), std::string::npos);
    EXPECT_NE(hover_error("noise: [[1]]\n").find("as in [1, 0.6]"), std::string::npos);
    EXPECT_NE(hover_error("noise: [[1, 0]]\n").find("needs a weight beyond"), std::string::npos);
    EXPECT_NE(hover_error("noise: [[-1, 1]]\n").find("0..18446744073709551615"), std::string::npos);
}

TEST_F(BadInput, Mission) {
    EXPECT_EQ(text_error("mission: land\n"),
              "x.yaml:2: mission: \"land\" is none of hover, perch, perch_and_take_off");
    EXPECT_EQ(text_error("mission: perch\n"),
              "x.yaml:2: mission: perch needs a wall, and there is none");
    EXPECT_EQ(text_error("description: no mission is one too\n"),
              "x.yaml: mission: perch_and_take_off needs a wall, and there is none");
    EXPECT_EQ(error_of([&] {
                  return data_.load_text(
                      "mission: perch\nvehicle: {base: small, has_cup: false}\n"
                      "wall: {surface: stone}\n");
              }),
              "x.yaml:1: mission: perch needs a cup, and small has none");
}

TEST_F(BadInput, UnknownSurface) {
    EXPECT_EQ(
        hover_error("wall:\n  surface: stonee\n"),
        "x.yaml:4: wall.surface: \"stonee\": no such surface (did you mean stone?); there are "
        "stone, glass");
    EXPECT_EQ(hover_error("wall: {surface: stone, first_touches: [glass, wood]}\n"),
              "x.yaml:3: wall.first_touches[1]: \"wood\": no such surface; there are stone, glass");
    EXPECT_EQ(hover_error("wall: {surface: stone, first_touches: glass}\n"),
              "x.yaml:3: wall.first_touches: must be a list of surfaces, as in [spalled_concrete]");
}

TEST_F(BadInput, UnknownVehicle) {
    EXPECT_EQ(error_of([&] { return data_.load_text("mission: hover\nvehicle: smal\n"); }),
              "x.yaml:2: vehicle: \"smal\": no such vehicle (did you mean small?); there is small");
}

TEST_F(BadInput, UnknownScenario) {
    EXPECT_EQ(error_of([&] { return data_.load("frist"); }),
              "\"frist\": no such scenario (did you mean first?); there is first");
}

TEST_F(BadInput, NoScenarioFile) {
    EXPECT_EQ(error_of([&] { return data_.load("scenarios/none.yaml"); }),
              "scenarios/none.yaml: cannot be read: No such file or directory");
    EXPECT_EQ(error_of([&] { return data_.load("scenarios/hover.yaml"); }),
              "scenarios/hover.yaml: no such file; hover ships, and goes by that name alone");
    EXPECT_EQ(error_of([&] {
                  return data_.load_text("mission: hover\nvehicle: ../vehicles/iris.yaml\n");
              }),
              "../vehicles/iris.yaml: no such file; iris ships, and goes by that name alone");
    const std::string folder = (data_.root() / "scenarios").string();
    EXPECT_EQ(error_of([&] { return data_.load(folder); }),
              folder + ": is a directory, not a file");
    const std::string empty = data_.write("empty.yaml", "");
    EXPECT_EQ(error_of([&] { return data_.load(empty); }), empty + ": is empty");
}

TEST_F(BadInput, InTheVehiclesOwnFile) {
    const std::string path =
        data_.write("vehicles/bad.yaml", "mass_kg: 2.0\nslider:\n  travel: 1\n");
    EXPECT_EQ(error_of([&] { return data_.load_text("mission: hover\nvehicle: bad\n"); }),
              path + ":3: slider.travel: unknown key, did you mean travel_m?");
}

TEST_F(BadInput, InTheSurfacesFile) {
    const std::string path =
        data_.write("surfaces.yaml", "stone: {friction: 0.7}\nmoss: {friction: soft}\n");
    EXPECT_EQ(hover_error("wall: {surface: moss}\n"),
              path + ":2: moss.friction: must be a number, is \"soft\", allowed 0..3");
}

TEST_F(BadInput, StepsThatDoNotDivide) {
    EXPECT_EQ(hover_error("simulation: {step_s: 0.0003}\n"),
              "x.yaml:3: simulation.step_s: 0.0003 does not divide the tick of 0.001 s");
    EXPECT_EQ(hover_error("simulation: {step_s: 0.0005, touch_step_s: 0.0003}\n"),
              "x.yaml:3: simulation.touch_step_s: 0.0003 does not divide step_s, 0.0005 s");
    EXPECT_EQ(hover_error("simulation: {step_s: 0.0005, touch_step_s: 0.000125}\n"), "");
}

/// Of all springs the mounts' alone act as they stand: too stiff for a light vehicle they are
/// refused.
TEST_F(BadInput, AMountThatTheStepCannotHold) {
    const auto error = [](std::vector<std::string> overrides) {
        overrides.insert(overrides.end(), {"vehicle.mass_kg=0.5", "press_rig.stiffness_N_m=200000",
                                           "press_rig.damping=2"});
        return error_of([&] {
            return load_scenario("press_concrete",
                                 {.overrides = overrides, .data_root = LIMPET_SOURCE_DIR "/data"});
        });
    };
    EXPECT_THAT(error({}), testing::HasSubstr("simulation.step_s: 0.001 s is unstable for this "
                                              "vehicle on mount press_rig, allowed up to 0.000"));
    EXPECT_EQ(error({"simulation.step_s=0.00025"}), "");
}

TEST_F(BadInput, SwitchesAndCounts) {
    const std::string valve = "x.yaml:3: suction.valve_fitted: must be true or false, is ";
    EXPECT_EQ(hover_error("suction: {valve_fitted: 0.5}\n"), valve + "\"0.5\"");
    EXPECT_EQ(hover_error("suction: {valve_fitted: yes}\n"), valve + "\"yes\"");
    EXPECT_EQ(hover_error("suction: {valve_fitted: \"1\"}\n"), valve + "\"1\"");
    for (const std::string value : {"true", "False", "0", "1", "1.0"}) {
        EXPECT_EQ(hover_error("suction: {valve_fitted: " + value + "}\n"), "");
    }
    EXPECT_EQ(hover_error("guidance: {attempts: 2.5}\n"),
              "x.yaml:3: guidance.attempts: 2.5 is not a whole number, allowed 1..100");
    EXPECT_EQ(hover_error("guidance: {attempts: true}\n"),
              "x.yaml:3: guidance.attempts: must be a number, is \"true\", allowed 1..100");
}

TEST_F(BadInput, RatesThatAreNotWhole) {
    EXPECT_EQ(
        hover_error("simulation: {guidance_rate_Hz: 12.5}\n"),
        "x.yaml:3: simulation.guidance_rate_Hz: 12.5 is not a whole number, allowed 1..1000 Hz");
    EXPECT_EQ(hover_error("sensors: {lidar_rate_Hz: 33.3}\n"),
              "x.yaml:3: sensors.lidar_rate_Hz: 33.3 is not a whole number, allowed 0..1000 Hz");
    EXPECT_EQ(hover_error("simulation: {record_rate_Hz: 0}\n"),
              "x.yaml:3: simulation.record_rate_Hz: 0 is out of range, allowed 1..1000 Hz");
}

TEST_F(BadInput, ValuesThatDoNotFitEachOther) {
    EXPECT_EQ(hover_error("guidance:\n  hold_s: 0.5\n  land_pressure_Pa: 99000\n"),
              "x.yaml:5: guidance.land_pressure_Pa: 99000 must be below detach_pressure_Pa, 98000");
    EXPECT_EQ(error_of([&] {
                  return data_.load_text(
                      "vehicle: {base: small, cup: {lip_offset_m: 0.25}}\nwall: {surface: stone}\n"
                      "simulation: {start_distance_m: 0.7}\n");
              }),
              "x.yaml:3: simulation.start_distance_m: 0.7 is too close, the lip is 0.71 m ahead of "
              "the centre of mass");
}

TEST_F(BadInput, EnvironmentsThatCannotBe) {
    EXPECT_EQ(hover_error("environment: {wind_speed_m_s: -1}\n"),
              "x.yaml:3: environment.wind_speed_m_s: -1 is out of range, allowed 0..30 m/s");
    EXPECT_EQ(hover_error("environment: {wind_from: 90}\n"),
              "x.yaml:3: environment.wind_from: unknown key, did you mean wind_from_deg?");
    EXPECT_EQ(hover_error("environment:\n  gust_wind_m_s: 3\n  gust_sigma_m_s: 1\n"),
              "x.yaml:5: environment.gust_sigma_m_s: gusts are given by gust_wind_m_s already, one "
              "of the two must be 0");
    EXPECT_EQ(hover_error("environment:\n  swell_up_m: 2\n  swell_period_s: 2\n"),
              "x.yaml:5: environment.swell_period_s: 2 s for so far a swell is 19.7392 m/s^2, "
              "allowed is less than 9.80665");
    EXPECT_EQ(hover_error("environment: {recirculation_full_radii: 5}\n"),
              "x.yaml:3: environment.recirculation_full_radii: 5 must be below "
              "recirculation_none_radii, 4");
}

TEST_F(BadInput, MountsThatCannotBe) {
    EXPECT_EQ(hover_error("mount: crane\n"),
              "x.yaml:3: mount: \"crane\" is none of free, pendulum, press_rig");
    EXPECT_EQ(hover_error("mount: pendulum\n"),
              "x.yaml:3: mount: pendulum needs a wall, and there is none");
    EXPECT_EQ(error_of([&] {
                  return data_.load_text(
                      "mount: press_rig\nvehicle: {base: small, has_cup: false}\n"
                      "wall: {surface: stone}\n");
              }),
              "x.yaml:1: mount: press_rig needs a cup, and small has none");
    EXPECT_EQ(hover_error("pendulum: {impact_speed_m_s: 5}\n"),
              "x.yaml:3: pendulum.impact_speed_m_s: 5 is out of range, allowed 0.02..3 m/s");
    EXPECT_EQ(hover_error("press_rig: {pres_N: 5}\n"),
              "x.yaml:3: press_rig.pres_N: unknown key, did you mean press_N?");
}

TEST_F(BadInput, AVehicleTooHeavyToHover) {
    EXPECT_EQ(error_of([&] {
                  return data_.load_text("mission: hover\nvehicle: {base: small, mass_kg: 20}\n");
              }),
              "x.yaml:2: vehicle: guidance.hover_thrust follows from it as 1.858, allowed "
              "0.01..1: its rotors do not lift it");
}

}  // namespace
}  // namespace limpet::scenario
