// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "limpet/mavlink/link.hpp"

namespace limpet::mavlink {

/// A wire whose far end is a script: what is sent is kept, what is received was put there before or
/// is put there by `on_send`. Nothing waits.
class ScriptedWire final : public wire::Transport {
public:
    struct Ends {
        std::vector<std::vector<std::byte>> sent;
        std::deque<std::vector<std::byte>> to_receive;
        std::function<void(std::span<const std::byte>)> on_send;
        std::function<void()> on_empty;  ///< nothing was there to receive: it may put something
        wire::TransportStatistics statistics{.peers = 1};
    };

    explicit ScriptedWire(std::shared_ptr<Ends> ends) : ends_(std::move(ends)) {}

    wire::Transfer send(std::span<const std::byte> bytes, std::chrono::nanoseconds) override {
        ends_->sent.emplace_back(bytes.begin(), bytes.end());
        if (ends_->on_send) {
            ends_->on_send(bytes);
        }
        return {wire::TransferStatus::done, bytes.size()};
    }
    wire::Transfer receive(std::span<std::byte> into, std::chrono::nanoseconds) override {
        if (ends_->to_receive.empty() && ends_->on_empty) {
            ends_->on_empty();
        }
        if (ends_->to_receive.empty()) {
            return {wire::TransferStatus::timed_out, 0};
        }
        const std::vector<std::byte> piece = std::move(ends_->to_receive.front());
        ends_->to_receive.pop_front();
        std::memcpy(into.data(), piece.data(), piece.size());
        return {wire::TransferStatus::done, piece.size()};
    }
    bool wait_for_peer(std::chrono::nanoseconds) override { return true; }
    void close() override {}
    wire::TransportAddress address() const override { return {}; }
    std::string describe() const override { return "script"; }
    const wire::TransportStatistics& statistics() const override { return ends_->statistics; }

private:
    std::shared_ptr<Ends> ends_;
};

/// A link on a script, and the script's side of it.
struct ScriptedLink {
    std::shared_ptr<ScriptedWire::Ends> ends = std::make_shared<ScriptedWire::Ends>();
    Link link{std::make_unique<ScriptedWire>(ends),
              Sender{.system = 255, .component = kCompanionComponent}};
    Sender autopilot{.system = 1, .component = kAutopilotComponent};

    template <class Message>
    static std::vector<std::byte> frame_of(const Message& message, Sender& from) {
        FrameBuffer buffer;
        const auto bytes = std::as_bytes(encode(message, from, buffer));
        return {bytes.begin(), bytes.end()};
    }

    /// The autopilot says it; the next receive gives it.
    template <class Message>
    void say(const Message& message) {
        ends->to_receive.push_back(frame_of(message, autopilot));
    }

    /// All messages of a kind that were sent, in their order; forgets nothing.
    template <class Message>
    std::vector<Message> sent() const {
        std::vector<Message> messages;
        Parser parser;
        for (const auto& piece : ends->sent) {
            ByteView bytes(reinterpret_cast<const std::uint8_t*>(piece.data()), piece.size());
            while (const auto frame = parser.next(bytes)) {
                if (const auto message = decode<Message>(*frame)) {
                    messages.push_back(*message);
                }
            }
        }
        return messages;
    }
};

}  // namespace limpet::mavlink
