// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/parameter_check.hpp"

#include <gmock/gmock.h>

#include <map>

#include "limpet/mavlink/parameter_value.hpp"
#include "scripted_wire.hpp"

namespace limpet::mavlink {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// An autopilot that answers for the parameters that it has.
struct Server {
    ScriptedLink wire;
    std::map<std::string, std::pair<double, bool>> parameters;  ///< value, whether an integer
    int unheard = 0;                                            ///< so many requests are lost first

    void run(ParameterCheck& check, double seconds) {
        for (int k = 0; time_s < seconds && k < 10000; ++k) {
            time_s += 0.004;
            check.update(wire.link, 1, time_s);
            for (const auto& request : wire.sent<ParamRequestRead>()) {
                EXPECT_EQ(request.param_index, -1);
                answer(check, std::string(text_of(request.param_id)));
            }
            wire.ends->sent.clear();
        }
    }
    void answer(ParameterCheck& check, const std::string& name) {
        ++requests[name];
        const auto found = parameters.find(name);
        if (unheard-- > 0 || found == parameters.end()) {
            return;
        }
        const auto [value, int32] = found->second;
        ParamValue message{.param_value = parameter_on_wire(value, int32),
                           .param_type = int32 ? std::uint8_t{MavParamType::int32}
                                               : std::uint8_t{MavParamType::real32}};
        set_text(message.param_id, name);
        check.hear(message);
    }
    std::map<std::string, int> requests;
    double time_s = 0.0;
};

std::vector<std::string> texts(const ParameterCheck& check, double time_s) {
    std::vector<std::string> all;
    for (const ParameterDifference& difference : check.differences(time_s)) {
        all.push_back(text_of(difference));
    }
    return all;
}

TEST(ParameterCheck, NothingIsAskedWhereNothingIsExpected) {
    ParameterCheck check({});
    Server server;
    server.run(check, 1.0);
    EXPECT_TRUE(check.done(0.0));
    EXPECT_THAT(server.requests, IsEmpty());
}

TEST(ParameterCheck, WhatIsTheSameIsNoDifference) {
    ParameterCheck check(
        {{"FD_FAIL_P", 0.0}, {"MPC_THR_HOVER", 0.46}, {"CA_ROTOR0_PX", -0.1234567}});
    Server server;
    server.parameters = {{"FD_FAIL_P", {0.0, true}},
                         {"MPC_THR_HOVER", {0.46, false}},
                         {"CA_ROTOR0_PX", {-0.1234567, false}}};
    EXPECT_FALSE(check.done(0.0));
    server.run(check, 0.2);
    EXPECT_TRUE(check.done(0.2));
    EXPECT_THAT(texts(check, 0.2), IsEmpty());
    EXPECT_EQ(server.requests.at("FD_FAIL_P"), 1);
}

TEST(ParameterCheck, AnotherValueAndAMissingOneAreNamed) {
    ParameterCheck check({{"FD_FAIL_P", 0.0, "it arms at any pitch"},
                          {"COM_SPOOLUP_TIME", 0.0},
                          {"MPC_THR_HOVER", 0.46}});
    Server server;
    server.parameters = {{"FD_FAIL_P", {60.0, true}}, {"MPC_THR_HOVER", {0.5, false}}};
    server.run(check, 0.2);
    EXPECT_FALSE(check.done(server.time_s)) << "one may be lost on the way";
    server.run(check, 3.0);
    EXPECT_TRUE(check.done(server.time_s));
    EXPECT_THAT(texts(check, server.time_s),
                ElementsAre("FD_FAIL_P 60 instead of 0 (it arms at any pitch)",
                            "no COM_SPOOLUP_TIME", "MPC_THR_HOVER 0.5 instead of 0.46"));
    EXPECT_EQ(server.requests.at("COM_SPOOLUP_TIME"), 3);
}

TEST(ParameterCheck, ALostRequestIsRepeated) {
    ParameterCheck check({{"FD_FAIL_P", 0.0}});
    Server server;
    server.parameters = {{"FD_FAIL_P", {60.0, true}}};
    server.unheard = 2;
    server.run(check, 2.0);
    EXPECT_EQ(texts(check, server.time_s).size(), 1U);
}

TEST(ParameterCheck, OneThatReportsNothingCannotBeCompared) {
    ParameterCheck check({{"FD_FAIL_P", 0.0}, {"FD_FAIL_R", 0.0}});
    Server server;
    server.run(check, 3.0);
    EXPECT_TRUE(check.done(server.time_s));
    EXPECT_THAT(texts(check, server.time_s), IsEmpty());
}

/// A queue of an autopilot is short: all of an airframe does not come at once.
TEST(ParameterCheck, AFewAreAskedForAtATime) {
    std::vector<ExpectedParameter> many;
    for (int k = 0; k < 90; ++k) {
        many.push_back({"P" + std::to_string(k), 0.0});
    }
    ParameterCheck check(many);
    ScriptedLink wire;
    check.update(wire.link, 1, 0.0);
    EXPECT_EQ(wire.sent<ParamRequestRead>().size(), 8U);
    check.update(wire.link, 1, 0.01);
    EXPECT_EQ(wire.sent<ParamRequestRead>().size(), 8U);
    check.update(wire.link, 1, 0.06);
    EXPECT_EQ(wire.sent<ParamRequestRead>().size(), 16U);
}

}  // namespace
}  // namespace limpet::mavlink
