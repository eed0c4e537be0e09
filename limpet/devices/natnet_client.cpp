// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet_client.hpp"

#include <algorithm>

#include "limpet/core/errors.hpp"

namespace limpet::devices {
namespace {

/// Beyond it the server's clocks are not what they seem. Motive takes 3 to 20 ms.
/// Source: assumed: five times the longest latency that Motive's own display shows for our rates
constexpr double kLongestDelay_s = 0.1;
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
    if (command_ == nullptr || time_s - said_s_ < options_.connect_every_s) {
        return;
    }
    said_s_ = time_s;
    NatNetBuffer packet;
    const bool known = server_.has_value();
    // Nobody there is no fault: it is asked again, and the frames tell.
    (void)command_->send(
        known ? encode_keep_alive(packet) : encode_connect(options_.version, packet),
        std::chrono::milliseconds(10));
}

std::optional<Sample<PoseReading>> NatNetClient::receive(double time_s) {
    newest_.reset();
    if (command_ != nullptr) {
        hear_all(*command_, time_s);
    }
    if (data_ != nullptr) {
        hear_all(*data_, time_s);
    }
    return newest_;
}

void NatNetClient::hear_all(wire::Transport& wire, double time_s) {
    constexpr int kBurst = 1000;  // more than a socket holds: a flood does not stop the loop
    for (int i = 0; i < kBurst; ++i) {
        const wire::Transfer transfer = wire.receive(in_, {});
        if (transfer.status != wire::TransferStatus::done) {
            return;
        }
        hear(std::span(in_).first(transfer.bytes), time_s);
    }
}

void NatNetClient::hear(std::span<const std::byte> packet, double time_s) {
    const std::optional<NatNetMessage> kind = natnet_message(packet);
    if (kind == NatNetMessage::server_info) {
        const std::optional<NatNetServer> server = decode_server(packet);
        if (server && understood(server->version)) {
            server_ = server;
        } else {
            ++count_.damaged;
        }
        return;
    }
    const NatNetVersion version = server_ ? server_->version : options_.version;
    const std::optional<NatNetFrame> frame = decode_frame(packet, version, options_.body_id);
    if (!frame) {
        ++count_.damaged;
        return;
    }
    ++count_.frames;
    const std::int64_t ahead =
        last_number_ ? std::int64_t{frame->number} - std::int64_t{*last_number_} : 1;
    if (ahead <= 0 && ahead > -kRestart_frames) {
        ++count_.out_of_order;
        return;
    }
    count_.lost += static_cast<std::uint64_t>(std::clamp<std::int64_t>(ahead - 1, 0, 1000000));
    last_number_ = frame->number;
    if (!frame->body) {
        ++count_.without_body;
    } else if (!frame->body->tracking_valid) {
        ++count_.not_tracked;
    } else {
        mean_error_m_ = frame->body->mean_error_m;
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
