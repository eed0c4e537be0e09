// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/airframe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "limpet/core/errors.hpp"

namespace limpet::px4 {
namespace {

using testing::HasSubstr;

/// The paper's vehicle, by hand.
Px4Airframe perching_uav() {
    Px4Airframe airframe;
    airframe.name = "perching_uav";
    airframe.rotors = {autopilot::RotorGeometry{{0.205, 0.205, -0.04}, +1.0, 0.019},
                       autopilot::RotorGeometry{{-0.205, -0.205, -0.04}, +1.0, 0.019},
                       autopilot::RotorGeometry{{0.205, -0.205, -0.04}, -1.0, 0.019},
                       autopilot::RotorGeometry{{-0.205, 0.205, -0.04}, -1.0, 0.019}};
    return airframe;
}

std::optional<double> value_of(const Px4Airframe& airframe, const std::string& name) {
    for (const Px4Setting& setting : px4_settings(airframe)) {
        if (setting.name == name) {
            return setting.value;
        }
    }
    return std::nullopt;
}

Px4Airframe for_target(Px4Target target) {
    Px4Airframe airframe = perching_uav();
    airframe.target = target;
    return airframe;
}

TEST(Px4Airframe, HasPx4sQuadXWithItsSigns) {
    const Px4Airframe airframe = perching_uav();
    // PX4's numbering: 0 front right and 1 rear left turn counter-clockwise, KM > 0.
    EXPECT_EQ(value_of(airframe, "CA_ROTOR0_PX"), 0.205);
    EXPECT_EQ(value_of(airframe, "CA_ROTOR0_PY"), 0.205);
    EXPECT_EQ(value_of(airframe, "CA_ROTOR0_KM"), 0.019);
    EXPECT_EQ(value_of(airframe, "CA_ROTOR3_PX"), -0.205);
    EXPECT_EQ(value_of(airframe, "CA_ROTOR3_PY"), 0.205);
    EXPECT_EQ(value_of(airframe, "CA_ROTOR3_KM"), -0.019);
    EXPECT_EQ(value_of(airframe, "PWM_MAIN_FUNC4"), 104);
}

TEST(Px4Airframe, HasAsManyRotorsAsTheVehicle) {
    Px4Airframe airframe = perching_uav();
    airframe.target = Px4Target::hitl;
    EXPECT_STREQ(px4_frame(airframe).type, "Quadrotor x");
    airframe.rotors.resize(8);
    for (std::size_t i = 0; i < 4; ++i) {
        airframe.rotors[4 + i] = airframe.rotors[i];
        airframe.rotors[4 + i].p_B_m.z() += 0.08;
        airframe.rotors[4 + i].direction *= -1.0;
    }
    EXPECT_EQ(value_of(airframe, "CA_ROTOR_COUNT"), 8);
    EXPECT_EQ(value_of(airframe, "CA_ROTOR7_PX"), -0.205);
    EXPECT_EQ(value_of(airframe, "CA_ROTOR7_KM"), 0.019);
    EXPECT_EQ(value_of(airframe, "HIL_ACT_FUNC8"), 108);
    EXPECT_EQ(value_of(airframe, "HIL_ACT_FUNC9"), std::nullopt);
    EXPECT_STREQ(px4_frame(airframe).type, "Octorotor Coaxial");
    for (const Px4Setting& setting : px4_settings(airframe)) {
        if (setting.name == "CA_ROTOR7_PX") {
            EXPECT_EQ(setting.reason, "lower rear right hub, m forward of the centre of mass");
        }
    }
    airframe.rotors.resize(12, airframe.rotors[0]);
    EXPECT_EQ(value_of(airframe, "CA_ROTOR11_PY"), 0.205);
    EXPECT_EQ(value_of(airframe, "HIL_ACT_FUNC12"), 112);
}

TEST(Px4Airframe, EveryLineHasAReasonAndStandsOnce) {
    for (const Px4Target target : {Px4Target::sitl, Px4Target::hitl, Px4Target::flight}) {
        for (const Px4Pose pose : {Px4Pose::motion_capture, Px4Pose::gps}) {
            Px4Airframe airframe = for_target(target);
            airframe.pose = pose;
            std::set<std::string> names;
            for (const Px4Setting& setting : px4_settings(airframe)) {
                EXPECT_FALSE(setting.reason.empty()) << setting.name;
                EXPECT_EQ(setting.reason.find('\n'), std::string::npos) << setting.name;
                EXPECT_LE(setting.name.size(), 16U) << setting.name;
                EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
                if (setting.type == Px4Type::int32) {
                    EXPECT_EQ(setting.value, std::round(setting.value)) << setting.name;
                }
            }
        }
    }
}

TEST(Px4Airframe, OnlyAVehicleThatPerchesGivesUpItsFailureDetector) {
    Px4Airframe airframe = perching_uav();
    EXPECT_EQ(value_of(airframe, "FD_FAIL_P"), 0.0);
    EXPECT_EQ(value_of(airframe, "COM_DISARM_LAND"), -1.0);
    airframe.perches = false;
    EXPECT_EQ(value_of(airframe, "FD_FAIL_P"), std::nullopt);
    EXPECT_EQ(value_of(airframe, "COM_DISARM_LAND"), std::nullopt);
}

TEST(Px4Airframe, AFlightKeepsItsChecksItsRemoteControlAndItsOutputs) {
    const std::set<std::string> kSimulatedOnly = {"CBRK_SUPPLY_CHK", "COM_RC_IN_MODE",
                                                  "COM_LOW_BAT_ACT", "COM_ARM_SDCARD", "SYS_HITL"};
    for (const Px4Setting& setting : px4_settings(for_target(Px4Target::flight))) {
        EXPECT_EQ(kSimulatedOnly.count(setting.name), 0U) << setting.name;
        EXPECT_EQ(setting.name.find("_FUNC"), std::string::npos) << setting.name;
    }
    EXPECT_EQ(value_of(for_target(Px4Target::flight), "MAV_1_CONFIG"), 102.0);
    EXPECT_EQ(value_of(for_target(Px4Target::sitl), "CBRK_SUPPLY_CHK"), 894281.0);
    EXPECT_EQ(value_of(for_target(Px4Target::sitl), "MAV_1_CONFIG"), std::nullopt);
    EXPECT_EQ(value_of(for_target(Px4Target::hitl), "SYS_HITL"), 1.0);
    EXPECT_EQ(value_of(for_target(Px4Target::hitl), "HIL_ACT_FUNC1"), 101.0);
}

TEST(Px4Airframe, GpsTakesThePlaceOfMotionCapture) {
    Px4Airframe airframe = perching_uav();
    EXPECT_EQ(value_of(airframe, "EKF2_EV_CTRL"), 15.0);
    EXPECT_EQ(value_of(airframe, "EKF2_GPS_CTRL"), 0.0);
    airframe.pose = Px4Pose::gps;
    EXPECT_EQ(value_of(airframe, "EKF2_EV_CTRL"), 0.0);
    EXPECT_EQ(value_of(airframe, "EKF2_GPS_CTRL"), 7.0);
    EXPECT_EQ(value_of(airframe, "SYS_HAS_MAG"), 1.0);
}

/// Name and value of each line, as QGroundControl takes them
std::map<std::string, std::string> read_back(const std::string& params) {
    std::map<std::string, std::string> values;
    std::istringstream lines(params);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string vehicle, component, name, value, type, excess;
        if (line.front() != '#') {
            EXPECT_TRUE(words >> vehicle >> component >> name >> value >> type) << line;
            EXPECT_FALSE(words >> excess) << line;
            EXPECT_TRUE(values.emplace(name, value).second) << name;
        }
    }
    return values;
}

TEST(WrittenParams, LoadBackAsTheyWere) {
    Px4Airframe airframe = perching_uav();
    // Away from every default, to PX4's precision of 32 bits.
    for (const auto& row : autopilot::autopilot_table()) {
        const Px4Fact* fact = find_px4_fact(row.name);
        if (fact != nullptr && fact->type == Px4Type::real32 && !row.name.starts_with("EKF2_")) {
            const double low = std::max(row.minimum, fact->minimum);
            const double high = std::min(row.maximum, fact->maximum);
            row.of(airframe.autopilot).set(low + (high - low) / 3.0);
        }
    }
    const auto written = read_back(px4_params_text(airframe, px4_settings(airframe)));
    EXPECT_EQ(written.count("FD_FAIL_P"), 1U);
    int compared = 0;
    for (const auto& row : autopilot::autopilot_table()) {
        if (row.name.starts_with("MPC_") || row.name.starts_with("MC_") ||
            row.name.starts_with("IMU_")) {
            // What is not written keeps its default, which is PX4's.
            const auto value = written.find(std::string(row.name));
            EXPECT_EQ(
                value != written.end() ? std::stof(value->second) : static_cast<float>(row.get({})),
                static_cast<float>(row.get(airframe.autopilot)))
                << row.name;
            ++compared;
        }
    }
    EXPECT_EQ(compared, 44);  // 17 of position, 7 of attitude, 20 of rates
}

TEST(Px4Files, SayTheSame) {
    Px4Airframe airframe = perching_uav();
    airframe.autopilot.MC_PITCHRATE_P = 0.1234;
    const auto settings = px4_settings(airframe);
    std::istringstream params(px4_params_text(airframe, settings));
    const std::string script = px4_airframe_script(airframe, settings);
    std::string line;
    std::size_t lines = 0;
    while (std::getline(params, line)) {
        if (line.front() == '#') {
            continue;
        }
        std::istringstream words(line);
        std::string vehicle, component, name, value, type;
        words >> vehicle >> component >> name >> value >> type;
        EXPECT_EQ(vehicle + component, "11");
        EXPECT_EQ(type, find_px4_fact(name)->type == Px4Type::int32 ? "6" : "9");
        EXPECT_THAT(script, HasSubstr("\nparam set-default " + name + " " + value + "\n"));
        ++lines;
    }
    EXPECT_EQ(lines, settings.size());
    EXPECT_THAT(script, HasSubstr("param set-default MC_PITCHRATE_P 0.1234\n"));
    EXPECT_THAT(script, HasSubstr("\n. ${R}etc/init.d/rc.mc_defaults\n"));
    EXPECT_THAT(script, testing::StartsWith("#!/bin/sh\n"));
}

TEST(Px4Files, AreNamedSoThatPx4FindsThem) {
    Px4Airframe airframe = perching_uav();
    EXPECT_EQ(px4_airframe_file_name(airframe), "22001_limpet_perching_uav");
    airframe.name = "my uav v1.5; rm";  // PX4 skips names with a dot
    EXPECT_EQ(px4_airframe_file_name(airframe), "22001_limpet_my_uav_v1_5__rm");
}

/// PX4's main lost MPC_USE_HTE on 2026-02-19 and COM_ARM_SDCARD on 2026-04-30.
TEST(Px4Settings, AreThoseThatThePx4Has) {
    const auto names = [](const std::vector<Px4Setting>& settings) {
        std::set<std::string> all;
        for (const Px4Setting& setting : settings) {
            all.insert(setting.name);
        }
        return all;
    };
    Px4Airframe airframe = perching_uav();
    const std::set<std::string> released = names(px4_settings(airframe));
    EXPECT_TRUE(released.contains("MPC_USE_HTE"));
    EXPECT_TRUE(released.contains("COM_ARM_SDCARD"));
    airframe.version = Px4Version::main;
    const std::set<std::string> main = names(px4_settings(airframe));
    EXPECT_EQ(main.size() + 2, released.size());
    EXPECT_FALSE(main.contains("MPC_USE_HTE"));
    EXPECT_TRUE(main.contains("HTE_THR_RANGE")) << "what takes its place";

    Px4Facts known;
    for (const std::string& name : main) {
        known.emplace(name, *find_px4_fact(name));
    }
    airframe.version = Px4Version::released;
    const Px4Fitted fit = fitted(px4_settings(airframe), known);
    EXPECT_EQ(names(fit.settings), main);
    EXPECT_EQ(fit.left_out, (std::vector<std::string>{"MPC_USE_HTE", "COM_ARM_SDCARD"}));
    known.at("HTE_THR_RANGE").minimum = 0.05;
    try {
        (void)fitted(px4_settings(airframe), known);
        FAIL() << "this PX4 allows less";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "HTE_THR_RANGE = 0.01: PX4 allows 0.05 .. 0.4");
    }
}

TEST(Px4Facts, OfABuildAreReadFromItsOwnList) {
    const std::filesystem::path build =
        std::filesystem::temp_directory_path() / ("limpet_facts_" + std::to_string(getpid()));
    std::filesystem::create_directories(build);
    EXPECT_FALSE(px4_facts_of(build));
    const auto write = [&](const std::string& text) {
        std::ofstream(build / "parameters.json") << text;
    };
    write(R"({"parameters": [{"name": "A", "type": "Int32", "default": 2, "max": 3, "group": "x"},
              {"name": "B", "type": "Float", "default": 0.5}], "version": 1})");
    const auto facts = px4_facts_of(build);
    ASSERT_TRUE(facts);
    EXPECT_EQ(facts->size(), 2U);
    EXPECT_EQ(facts->at("A").type, Px4Type::int32);
    EXPECT_EQ(facts->at("A").maximum, 3.0);
    EXPECT_EQ(facts->at("A").minimum, -std::numeric_limits<double>::infinity());
    for (const char* text :
         {"", "[]", "{\"parameters\": 3}", "{\"parameters\": [{\"name\": 1}]}"}) {
        write(text);
        EXPECT_THROW((void)px4_facts_of(build), InputError) << text;
    }
    std::filesystem::remove_all(build);
}

/// PX4 takes the last script of a number: with one number for all it flew another vehicle's.
TEST(Px4Files, EachVehicleHasANumberOfItsOwn) {
    std::set<int> numbers;
    for (const char* vehicle : {"perching_uav", "perching_hexa", "perching_x8", "iris", "cad_uav",
                                "mine", "mine too", ""}) {
        const int number = px4_airframe_id(vehicle);
        EXPECT_TRUE(numbers.insert(number).second) << vehicle;
        EXPECT_GE(number, kFirstOwnAirframe);
        EXPECT_LE(number, kLastOwnAirframe);
    }
    EXPECT_EQ(px4_airframe_id("perching_uav"), 22001);
    EXPECT_EQ(px4_airframe_id("perching_hexa"), 22002);
    EXPECT_GE(px4_airframe_id("mine"), 22100);
    EXPECT_EQ(px4_airframe_vehicle(22002), "perching_hexa");
    EXPECT_EQ(px4_airframe_vehicle(px4_airframe_id("mine")), "");
    EXPECT_EQ(px4_airframe_vehicle(22000), "");
}

std::string refusal(const Px4Airframe& airframe) {
    try {
        static_cast<void>(px4_settings(airframe));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// In lockstep each HIL_SENSOR is answered, or PX4 stops.
TEST(Px4Airframe, HasAnIntegralAndAMotorCommandForEachSampleOfTheImu) {
    Px4Airframe airframe = perching_uav();
    EXPECT_FALSE(value_of(airframe, "IMU_INTEG_RATE")) << "PX4's own start script has 250 Hz";
    airframe.imu_rate_Hz = 400.0;
    EXPECT_EQ(value_of(airframe, "IMU_INTEG_RATE"), 1000.0);
    EXPECT_FALSE(value_of(airframe, "IMU_GYRO_RATEMAX"));
    airframe.imu_rate_Hz = 1000.0;
    EXPECT_EQ(value_of(airframe, "IMU_GYRO_RATEMAX"), 2000.0);
    for (const Px4Setting& setting : px4_settings(airframe)) {
        EXPECT_TRUE(setting.name != "IMU_INTEG_RATE" || setting.fixed)
            << "that script comes after the airframe";
    }
    airframe.target = Px4Target::flight;
    EXPECT_FALSE(value_of(airframe, "IMU_INTEG_RATE"));
}

TEST(Px4Airframe, WhatGuidanceNeedsIsPartOfWhatIsSet) {
    for (const mavlink::ExpectedParameter& need : expected_parameters(px4_needs())) {
        EXPECT_EQ(value_of(perching_uav(), need.name), need.value);
    }
}

TEST(Px4Airframe, RefusesWhatPx4WouldNotTake) {
    Px4Airframe airframe = perching_uav();
    airframe.autopilot.MPC_THR_HOVER = 0.9;
    EXPECT_EQ(refusal(airframe), "MPC_THR_HOVER = 0.9: PX4 allows 0.1 .. 0.8");
    airframe = perching_uav();
    airframe.id = 4001;
    EXPECT_THAT(refusal(airframe), HasSubstr("22000 .. 22999"));
    EXPECT_EQ(refusal(perching_uav()), "");
}

}  // namespace
}  // namespace limpet::px4
