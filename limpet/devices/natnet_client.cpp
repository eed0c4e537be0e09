// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet_client.hpp"

#include "limpet/core/errors.hpp"

namespace limpet::devices {
namespace {

/// Beyond it the server's clocks are not what they seem. Motive takes 3 to 20 ms.
/// Source: assumed: five times the longest latency that Motive's own display shows for our rates
constexpr double kLongestDelay_s = 0.1;
/// Connect is said again so often; while unicast frames come it keeps them coming.
constexpr double kConnectEvery_s = 1.0;
/// Motive counts from 0 again when it streams anew: so far back is no late datagram.
constexpr std::int64_t kRestart_frames = 1000;

}  // namespace

NatNetClient::NatNetClient(const NatNetOptions& options, std::unique_ptr<wire::Transport> data,
                           std::unique_ptr<wire::Transport> command)
    : options_(options),
      data_(std::move(data)),
      command_(std::move(command)),
      in_(kNatNetLongest_bytes) {
    require(data_ != nullptr || command_ != nullptr, "motion capture has a wire");
}

void NatNetClient::update(double time_s) {
    if (command_ == nullptr || time_s - said_s_ < kConnectEvery_s) {
        return;
    }
    said_s_ = time_s;
    NatNetBuffer packet;
    // Nobody there is no fault: it is asked again, and the frames tell.
    (void)command_->send(
        server_ ? encode_keep_alive(packet) : encode_connect(options_.version, packet),
        std::chrono::milliseconds(10));
}

std::optional<Sample<PoseReading>> NatNetClient::receive(double time_s) {
    constexpr int kBurst = 1000;  // more than a socket holds
    newest_.reset();
    for (wire::Transport* wire : {command_.get(), data_.get()}) {
        if (wire != nullptr) {
            drain(*wire, in_, kBurst, [&](auto packet) { hear(packet, time_s); });
        }
    }
    return newest_;
}

void NatNetClient::hear(std::span<const std::byte> packet, double time_s) {
    if (const std::optional<NatNetServer> server = decode_server(packet)) {
        if (understood(server->version)) {
            server_ = server;
        }
        return;
    }
    const NatNetVersion version = server_ ? server_->version : options_.version;
    const std::optional<NatNetFrame> frame = decode_frame(packet, version, options_.body_id);
    if (!frame) {
        return;
    }
    const std::int64_t ahead =
        last_number_ ? std::int64_t{frame->number} - std::int64_t{*last_number_} : 1;
    if (ahead <= 0 && ahead > -kRestart_frames) {  // older than one before
        return;
    }
    last_number_ = frame->number;
    if (frame->body && frame->body->tracking_valid) {
        newest_ = Sample<PoseReading>{.time_s = time_s - delay_s(*frame),
                                      .value = pose_in_world(options_.axes, frame->body->pose)};
    }
}

double NatNetClient::delay_s(const NatNetFrame& frame) const {
    if (!server_ || server_->clock_Hz == 0 || frame.transmit_ticks < frame.mid_exposure_ticks) {
        return 0.0;
    }
    const double delay_s = static_cast<double>(frame.transmit_ticks - frame.mid_exposure_ticks) /
                           static_cast<double>(server_->clock_Hz);
    return delay_s <= kLongestDelay_s ? delay_s : 0.0;
}

}  // namespace limpet::devices
