// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/wire_log.hpp"

#include <tuple>
#include <utility>

#include "limpet/mavlink/messages.hpp"
#include "limpet/mcap/reader.hpp"

namespace limpet::simulation {
namespace {

constexpr std::uint16_t kNoSchema = 0;
constexpr const char *kSentTopic = "/wire/sent", *kReceivedTopic = "/wire/received";

template <class... Message>
std::map<std::uint32_t, std::string_view> names_of(std::type_identity<std::tuple<Message...>>) {
    return {{Message::kId, Message::kName}...};
}

class TappedTransport final : public wire::Transport {
public:
    TappedTransport(std::unique_ptr<wire::Transport> wire, WireLog& log)
        : wire_(std::move(wire)), log_(log) {}

    wire::Transfer send(std::span<const std::byte> bytes,
                        std::chrono::nanoseconds timeout) override {
        const wire::Transfer transfer = wire_->send(bytes, timeout);
        if (transfer.bytes > 0) {
            log_.sent(bytes.first(transfer.bytes));
        }
        return transfer;
    }

    wire::Transfer receive(std::span<std::byte> into, std::chrono::nanoseconds timeout) override {
        const wire::Transfer transfer = wire_->receive(into, timeout);
        if (transfer.bytes > 0) {
            log_.received(into.first(transfer.bytes));
        }
        return transfer;
    }

    bool wait_for_peer(std::chrono::nanoseconds timeout) override {
        return wire_->wait_for_peer(timeout);
    }
    void close() override { wire_->close(); }
    wire::TransportAddress address() const override { return wire_->address(); }
    std::string describe() const override { return wire_->describe(); }
    const wire::TransportStatistics& statistics() const override { return wire_->statistics(); }

private:
    std::unique_ptr<wire::Transport> wire_;
    WireLog& log_;
};

}  // namespace

WireLog::WireLog(const std::filesystem::path& path)
    : writer_(path),
      sent_(writer_.add_channel(kNoSchema, kSentTopic, "mavlink")),
      received_(writer_.add_channel(kNoSchema, kReceivedTopic, "mavlink")),
      begin_(std::chrono::steady_clock::now()) {}

void WireLog::write(std::uint16_t channel, std::span<const std::byte> bytes) {
    const auto since = std::chrono::steady_clock::now() - begin_;
    writer_.write(channel,
                  static_cast<std::uint64_t>(
                      std::chrono::duration_cast<std::chrono::nanoseconds>(since).count()),
                  {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

std::unique_ptr<wire::Transport> tapped(std::unique_ptr<wire::Transport> wire, WireLog& log) {
    return std::make_unique<TappedTransport>(std::move(wire), log);
}

std::optional<WireTally> read_wire_log(const std::filesystem::path& path) {
    const auto names = names_of(std::type_identity<mavlink::AllMessages>());
    WireTally tally;
    mavlink::Parser sent, received;
    const mcap::Contents contents =
        mcap::read(path, [&](const mcap::Contents& before, const mcap::Message& message) {
            const std::string& topic = before.channels.at(message.channel_id).topic;
            const bool is_sent = topic == kSentTopic;
            if (!is_sent && topic != kReceivedTopic) {
                return;
            }
            mcap::ByteView bytes = message.data;
            while (const auto frame = (is_sent ? sent : received).next(bytes)) {
                ++(is_sent ? tally.sent : tally.received).messages[names.at(frame->id)];
            }
        });
    const auto has = [&contents](std::string_view topic) {
        return std::any_of(contents.channels.begin(), contents.channels.end(),
                           [&](const auto& row) { return row.second.topic == topic; });
    };
    if (!has(kSentTopic) && !has(kReceivedTopic)) {
        return std::nullopt;
    }
    tally.sent.statistics = sent.statistics();
    tally.received.statistics = received.statistics();
    tally.lasted_s = 1e-9 * static_cast<double>(contents.last_time_ns);
    tally.damage = contents.damage;
    return tally;
}

}  // namespace limpet::simulation
