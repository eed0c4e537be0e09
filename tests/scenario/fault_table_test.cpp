// SPDX-License-Identifier: Apache-2.0
#include "limpet/scenario/fault_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/scenario/test_data.hpp"

namespace limpet::scenario {
namespace {

class FaultTable : public ::testing::Test {
protected:
    [[nodiscard]] Scenario loaded(const std::string& faults) const {
        return data_.load_text("vehicle: small\nmission: hover\nfaults: " + faults + "\n");
    }
    [[nodiscard]] std::string error(const std::string& faults) const {
        return error_of([&] { return loaded(faults); });
    }

    TestData data_;
};

TEST_F(FaultTable, OneMayStandForItself) {
    const Scenario one = loaded("{fault: motor_weak, unit: 1, size: 0.5, at_s: 2, for_s: 0.5}");
    ASSERT_EQ(one.faults.size(), 1U);
    const faults::Fault& fault = one.faults[0];
    EXPECT_EQ(fault.kind, faults::FaultKind::motor_weak);
    EXPECT_EQ(fault.unit, 1);
    EXPECT_EQ(fault.size, 0.5);
    EXPECT_FALSE(fault.phase);
    EXPECT_EQ(fault.after_s, 2.0);
    EXPECT_EQ(fault.for_s, 0.5);
}

TEST_F(FaultTable, LeftOutAreTheKindsUsualSizeEveryLidarTheFirstMotorAndForGood) {
    const Scenario two = loaded("[{fault: lidar_offset, phase: aligning}, {fault: motor_lost}]");
    ASSERT_EQ(two.faults.size(), 2U);
    EXPECT_EQ(two.faults[0].unit, faults::kEveryUnit);
    EXPECT_EQ(two.faults[0].size, kind_row(faults::FaultKind::lidar_offset).size_usual);
    EXPECT_EQ(two.faults[0].phase, guidance::PerchingState::aligning);
    EXPECT_TRUE(std::isinf(two.faults[0].for_s));
    EXPECT_EQ(two.faults[1].unit, 0);
}

TEST_F(FaultTable, EveryKindIsWrittenAsItIsRead) {
    for (const CatalogueEntry& kind : list_faults()) {
        for (const char* when : {"at_s: 0.1", "phase: resting, after_s: 0.3, for_s: 0.7"}) {
            const Scenario first = loaded("[{fault: " + kind.name + ", " + when + "}]");
            const Scenario again = data_.load_text(to_yaml(first));
            ASSERT_EQ(again.faults.size(), 1U) << kind.name;
            EXPECT_EQ(fault_text(again.faults[0]), fault_text(first.faults[0]));
            EXPECT_EQ(to_yaml(again), to_yaml(first));
        }
    }
}

TEST_F(FaultTable, WhatIsWrongIsSaidInALine) {
    EXPECT_EQ(error("{fault: motor_lots}"),
              "x.yaml:3: faults.fault: \"motor_lots\" is no fault, did you mean motor_lost?");
    EXPECT_EQ(error("{fault: motor_lost, unit: 4}"),
              "x.yaml:3: faults.unit: 4 is out of range, allowed 0..3");
    EXPECT_EQ(error("{fault: mocap_lost, unit: 0}"),
              "x.yaml:3: faults.unit: there is one alone of mocap_lost");
    EXPECT_EQ(error("{fault: mocap_lost, size: 1}"),
              "x.yaml:3: faults.size: mocap_lost has no size");
    EXPECT_EQ(error("{fault: motor_weak, size: 2}"),
              "x.yaml:3: faults.size: 2 is out of range, allowed 0..1");
    EXPECT_EQ(error("{fault: motor_lost, phase: restin}"),
              "x.yaml:3: faults.phase: \"restin\" is no phase, did you mean resting?");
    EXPECT_EQ(error("{fault: motor_lost, phase: resting, at_s: 1}"),
              "x.yaml:3: faults.at_s: goes with no phase: write after_s, counted from the phase's "
              "beginning");
    EXPECT_EQ(
        error("{fault: motor_lost, after_s: 1}"),
        "x.yaml:3: faults.after_s: needs a phase after whose beginning it counts; at_s counts "
        "from the flight's");
    EXPECT_EQ(error("{phase: resting}"),
              "x.yaml:3: faults: says no fault, as in {fault: motor_lost}; `limpet list faults`");
    EXPECT_EQ(error("{fault: motor_lost, for_s: -1}"),
              "x.yaml:3: faults.for_s: -1 is out of range, allowed 0..1000000 s");
    EXPECT_NE(error("motor_lost"), "");
    EXPECT_NE(error("[motor_lost]"), "");
}

TEST_F(FaultTable, FormerKeysOfSensorsNameTheRowToWrite) {
    const auto sensors_error = [&](const std::string& text) {
        return error_of([&] {
            return data_.load_text("vehicle: small\nmission: hover\nsensors: {" + text + "}\n");
        });
    };
    EXPECT_EQ(sensors_error("mocap_fails_at_s: 4.5"),
              "x.yaml:3: sensors.mocap_fails_at_s: is no key any more: write faults: [{fault: "
              "mocap_lost, at_s: 4.5}]");
    EXPECT_EQ(sensors_error("mocap_fails_at_s: 1000000000"), "");  // never, as recordings say
}

}  // namespace
}  // namespace limpet::scenario
