// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "../support/allocations.hpp"
#include "wires.hpp"

using namespace limpet;
using namespace limpet::wire;
using namespace limpet::wire::wires;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

wire::TransportAddress at(std::uint16_t port, wire::Medium medium = wire::Medium::udp,
                          const char* host = "127.0.0.1") {
    wire::TransportAddress address;
    address.medium = medium;
    address.host = host;
    address.port = port;
    return address;
}

struct UdpPair : testing::Test {
    std::unique_ptr<wire::Transport> here = wire::open_transport(at(0), wire::Role::listen);
    std::uint16_t port = here->address().port;
    std::unique_ptr<wire::Transport> there = wire::open_transport(at(port), wire::Role::connect);
};

}  // namespace

TEST_F(UdpPair, EchoesAndKeepsDatagramsApart) {
    EXPECT_EQ(say(*there, "one"), wire::TransferStatus::done);
    EXPECT_EQ(say(*there, "two"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "one");
    EXPECT_EQ(heard(*here), "two");
    EXPECT_EQ(say(*here, "answer"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*there), "answer");
    EXPECT_EQ(here->statistics().peers, 1U);
}

TEST_F(UdpPair, HasNobodyToAnswerBeforeSomebodySpoke) {
    EXPECT_EQ(say(*here, "anybody?"), wire::TransferStatus::no_peer);
    EXPECT_THAT(here->describe(), HasSubstr("nobody there"));
    EXPECT_FALSE(here->wait_for_peer(10ms));
    EXPECT_EQ(say(*there, "hello"), wire::TransferStatus::done);
    EXPECT_TRUE(here->wait_for_peer(kLong));
    EXPECT_EQ(say(*here, "hello yourself"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*there), "hello yourself");
    EXPECT_EQ(heard(*here), "hello");  // waiting did not eat it
}

TEST_F(UdpPair, WhoSpeaksKeepsItsPlaceWhileOthersSendRubbish) {
    RawSocket other(SOCK_DGRAM);
    ASSERT_TRUE(other.connect(port));
    EXPECT_EQ(say(*there, "first"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "first");
    other.say("rubbish");
    EXPECT_EQ(heard(*here, 10ms), "<timed out>");
    EXPECT_EQ(say(*here, "pump on"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*there), "pump on");
    EXPECT_EQ(here->statistics().peers, 1U);
    EXPECT_EQ(here->statistics().peers_refused, 1U);
}

TEST_F(UdpPair, WhoIsNotLetInIsNobodysPeerHoweverOftenItSpeaks) {
    here->admit([](std::span<const std::byte> datagram) {
        return datagram.size() > 1 && datagram[0] == std::byte{'a'};
    });
    RawSocket other(SOCK_DGRAM);
    ASSERT_TRUE(other.connect(port));
    other.say("x");
    EXPECT_FALSE(here->wait_for_peer(20ms));
    other.say("y");
    EXPECT_EQ(heard(*here, 20ms), "<timed out>");
    EXPECT_EQ(here->statistics().peers, 0U);
    EXPECT_EQ(here->statistics().peers_refused, 2U);
    EXPECT_EQ(say(*there, "a friend"), wire::TransferStatus::done);
    EXPECT_TRUE(here->wait_for_peer(5s));
    EXPECT_EQ(heard(*here), "a friend");
    EXPECT_EQ(say(*there, "may now say anything"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "may now say anything");
    other.say("also a word");
    EXPECT_EQ(heard(*here, 20ms), "<timed out>");  // one at a time
}

TEST_F(UdpPair, AnswersTheNextOneOnceTheFormerIsSilent) {
    RawSocket other(SOCK_DGRAM);
    ASSERT_TRUE(other.connect(port));
    EXPECT_EQ(say(*there, "first"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "first");
    std::string now = "<timed out>";
    const auto end = std::chrono::steady_clock::now() + 10s;
    while (now == "<timed out>" && std::chrono::steady_clock::now() < end) {
        other.say("second");
        now = heard(*here, 50ms);
    }
    EXPECT_EQ(now, "second");
    EXPECT_EQ(say(*here, "to the second"), wire::TransferStatus::done);
    EXPECT_EQ(other.heard(), "to the second");
    EXPECT_EQ(heard(*there, 10ms), "<timed out>");
    EXPECT_EQ(here->statistics().peers, 2U);
}

TEST_F(UdpPair, WhoSpeaksToOneHostHearsItAlone) {
    EXPECT_EQ(say(*there, "x"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "x");
    const std::string text = here->describe();
    const auto theirs = static_cast<std::uint16_t>(std::stoi(
        text.substr(text.find("peer 127.0.0.1:") + std::string("peer 127.0.0.1:").size())));
    RawSocket stranger(SOCK_DGRAM);
    ASSERT_TRUE(stranger.connect(theirs));
    stranger.say("disarm!");
    EXPECT_EQ(heard(*there, 20ms), "<timed out>");
}

TEST_F(UdpPair, WithoutTimeToWaitWhatIsThereIsTakenAndStrangersPassedOver) {
    EXPECT_EQ(say(*there, "mine"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "mine");
    RawSocket stranger(SOCK_DGRAM);
    ASSERT_TRUE(stranger.connect(port));
    stranger.say("one");
    stranger.say("two");
    EXPECT_EQ(say(*there, "again"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here, 0ms), "again") << "loopback delivers within the call";
    EXPECT_EQ(heard(*here, 0ms), "<timed out>");
    EXPECT_EQ(here->statistics().peers_refused, 2U);
}

TEST_F(UdpPair, OneThatCallsKeepsTheFirstThatSpeaks) {
    const auto caller = wire::open_udp_between(at(0), at(port));
    EXPECT_EQ(say(*caller, "hello"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "hello");
    RawSocket first(SOCK_DGRAM);
    ASSERT_TRUE(first.connect(caller->address().port));
    first.say("I am the first");
    EXPECT_EQ(heard(*caller), "I am the first");
    EXPECT_EQ(say(*here, "too late"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*caller, 20ms), "<timed out>");
    EXPECT_EQ(say(*caller, "to you"), wire::TransferStatus::done);
    EXPECT_EQ(first.heard(), "to you");
    EXPECT_THROW((void)wire::open_udp_between(caller->address(), at(port)), InputError);
}

TEST_F(UdpPair, WhatDidNotFitTheBufferIsGone) {
    EXPECT_EQ(there->send(many_bytes(1500), kLong).status, wire::TransferStatus::done);
    EXPECT_EQ(heard(*here).size(), 1000U);  // the buffer of heard()
    EXPECT_EQ(say(*there, "next"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "next");
}

TEST_F(UdpPair, PassesOverEmptyDatagrams) {
    EXPECT_EQ(say(*there, ""), wire::TransferStatus::done);
    EXPECT_FALSE(here->wait_for_peer(10ms));
    EXPECT_EQ(say(*there, ""), wire::TransferStatus::done);
    EXPECT_EQ(say(*there, "full"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "full");
}

TEST_F(UdpPair, AMessageBeyondADatagramIsAFaultOfOurs) {
    EXPECT_EQ(there->send(many_bytes(65507), kLong).status, wire::TransferStatus::done);
    EXPECT_THROW((void)there->send(many_bytes(65508), kLong), InternalError);
}

TEST_F(UdpPair, APeerThatIsGoneIsNoticedAndTheNextHeard) {
    here->close();
    EXPECT_EQ(say(*there, "lost"), wire::TransferStatus::done);
    EXPECT_EQ(say(*there, "refused"), wire::TransferStatus::no_peer);
    const auto next = wire::open_transport(at(port), wire::Role::listen);
    EXPECT_EQ(say(*there, "back"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*next), "back");
}

TEST_F(UdpPair, WaitsEndOnTimeThroughSignals) {
    const Interruptions interruptions;
    const auto took = time_of([&] { EXPECT_EQ(heard(*here, 60ms), "<timed out>"); });
    EXPECT_GE(took, 60ms);
    EXPECT_LT(took, 1s);
    EXPECT_GE(time_of([&] { EXPECT_FALSE(here->wait_for_peer(60ms)); }), 60ms);
}

TEST_F(UdpPair, CarriesTenMegabytesADatagramAnAnswer) {
    const Bytes all = many_bytes(10'000'000);
    const std::size_t piece = 50'000;
    Bytes came;
    Bytes buffer(piece);
    for (std::size_t at = 0; at < all.size(); at += piece) {
        const auto part = std::span(all).subspan(at, piece);
        ASSERT_EQ(there->send(part, kLong).status, wire::TransferStatus::done);
        ASSERT_EQ(here->receive(buffer, kLong).bytes, piece);
        came.insert(came.end(), buffer.begin(), buffer.end());
        ASSERT_EQ(say(*here, "ok"), wire::TransferStatus::done);
        ASSERT_EQ(heard(*there), "ok");
    }
    EXPECT_TRUE(came == all);
}

TEST_F(UdpPair, SendAndReceiveDoNotAllocate) {
    const Bytes message = many_bytes(280);
    Bytes buffer(1000);
    std::size_t echoed = 0;
    const long before = allocations();
    for (int i = 0; i < 100; ++i) {
        (void)there->send(message, kLong);
        echoed += here->receive(buffer, kLong).bytes;
        (void)here->send(message, kLong);
        echoed += there->receive(buffer, kLong).bytes;
    }
    EXPECT_EQ(allocations() - before, 0);
    EXPECT_EQ(echoed, 2U * 100U * 280U);
}

TEST_F(UdpPair, APortInUseIsOneClearLine) {
    const std::string line =
        refusal([&] { (void)wire::open_transport(at(port), wire::Role::listen); });
    EXPECT_THAT(line, AllOf(HasSubstr("address 'udp:127.0.0.1:" + std::to_string(port) + "'"),
                            HasSubstr("is in use"), Not(HasSubstr("\n"))));
}

TEST_F(UdpPair, ListensOnLoopbackAloneUnlessToldOtherwise) {
    RawSocket beside(SOCK_DGRAM);
    ASSERT_TRUE(beside.connect(port, "127.0.0.2"));
    beside.say("x");
    EXPECT_EQ(heard(*here, 20ms), "<timed out>");
    const auto open = wire::open_transport(at(0, wire::Medium::udp, "0.0.0.0"), wire::Role::listen);
    RawSocket allowed(SOCK_DGRAM);
    ASSERT_TRUE(allowed.connect(open->address().port, "127.0.0.2"));
    allowed.say("x");
    EXPECT_EQ(heard(*open), "x");
}

TEST_F(UdpPair, ClosedItDoesNothingMore) {
    here->close();
    here->close();
    EXPECT_EQ(heard(*here), "<closed>");
    EXPECT_EQ(say(*here, "x"), wire::TransferStatus::closed);
    EXPECT_FALSE(here->wait_for_peer(kLong));
    EXPECT_THAT(here->describe(), HasSubstr("closed"));
}

// 127.255.255.255 is the broadcast address of the loopback card.
TEST(UdpBroadcast, IsSentOnlyWhenAskedForAndAnswered) {
    const auto here = wire::open_transport(at(0, wire::Medium::udp_broadcast, "127.255.255.255"),
                                           wire::Role::listen);
    const std::uint16_t port = here->address().port;
    EXPECT_THAT(refusal([&] {
                    (void)open_transport(at(port, Medium::udp, "127.255.255.255"), Role::connect);
                }),
                HasSubstr("write udp-broadcast:"));
    const auto there = open_transport(at(port, wire::Medium::udp_broadcast, "127.255.255.255"),
                                      wire::Role::connect);
    EXPECT_EQ(say(*there, "who is there?"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*here), "who is there?");
    EXPECT_EQ(say(*here, "I am"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*there), "I am");
}

TEST(UdpMulticast, ReachesEveryListenerOfTheGroup) {
    wire::TransportAddress group = at(0, wire::Medium::udp_multicast, "239.255.42.99");
    group.interface = "127.0.0.1";
    const auto one = wire::open_transport(group, wire::Role::listen);
    group.port = one->address().port;
    const auto two = open_transport(group, wire::Role::listen);
    const auto speaker = open_transport(group, wire::Role::connect);
    EXPECT_EQ(say(*speaker, "pose"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*one), "pose");
    EXPECT_EQ(heard(*two), "pose");
    EXPECT_EQ(say(*one, "thanks"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*speaker), "thanks");
    RawSocket alone(SOCK_DGRAM);
    ASSERT_TRUE(alone.connect(group.port));
    alone.say("not for the group");
    EXPECT_EQ(heard(*one, 20ms), "<timed out>");
}

TEST(UdpMulticast, AnInterfaceThatIsNotThereIsOneClearLine) {
    wire::TransportAddress group = at(0, wire::Medium::udp_multicast, "239.255.42.99");
    group.interface = "192.0.2.1";
    EXPECT_THAT(refusal([&] { (void)wire::open_transport(group, wire::Role::listen); }),
                AllOf(HasSubstr("@192.0.2.1': "), Not(HasSubstr("\n"))));
}
