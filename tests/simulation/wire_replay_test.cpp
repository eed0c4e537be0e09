// SPDX-License-Identifier: Apache-2.0
// What a real PX4 v1.15.1 said and was told over the simulator link in a whole flight of
// perch_concrete (`limpet fly perch_concrete --autopilot px4 --record-wire`), replayed against the
// codec and the lockstep logic.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "limpet/mavlink/hil.hpp"
#include "limpet/mcap/reader.hpp"
#include "limpet/simulation/wire_log.hpp"

namespace limpet::simulation {
namespace {

using mavlink::ByteView;

struct Piece {
    bool sent = false;
    std::vector<std::uint8_t> bytes;
};

const std::vector<Piece>& recorded() {
    static const std::vector<Piece> pieces = [] {
        std::vector<Piece> all;
        const std::string path =
            std::string(LIMPET_SOURCE_DIR) + "/tests/data/px4_1.15.1_hil_perch_concrete.mcap";
        (void)mcap::read(path, [&](const mcap::Contents& contents, const mcap::Message& message) {
            all.push_back({.sent = contents.channels.at(message.channel_id).topic == "/wire/sent",
                           .bytes = {message.data.begin(), message.data.end()}});
        });
        return all;
    }();
    return pieces;
}

/// Gives what was received where it was received; a wait for what was not there ends at once.
class Replay final : public wire::Transport {
public:
    wire::Transfer send(std::span<const std::byte> bytes, std::chrono::nanoseconds) override {
        in_order_ = in_order_ && next_ < recorded().size() && recorded()[next_].sent;
        ++next_;
        return {wire::TransferStatus::done, bytes.size()};
    }
    wire::Transfer receive(std::span<std::byte> into, std::chrono::nanoseconds) override {
        if (next_ >= recorded().size() || recorded()[next_].sent) {
            return {wire::TransferStatus::timed_out, 0};
        }
        const auto& bytes = recorded()[next_++].bytes;
        std::memcpy(into.data(), bytes.data(), bytes.size());
        return {wire::TransferStatus::done, bytes.size()};
    }
    bool wait_for_peer(std::chrono::nanoseconds) override { return true; }
    void close() override {}
    wire::TransportAddress address() const override { return {}; }
    std::string describe() const override { return "replay"; }
    const wire::TransportStatistics& statistics() const override { return statistics_; }

    [[nodiscard]] bool in_order() const { return in_order_; }

private:
    std::size_t next_ = 0;
    bool in_order_ = true;
    wire::TransportStatistics statistics_{.peers = 1};
};

template <class Each>
void each_frame(bool sent, const Each& each) {
    mavlink::Parser parser;
    for (const Piece& piece : recorded()) {
        if (piece.sent == sent) {
            ByteView bytes(piece.bytes);
            while (const auto frame = parser.next(bytes)) {
                each(*frame);
            }
        }
    }
    EXPECT_EQ(parser.statistics().lost, 0U);
    EXPECT_EQ(parser.statistics().bad_checksum, 0U);
    EXPECT_EQ(parser.statistics().discarded_bytes, 0U);
}

/// Decoded and encoded anew, it is the same bytes: ours and PX4's codec agree in every field.
template <class Message>
void same_again(const mavlink::Frame& frame) {
    if (const auto message = mavlink::decode<Message>(frame)) {
        mavlink::Sender sender{frame.system, frame.component, frame.sequence};
        mavlink::FrameBuffer buffer;
        const ByteView again = mavlink::encode(*message, sender, buffer);
        ASSERT_TRUE(std::equal(again.begin(), again.end(), frame.bytes.begin(), frame.bytes.end()))
            << Message::kName;
    }
}

TEST(Px4Recording, EveryFrameOfItsSurvivesDecodingAndEncoding) {
    std::size_t answers = 0;
    std::size_t others = 0;
    each_frame(false, [&](const mavlink::Frame& frame) {
        same_again<mavlink::HilActuatorControls>(frame);
        same_again<mavlink::Heartbeat>(frame);
        same_again<mavlink::CommandLong>(frame);
        ++(frame.id == mavlink::HilActuatorControls::kId ? answers : others);
    });
    EXPECT_GT(answers, 10'000U);
    EXPECT_EQ(others, 2U) << "on connecting a COMMAND_LONG and a HEARTBEAT, then nothing more";
    each_frame(true, [](const mavlink::Frame& frame) {
        same_again<mavlink::HilSensor>(frame);
        same_again<mavlink::Odometry>(frame);
    });
}

TEST(Px4Recording, LockstepTakesExactlyOneAnswerToEachOfItsSensors) {
    auto wire = std::make_unique<Replay>();
    const Replay& replay = *wire;
    mavlink::Link link(std::move(wire), {.system = 255, .component = 191});
    mavlink::Hil hil(link, {});
    std::vector<Readings> readings;
    std::vector<std::uint64_t> times_usec;
    Readings now;
    each_frame(true, [&](const mavlink::Frame& frame) {
        if (const auto sensor = mavlink::decode<mavlink::HilSensor>(frame)) {
            mavlink::take(*sensor, 1e-6 * static_cast<double>(sensor->time_usec), now);
            readings.push_back(now);
            times_usec.push_back(sensor->time_usec);
        }
    });
    std::size_t waiting = 0;
    std::vector<bool> armed;
    for (std::size_t k = 0; k < readings.size(); ++k) {
        hil.send(readings[k], times_usec[k]);
        const auto status = hil.receive([](const mavlink::Frame&) {});
        if (status == mavlink::HilStatus::waiting) {
            ++waiting;
            continue;
        }
        ASSERT_EQ(status, mavlink::HilStatus::answered) << k;
        if (armed.empty() || armed.back() != hil.command().armed) {
            armed.push_back(hil.command().armed);
        }
    }
    EXPECT_TRUE(replay.in_order());
    EXPECT_GT(waiting, 5U) << "it answers late at first";
    EXPECT_LT(waiting, 100U);
    EXPECT_EQ(hil.count().strays, 0U);
    EXPECT_EQ(hil.count().unanswered, 0U);
    EXPECT_EQ(hil.count().answers, readings.size() - waiting);
    // Boots disarmed, flies, rests on the wall, flies back.
    EXPECT_THAT(armed, testing::ElementsAre(false, true, false, true));
}

}  // namespace
}  // namespace limpet::simulation
