// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet_source.hpp"

#include <chrono>

#include "limpet/core/errors.hpp"

namespace limpet::devices {

NatNetSource::NatNetSource(NatNetServer server, std::unique_ptr<wire::Transport> group,
                           std::unique_ptr<wire::Transport> command)
    : server_(server), group_(std::move(group)), command_(std::move(command)) {
    require(group_ != nullptr || command_ != nullptr, "motion capture has a wire");
    server_.multicast = group_ != nullptr;
}

void NatNetSource::answer() {
    if (command_ == nullptr) {
        return;
    }
    constexpr int kBurst = 100;
    std::array<std::byte, 2048> in;
    drain(*command_, in, kBurst, [this](auto packet) {
        if (natnet_message(packet) == NatNetMessage::connect) {
            connected_ = true;
            NatNetBuffer answer;
            (void)command_->send(encode_server(server_, answer), std::chrono::nanoseconds(0));
        }
    });
}

void NatNetSource::stream(const NatNetFrame& frame) {
    if (group_ == nullptr && !connected_) {
        return;
    }
    NatNetBuffer packet;
    wire::Transport& wire = group_ != nullptr ? *group_ : *command_;
    (void)wire.send(encode_frame(frame, server_.version, packet), std::chrono::nanoseconds(0));
}

std::string NatNetSource::describe() const {
    return (group_ != nullptr ? *group_ : *command_).describe();
}

}  // namespace limpet::devices
