// SPDX-License-Identifier: Apache-2.0
#include "limpet/ground_station/parameter_server.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "limpet/core/errors.hpp"
#include "station.hpp"

namespace limpet::ground_station {
using namespace mavlink;
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

constexpr std::uint8_t kReal32 = 9;

class ParameterProtocol : public testing::Test {
protected:
    void SetUp() override { station_.greet(); }

    /// The vehicle reads all that the ground station has sent.
    void serve() {
        while (const auto frame = station_.vehicle.receive()) {
            server_.handle(*frame, station_.vehicle);
        }
    }
    std::vector<ParamValue> answers() {
        serve();
        auto heard = station_.heard<ParamValue>();
        station_.forget();
        return heard;
    }
    static ParamSet set(const std::string& name, float value, std::uint8_t type = kReal32) {
        ParamSet message{
            .target_system = 1, .target_component = 1, .param_value = value, .param_type = type};
        set_text(message.param_id, name);
        return message;
    }

    Station station_;
    std::vector<std::pair<std::string, double>> sets_;
    std::vector<std::string> refusals_;
    ParameterServer server_{
        {{.name = "MPC_XY_P", .value = 0.95, .minimum = 0.0, .maximum = 2.0},
         {.name = "EKF2_EV_CTRL", .value = 15.0, .minimum = 0.0, .maximum = 15.0, .whole = true},
         {.name = "SIXTEEN_LETTERS_", .value = 0.1, .minimum = 0.1, .maximum = 0.3}},
        [this](std::string_view name, double value) { sets_.emplace_back(name, value); },
        [this](std::string_view why) { refusals_.emplace_back(why); }};
};

TEST_F(ParameterProtocol, ReadsByIndexAndByName) {
    ParamRequestRead by_name{.target_system = 1, .target_component = 1, .param_index = -1};
    set_text(by_name.param_id, "SIXTEEN_LETTERS_");
    station_.ask(by_name);
    station_.ask(ParamRequestRead{.target_system = 1, .param_index = 1});
    station_.ask(ParamRequestRead{.target_system = 1, .param_index = 3});  // there is none
    station_.ask(ParamRequestRead{.target_system = 7, .param_index = 0});  // another vehicle
    station_.ask(ParamRequestRead{.target_system = 1, .target_component = 154, .param_index = 0});
    const auto values = answers();
    ASSERT_EQ(values.size(), 2U);
    EXPECT_EQ(text_of(values[0].param_id), "SIXTEEN_LETTERS_");
    EXPECT_EQ(values[0].param_value, 0.1F);
    EXPECT_EQ(values[0].param_index, 2);
    EXPECT_EQ(values[1].param_value, 15.0F);
    EXPECT_EQ(values[1].param_count, 3);
    EXPECT_EQ(values[1].param_type, kReal32);
}

TEST_F(ParameterProtocol, ASetIsTakenAndAnsweredWithTheNewValue) {
    station_.ask(set("MPC_XY_P", 1.25F));
    const auto values = answers();
    ASSERT_EQ(values.size(), 1U);
    EXPECT_EQ(values[0].param_value, 1.25F);
    EXPECT_THAT(sets_, ElementsAre(Pair("MPC_XY_P", 1.25)));
    EXPECT_EQ(server_.parameters()[0].value, 1.25);
    EXPECT_THAT(refusals_, IsEmpty());
}

TEST_F(ParameterProtocol, TheSameValueAgainIsNoSet) {
    station_.ask(set("MPC_XY_P", 0.95F));  // 0.95 has more digits than the wire
    EXPECT_EQ(answers().size(), 1U);
    EXPECT_THAT(sets_, IsEmpty());
    EXPECT_EQ(server_.parameters()[0].value, 0.95);
}

TEST_F(ParameterProtocol, ALimitCanBeSet) {
    station_.ask(set("SIXTEEN_LETTERS_", 0.3F));  // 0.3F > 0.3
    EXPECT_EQ(answers().front().param_value, 0.3F);
    EXPECT_THAT(sets_, ElementsAre(Pair("SIXTEEN_LETTERS_", 0.3)));
}

TEST_F(ParameterProtocol, ARefusedSetIsAnsweredWithTheOldValueAndSaid) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    station_.ask(set("MPC_XY_P", 2.5F));
    station_.ask(set("MPC_XY_P", nan));
    station_.ask(set("MPC_XY_P", -inf));
    station_.ask(set("EKF2_EV_CTRL", 3.5F));
    station_.ask(set("MPC_XY_P", 1.0F, 6));
    station_.ask(set("NOT_THERE", 1.0F));  // nothing to answer with
    const auto values = answers();
    ASSERT_EQ(values.size(), 5U);
    for (const ParamValue& value : values) {
        EXPECT_EQ(value.param_value, value.param_index == 0 ? 0.95F : 15.0F);
    }
    EXPECT_THAT(sets_, IsEmpty());
    EXPECT_THAT(refusals_,
                ElementsAre("MPC_XY_P = 2.5 refused, allowed 0 .. 2", HasSubstr("nan"),
                            HasSubstr("-inf"), "EKF2_EV_CTRL = 3.5 refused, must be whole",
                            "MPC_XY_P refused: type 6, must be 9 (REAL32)"));
}

TEST(ParameterList, ComesPacedAndWhole) {
    std::vector<ServedParameter> many;
    for (int i = 0; i < 47; ++i) {
        many.push_back({.name = fmt::format("P{}", i), .value = 0.5 * i, .maximum = 100.0});
    }
    ParameterServer server(
        std::move(many), [](auto, auto) {}, [](auto) {});
    Station station;
    station.greet();
    server.update(station.vehicle);
    EXPECT_THAT(station.heard<ParamValue>(), IsEmpty()) << "nobody has asked";
    station.ask(ParamRequestList{.target_system = 1, .target_component = 1});
    const auto frame = station.vehicle.receive(std::chrono::seconds(10));
    ASSERT_TRUE(frame && server.handle(*frame, station.vehicle));
    std::set<int> indices;
    for (const std::size_t expected : {20U, 20U, 7U, 0U}) {
        server.update(station.vehicle);
        const auto values = station.heard<ParamValue>();
        EXPECT_EQ(values.size(), expected);
        for (const ParamValue& value : values) {
            EXPECT_TRUE(indices.insert(value.param_index).second);
            EXPECT_EQ(value.param_value, 0.5F * static_cast<float>(value.param_index));
            EXPECT_EQ(value.param_count, 47);
        }
        station.forget();
    }
    EXPECT_EQ(indices.size(), 47U);
}

TEST(ParameterList, NamesMustFitTheWireAndDiffer) {
    const auto serve = [](const std::vector<std::string>& names) {
        std::vector<ServedParameter> parameters;
        for (const std::string& name : names) {
            parameters.push_back({.name = name});
        }
        ParameterServer server(
            parameters, [](auto, auto) {}, [](auto) {});
    };
    EXPECT_NO_THROW(serve({"A", "B"}));
    EXPECT_THROW(serve({"A", "A"}), InternalError);
    EXPECT_THROW(serve({"SEVENTEEN_LETTERS"}), InternalError);
    EXPECT_THROW(serve({""}), InternalError);
}

}  // namespace
}  // namespace limpet::ground_station
