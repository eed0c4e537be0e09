// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/wire_log.hpp"

#include <utility>

namespace limpet::simulation {
namespace {

constexpr std::uint16_t kNoSchema = 0;

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
      sent_(writer_.add_channel(kNoSchema, "/wire/sent", "mavlink")),
      received_(writer_.add_channel(kNoSchema, "/wire/received", "mavlink")),
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

}  // namespace limpet::simulation
