// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <set>
#include <thread>

#include "../support/allocations.hpp"
#include "wires.hpp"

using namespace limpet;
using namespace limpet::wire;
using namespace limpet::wire::wires;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

constexpr std::size_t kMany = 10'000'000;

std::unique_ptr<wire::Transport> server_at(const char* host, std::uint16_t port = 0) {
    return wire::open_transport({.host = host, .port = port}, wire::Role::listen);
}

struct TcpServed : testing::Test {
    std::unique_ptr<wire::Transport> server = server_at("127.0.0.1");
    std::uint16_t port = server->address().port;
};

struct TcpPair : TcpServed {
    std::unique_ptr<wire::Transport> client =
        wire::open_transport({.port = port}, wire::Role::connect);

    void SetUp() override {
        ASSERT_TRUE(client->wait_for_peer(kLong));
        ASSERT_TRUE(server->wait_for_peer(kLong));
    }
};

std::set<int> descriptors() {
    std::set<int> open;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        open.insert(std::stoi(entry.path().filename()));
    }
    return open;
}

}  // namespace

TEST_F(TcpServed, EchoesToASocketThatIsNotOurs) {
    RawSocket client(SOCK_STREAM);
    ASSERT_TRUE(client.connect(port));
    client.say("hello");
    EXPECT_EQ(heard(*server), "hello");
    EXPECT_EQ(say(*server, "hello yourself"), wire::TransferStatus::done);
    EXPECT_EQ(client.heard(), "hello yourself");
    EXPECT_EQ(server->statistics().peers, 1U);
}

TEST_F(TcpServed, DeliversHalfAFrameAndTheOtherHalfLater) {
    RawSocket client(SOCK_STREAM);
    ASSERT_TRUE(client.connect(port));
    client.say("FRA");
    EXPECT_EQ(heard(*server), "FRA");
    EXPECT_EQ(heard(*server, 10ms), "<timed out>");
    client.say("ME");
    EXPECT_EQ(heard(*server), "ME");
}

TEST_F(TcpServed, RefusesASecondClientAndKeepsTheFirst) {
    RawSocket first(SOCK_STREAM);
    ASSERT_TRUE(first.connect(port));
    ASSERT_TRUE(server->wait_for_peer(kLong));
    RawSocket second(SOCK_STREAM);
    ASSERT_TRUE(second.connect(port));
    EXPECT_EQ(heard(*server, 10ms), "<timed out>");
    EXPECT_EQ(second.heard(), "<reset>");
    EXPECT_EQ(server->statistics().peers_refused, 1U);
    first.say("still here");
    EXPECT_EQ(heard(*server), "still here");
    EXPECT_EQ(server->statistics().peers, 1U);
}

TEST_F(TcpServed, TurnsAwayOthersAlsoWhileTheFirstTalksWithoutAPause) {
    RawSocket first(SOCK_STREAM);
    ASSERT_TRUE(first.connect(port));
    ASSERT_TRUE(server->wait_for_peer(kLong));
    RawSocket second(SOCK_STREAM);
    ASSERT_TRUE(second.connect(port));
    first.say("talk");
    EXPECT_EQ(heard(*server), "talk");
    EXPECT_EQ(server->statistics().peers_refused, 1U);
}

TEST_F(TcpServed, ClientGoneAndBackAgain) {
    {
        RawSocket client(SOCK_STREAM);
        ASSERT_TRUE(client.connect(port));
        client.say("one");
        EXPECT_EQ(heard(*server), "one");
    }
    EXPECT_EQ(heard(*server), "<peer lost>");
    EXPECT_EQ(say(*server, "anybody?"), wire::TransferStatus::no_peer);
    EXPECT_EQ(heard(*server, 10ms), "<timed out>");
    RawSocket again(SOCK_STREAM);
    ASSERT_TRUE(again.connect(port));
    again.say("two");
    EXPECT_EQ(heard(*server), "two");
    EXPECT_EQ(server->statistics().peers, 2U);
    EXPECT_EQ(server->statistics().peers_lost, 1U);
}

TEST_F(TcpServed, OneThatIsBackBeforeItsEndWasSeenIsNotRefused) {
    RawSocket client(SOCK_STREAM);
    ASSERT_TRUE(client.connect(port));
    ASSERT_TRUE(server->wait_for_peer(kLong));
    client.say("last words");
    client.close();
    RawSocket again(SOCK_STREAM);
    ASSERT_TRUE(again.connect(port));
    again.say("back");
    EXPECT_EQ(heard(*server), "last words");
    EXPECT_EQ(heard(*server), "<peer lost>");
    EXPECT_EQ(heard(*server), "back");
    EXPECT_EQ(server->statistics().peers_refused, 0U);
}

TEST_F(TcpServed, PeerGoneInTheMiddleOfASendIsLostAndKillsNobody) {
    RawSocket client(SOCK_STREAM);
    ASSERT_TRUE(client.connect(port));
    ASSERT_TRUE(server->wait_for_peer(kLong));
    std::thread leaving([&] {
        (void)client.heard();
        std::this_thread::sleep_for(20ms);
        client.close();
    });
    const wire::Transfer transfer = server->send(many_bytes(5 * kMany), kLong);
    leaving.join();
    EXPECT_EQ(transfer.status, wire::TransferStatus::peer_lost);
    EXPECT_GT(transfer.bytes, 0U);
    EXPECT_LT(transfer.bytes, 5 * kMany);
    EXPECT_EQ(say(*server, "x"), wire::TransferStatus::no_peer);
}

TEST_F(TcpServed, SendTimesOutWhenThePeerDoesNotRead) {
    RawSocket client(SOCK_STREAM);
    ASSERT_TRUE(client.connect(port));
    ASSERT_TRUE(server->wait_for_peer(kLong));
    const Bytes much = many_bytes(5 * kMany);
    wire::Transfer transfer;
    const auto took = time_of([&] { transfer = server->send(much, 60ms); });
    EXPECT_EQ(transfer.status, wire::TransferStatus::timed_out);
    EXPECT_GT(transfer.bytes, 0U);
    EXPECT_LT(transfer.bytes, much.size());
    EXPECT_GE(took, 60ms);
    EXPECT_LT(took, 1s);
}

TEST_F(TcpServed, WaitsEndOnTimeThroughSignals) {
    {
        const Interruptions interruptions;
        const auto alone = time_of([&] { EXPECT_EQ(heard(*server, 60ms), "<timed out>"); });
        EXPECT_GE(alone, 60ms);
        EXPECT_LT(alone, 1s);
    }
    RawSocket client(SOCK_STREAM);
    ASSERT_TRUE(client.connect(port));  // which a signal would end, seldom
    const Interruptions interruptions;
    ASSERT_TRUE(server->wait_for_peer(kLong));
    const auto silent = time_of([&] { EXPECT_EQ(heard(*server, 60ms), "<timed out>"); });
    EXPECT_GE(silent, 60ms);
    EXPECT_LT(silent, 1s);
    EXPECT_LT(time_of([&] { EXPECT_EQ(heard(*server, -1s), "<timed out>"); }), 50ms);
}

TEST_F(TcpServed, AskedForNoTimeItTakesWhatIsThere) {
    RawSocket client(SOCK_STREAM);
    ASSERT_TRUE(client.connect(port));
    ASSERT_TRUE(server->wait_for_peer(kLong));
    client.say("there");
    EXPECT_EQ(heard(*server, 0ns), "there");
    EXPECT_EQ(heard(*server, 0ns), "<timed out>");
}

TEST_F(TcpServed, ListensOnLoopbackAloneUnlessToldOtherwise) {
    EXPECT_FALSE(RawSocket(SOCK_STREAM).connect(port, "127.0.0.2"));
    const auto open = server_at("0.0.0.0");
    EXPECT_TRUE(RawSocket(SOCK_STREAM).connect(open->address().port, "127.0.0.2"));
}

TEST_F(TcpServed, APortInUseIsOneClearLine) {
    const std::string line = refusal([&] { (void)server_at("127.0.0.1", port); });
    const std::string number = std::to_string(port);
    EXPECT_THAT(line, AllOf(HasSubstr("address 'tcp:127.0.0.1:" + number + "'"),
                            HasSubstr("port " + number + " is in use"), Not(HasSubstr("\n"))));
}

TEST_F(TcpServed, AnAddressOfAnotherMachineIsOneClearLine) {
    // 192.0.2.0/24 is for documentation (RFC 5737): nobody has it.
    EXPECT_THAT(refusal([] { (void)server_at("192.0.2.1"); }),
                HasSubstr("192.0.2.1 is no address of this machine"));
}

TEST_F(TcpServed, ThePortIsFreeAgainAfterClosing) {
    RawSocket client(SOCK_STREAM);
    ASSERT_TRUE(client.connect(port));
    ASSERT_TRUE(server->wait_for_peer(kLong));
    server->close();
    server->close();
    EXPECT_EQ(heard(*server), "<closed>");
    EXPECT_EQ(say(*server, "x"), wire::TransferStatus::closed);
    EXPECT_FALSE(server->wait_for_peer(kLong));
    EXPECT_THAT(server->describe(), HasSubstr("closed"));
    EXPECT_EQ(client.heard(), "");
    EXPECT_EQ(server_at("127.0.0.1", port)->address().port, port);
}

TEST_F(TcpServed, SaysWhoIsThere) {
    EXPECT_THAT(server->describe(), HasSubstr("nobody there"));
    RawSocket client(SOCK_STREAM);
    ASSERT_TRUE(client.connect(port));
    ASSERT_TRUE(server->wait_for_peer(kLong));
    EXPECT_THAT(server->describe(), AllOf(HasSubstr("tcp:127.0.0.1:" + std::to_string(port)),
                                          HasSubstr("peer 127.0.0.1:")));
}

TEST(TcpDescriptors, AreNotInheritedByChildren) {
    const std::set<int> before = descriptors();
    const auto server = server_at("127.0.0.1");
    const auto client = wire::open_transport({.port = server->address().port}, wire::Role::connect);
    ASSERT_TRUE(client->wait_for_peer(kLong));
    ASSERT_TRUE(server->wait_for_peer(kLong));
    int ours = 0;
    for (const int each : descriptors()) {
        if (!before.contains(each) && fcntl(each, F_GETFD) >= 0) {
            EXPECT_TRUE(fcntl(each, F_GETFD) & FD_CLOEXEC) << each;
            ++ours;
        }
    }
    EXPECT_GE(ours, 3);
}

TEST_F(TcpPair, CarriesTenMegabytesEachWay) {
    const Bytes all = many_bytes(kMany);
    Bytes there;
    Bytes back;
    std::thread other([&] {
        there = receive_all(*client, kMany);
        (void)client->send(there, kLong);
    });
    EXPECT_EQ(server->send(all, kLong).status, wire::TransferStatus::done);
    back = receive_all(*server, kMany);
    other.join();
    EXPECT_TRUE(there == all);
    EXPECT_TRUE(back == all);
}

TEST_F(TcpPair, CarriesThemThroughSignalsToo) {
    const Interruptions interruptions;
    const Bytes all = many_bytes(kMany);
    Bytes there;
    std::thread other([&] { there = receive_all(*client, kMany); });
    EXPECT_EQ(server->send(all, kLong).status, wire::TransferStatus::done);
    other.join();
    EXPECT_TRUE(there == all);
}

TEST_F(TcpPair, SendAndReceiveDoNotAllocate) {
    const Bytes message = many_bytes(280);  // the longest frame of MAVLink 2, unsigned
    Bytes buffer(1000);
    std::size_t echoed = 0;
    const long before = allocations();
    for (int i = 0; i < 100; ++i) {
        (void)server->send(message, kLong);
        echoed += client->receive(buffer, kLong).bytes;
        (void)client->send(message, kLong);
        echoed += server->receive(buffer, kLong).bytes;
    }
    EXPECT_EQ(allocations() - before, 0);
    EXPECT_EQ(echoed, 2U * 100U * 280U);
}

TEST_F(TcpPair, TheClientComesBackToANewServer) {
    server->close();
    EXPECT_EQ(heard(*client), "<peer lost>");
    EXPECT_EQ(heard(*client, 20ms), "<timed out>");
    const auto next = server_at("127.0.0.1", port);
    ASSERT_TRUE(client->wait_for_peer(kLong));
    EXPECT_EQ(say(*client, "again"), wire::TransferStatus::done);
    EXPECT_EQ(heard(*next), "again");
    EXPECT_EQ(client->statistics().peers, 2U);
}

TEST(TcpClient, WaitsForItsServerAsLongAsItIsToldTo) {
    const std::uint16_t port = server_at("127.0.0.1")->address().port;  // closed again
    const auto client = wire::open_transport({.port = port}, wire::Role::connect);
    const auto took = time_of([&] { EXPECT_FALSE(client->wait_for_peer(250ms)); });
    EXPECT_GE(took, 250ms);
    EXPECT_LT(took, 1s);
    EXPECT_EQ(say(*client, "x"), wire::TransferStatus::no_peer);
    EXPECT_THAT(client->describe(), HasSubstr("not connected"));
    client->close();
    EXPECT_EQ(say(*client, "x"), wire::TransferStatus::closed);
}
