// SPDX-License-Identifier: Apache-2.0
#include "limpet/live/live.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "../serve/client.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/topics.hpp"

using namespace limpet;
using namespace limpet::live;
using limpet::serve::test::SocketClient;
using nlohmann::json;
using testing::HasSubstr;

namespace {

struct Watched : testing::Test {
    std::vector<std::string> served;
    std::vector<std::pair<std::string, double>> set;
    LiveDesk desk = {
        .serve =
            [this](std::string_view service) {
                served.emplace_back(service);
                return LiveAnswer{service == "/yes", "so it is"};
            },
        .set = [this](std::string_view name, double value) { set.emplace_back(name, value); }};
    Live live{
        {.server = {.token = "secret"},
         .name = "a flight",
         .services = {"/yes", "/no"},
         .parameters = {
             {.name = "a.gain", .value = 1.0, .minimum = 0.0, .maximum = 2.0, .settable = true},
             {.name = "a.count",
              .value = 3.0,
              .minimum = 0.0,
              .maximum = 9.0,
              .whole = true,
              .settable = true},
             {.name = "b.fixed", .value = 5.0, .maximum = 9.0}}}};

    void add_channel(std::uint16_t id, std::string_view topic) {
        live.channel({.id = id,
                      .topic = topic,
                      .type = "std_msgs/msg/String",
                      .encoding = "cdr",
                      .schema_encoding = "ros2msg",
                      .schema = "string data"});
    }
    void tell(std::uint16_t channel, std::uint64_t time_ns, const std::string& text) {
        live.message(channel, time_ns,
                     {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    }
    std::unique_ptr<SocketClient> come() const {
        const std::string address = live.address();
        const auto port =
            static_cast<std::uint16_t>(std::stoul(address.substr(address.rfind(':') + 1)));
        auto viewer = std::make_unique<SocketClient>(port);
        viewer->shake_hands("/?token=secret", "foxglove.sdk.v1, foxglove.websocket.v1");
        return viewer;
    }
    /// The next text with this `op`; bytes in between are skipped.
    static json next(SocketClient& viewer, const std::string& op) {
        for (;;) {
            const std::string frame = viewer.receive();
            if (frame.empty()) {
                ADD_FAILURE() << "no " << op;
                return {};
            }
            if (viewer.got_text()) {
                json text = json::parse(frame);
                if (text.at("op") == op) {
                    return text;
                }
            }
        }
    }
    /// The next bytes of this kind.
    static std::string next_bytes(SocketClient& viewer, char kind) {
        for (;;) {
            std::string frame = viewer.receive();
            if (frame.empty() || (!viewer.got_text() && frame[0] == kind)) {
                return frame;
            }
        }
    }
    void answer_one() {
        const std::size_t before = served.size() + set.size();
        EXPECT_TRUE(serve::test::comes([&] {
            live.answer(desk);
            return served.size() + set.size() != before;
        }));
    }
};

constexpr char kSubscribe[] = R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":0}]})";

TEST_F(Watched, TellsWhatThereIsAndWhatComesLater) {
    add_channel(0, "/truth/pose");
    const auto viewer = come();
    EXPECT_EQ(viewer->subprotocol(), "foxglove.sdk.v1");
    const json info = next(*viewer, "serverInfo");
    EXPECT_EQ(info.at("name"), "a flight");
    EXPECT_EQ(info.at("capabilities"),
              json({"time", "assets", "parameters", "parametersSubscribe", "services"}));
    const json known = next(*viewer, "advertise").at("channels").at(0);
    EXPECT_EQ(known.at("topic"), "/truth/pose");
    EXPECT_EQ(known.at("schemaName"), "std_msgs/msg/String");
    EXPECT_EQ(known.at("schema"), "string data");
    EXPECT_EQ(known.at("schemaEncoding"), "ros2msg");
    EXPECT_EQ(known.at("encoding"), "cdr");
    EXPECT_EQ(next(*viewer, "advertiseServices").at("services").at(1).at("name"), "/no");
    add_channel(1, "/events");
    EXPECT_EQ(next(*viewer, "advertise").at("channels").at(0).at("id"), 1);
}

TEST_F(Watched, SendsWhatIsSubscribedAndTheTime) {
    add_channel(0, "/truth/pose");
    add_channel(1, "/events");
    const auto viewer = come();
    (void)next(*viewer, "advertiseServices");
    EXPECT_FALSE(live.watched());
    viewer->send(kSubscribe);
    ASSERT_TRUE(serve::test::comes([&] { return live.watched(); }));
    tell(1, 1'000, "not asked for");
    tell(0, 2'000, "a pose");
    const std::string time = viewer->receive();
    EXPECT_EQ(time[0], 2);
    const std::string frame = viewer->receive();
    const auto head = message_head(7, 2'000);
    EXPECT_EQ(frame, std::string(head.data(), head.size()) + "a pose");

    viewer->send(R"({"op":"unsubscribe","subscriptionIds":[7, 8]})");
    EXPECT_THAT(next(*viewer, "status").at("message"), HasSubstr("subscription 8 is not there"));
    tell(0, 3'000, "unheard");
    live.say(StatusLevel::info, "the end");
    EXPECT_EQ(json::parse(viewer->receive()).at("message"), "the end");
    EXPECT_EQ(live.count().viewers, 1U);
    EXPECT_EQ(live.count().messages, 1U);
}

TEST_F(Watched, WhoComesLateGetsWhatStandsStill) {
    add_channel(0, "/scene");
    add_channel(1, "/truth/pose");
    tell(0, 0, "wall");
    tell(1, 0, "pose");
    for (std::uint64_t k = 1; k < 4; ++k) {
        tell(0, 1'000 * k, "marks " + std::to_string(k));
    }
    const auto viewer = come();
    viewer->send(
        R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":0},{"id":1,"channelId":1}]})");
    EXPECT_EQ(next_bytes(*viewer, 1).substr(13), "wall");
    EXPECT_EQ(next_bytes(*viewer, 1).substr(13), "marks 3");
    ASSERT_TRUE(serve::test::comes([&] { return live.watched(); }));
    tell(1, 5'000, "another pose");
    EXPECT_EQ(next_bytes(*viewer, 1).substr(13), "another pose");
}

TEST_F(Watched, WhoReadsSlowlyGetsTheWallTheNewestAndEveryEvent) {
    add_channel(0, record::kMarkersTopic);
    add_channel(1, record::info(record::Topic::events).name);
    tell(0, 1, "wall");
    const auto viewer = come();
    viewer->send(
        R"({"op": "subscribe", "subscriptions": [{"id": 0, "channelId": 0}, {"id": 1, "channelId": 1}]})");
    EXPECT_THAT(next_bytes(*viewer, '\1'), HasSubstr("wall"));
    // Of far more than queue and kernel hold it reads nothing.
    constexpr int kFrames = 20'000;
    for (int k = 1; k <= kFrames; ++k) {
        std::string arrows = "arrows " + std::to_string(k) + " ";
        arrows.resize(2000, '.');
        tell(0, static_cast<std::uint64_t>(k), arrows);
        if (k % 5000 == 0) {
            tell(1, static_cast<std::uint64_t>(k), "event " + std::to_string(k));
        }
    }
    int events = 0, arrows = 0;
    for (std::string frame; frame.find("event 20000") == std::string::npos; ++arrows) {
        frame = next_bytes(*viewer, '\1');
        ASSERT_FALSE(frame.empty());
        events += frame.find("event ") != std::string::npos ? 1 : 0;
    }
    EXPECT_EQ(events, 4);
    EXPECT_LT(arrows, kFrames);
    EXPECT_GT(live.count().dropped, 0U);
}

TEST_F(Watched, SetsParametersWhenTheFlightTakesThemUp) {
    const auto viewer = come();
    const auto other = come();
    other->send(R"({"op":"subscribeParameterUpdates","parameterNames":["a.gain"]})");
    other->send(R"({"op":"getParameters","parameterNames":["a.gain"],"id":"x"})");
    EXPECT_EQ(next(*other, "parameterValues").at("id"), "x");
    viewer->send(R"({"op":"setParameters","parameters":[{"name":"a.gain","value":1.5},)"
                 R"({"name":"a.count","value":4}],"id":"y"})");
    answer_one();
    EXPECT_THAT(set,
                testing::ElementsAre(testing::Pair("a.gain", 1.5), testing::Pair("a.count", 4)));
    const json told = next(*viewer, "parameterValues");
    EXPECT_EQ(told.at("id"), "y");
    EXPECT_EQ(told.at("parameters").at(0).at("value"), 1.5);
    EXPECT_EQ(told.at("parameters").at(0).at("type"), "float64");
    EXPECT_EQ(told.at("parameters").at(0).at("settable"), true);
    EXPECT_EQ(told.at("parameters").at(0).at("maximum"), 2.0);
    EXPECT_EQ(told.at("parameters").at(1).at("value"), 4);
    const json heard = next(*other, "parameterValues");
    EXPECT_EQ(heard.at("parameters").size(), 1U);
    EXPECT_EQ(heard.at("parameters").at(0).at("name"), "a.gain");
}

TEST_F(Watched, MeshesAreFetchedHoweverLarge) {
    const std::string mesh(3'000'000, 'm');  // more than any viewer's queue
    live.attachment({.name = "cup.stl", .media_type = "model/stl", .text = mesh});
    live.attachment({.name = "scenario.yaml", .media_type = "application/yaml", .text = "a: 1"});
    const auto viewer = come();
    const auto fetch = [&](const std::string& uri) {
        viewer->send(R"({"op":"fetchAsset","requestId":5,"uri":")" + uri + R"("})");
        return next_bytes(*viewer, 4);
    };
    EXPECT_EQ(fetch("package://uav/cup.stl"), asset_response(5, mesh));
    for (const char* other : {"package://uav/../scenario.yaml", "/etc/passwd", "", "cup.stl/"}) {
        EXPECT_EQ(fetch(other),
                  asset_failure(5, "there is no " + std::string(other) + " in this flight"));
    }
}

TEST_F(Watched, WhatCannotBeSetIsRefused) {
    const auto viewer = come();
    const auto refused = [&](const std::string& name, const std::string& value) {
        viewer->send(R"({"op":"setParameters","parameters":[{"name":")" + name + R"(","value":)" +
                     value + "}]}");
        return next(*viewer, "status").at("message").get<std::string>();
    };
    EXPECT_EQ(refused("b.fixed", "6"), "b.fixed cannot be changed in flight");
    EXPECT_EQ(next(*viewer, "parameterValues").at("parameters").at(0).at("value"), 5.0);
    EXPECT_EQ(refused("a.gain", "2.1"), "a.gain = 2.1 is out of range, allowed 0..2");
    EXPECT_EQ(refused("a.count", "2.5"), "a.count = 2.5 must be a whole number");
    EXPECT_EQ(refused("nothing", "1"), "there is no parameter nothing");
    EXPECT_THAT(refused("a.gain", R"("much")"), HasSubstr("type must be number"));
    live.answer(desk);
    EXPECT_TRUE(set.empty());
}

TEST_F(Watched, ServicesAreDoneWhenTheFlightTakesThemUp) {
    const auto viewer = come();
    (void)next(*viewer, "advertiseServices");
    const std::string call = std::string("\2\0\0\0\0\5\0\0\0\3\0\0\0cdr", 16);
    viewer->send_binary(call);
    answer_one();
    EXPECT_THAT(served, testing::ElementsAre("/yes"));
    EXPECT_EQ(next_bytes(*viewer, 3), service_response(0, 5, true, "so it is"));
    std::string nobody = call;
    nobody[1] = 2;
    viewer->send_binary(nobody);
    EXPECT_EQ(next(*viewer, "serviceCallFailure").at("message"), "there is no such service");
    std::string other = call;
    other[13] = 'x';
    viewer->send_binary(other);
    EXPECT_EQ(next(*viewer, "serviceCallFailure").at("message"), "must be encoded as cdr");
}

TEST_F(Watched, TooManyRequestsAreRefused) {
    const auto viewer = come();
    (void)next(*viewer, "advertiseServices");
    for (int i = 0; i < 101; ++i) {
        viewer->send_binary(std::string("\2\1\0\0\0\5\0\0\0\3\0\0\0cdr", 16));
    }
    EXPECT_EQ(next(*viewer, "serviceCallFailure").at("message"), "too many calls are waiting");
    live.answer(desk);
    EXPECT_EQ(served.size(), 100U);
}

TEST_F(Watched, NonsenseIsAnsweredAndHarmsNobody) {
    add_channel(0, "/truth/pose");
    const auto viewer = come();
    (void)next(*viewer, "advertiseServices");
    for (const char* nonsense :
         {"", "[", "[]", "null", R"({"op":1})", R"({"op":"dance"})", R"({"op":"subscribe"})",
          R"({"op":"subscribe","subscriptions":[{"id":"x","channelId":0}]})",
          R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":99}]})",
          R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":-1}]})",
          // the lowest 32 bits are kSubscribe's
          R"({"op":"subscribe","subscriptions":[{"id":4294967303,"channelId":0}]})",
          R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":4294967296}]})",
          R"({"op":"fetchAsset","requestId":4294967296,"uri":"x"})",
          R"({"op":"getParameters","parameterNames":[1]})",
          R"({"op":"setParameters","parameters":{}})"}) {
        viewer->send(nonsense);
        if (std::string_view(nonsense).find("setParameters") == std::string_view::npos) {
            EXPECT_FALSE(next(*viewer, "status").empty()) << nonsense;
        }
    }
    viewer->send_binary("\x01\x02");
    EXPECT_FALSE(next(*viewer, "status").empty());
    viewer->send(kSubscribe);
    viewer->send(kSubscribe);
    EXPECT_THAT(next(*viewer, "status").at("message"), HasSubstr("there already"));
    tell(0, 1'000, "a pose");
    EXPECT_EQ(next_bytes(*viewer, 1).substr(13), "a pose");
}

}  // namespace
