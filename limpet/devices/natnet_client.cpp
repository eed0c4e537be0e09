// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet_client.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limpet/core/errors.hpp"

namespace limpet::devices {
namespace {

/// Beyond it the server's clocks are not what they seem. Motive takes 3 to 20 ms.
/// Source: assumed: five times the longest latency that Motive's own display shows for our rates
constexpr double kLongestDelay_s = 0.1;
/// How often Connect is repeated; while unicast frames come it keeps them coming.
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
    // No answer is no fault: the request is repeated, and the frames show it.
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

NatNetVersion NatNetClient::version() const {
    return server_ ? server_->version : options_.version;
}

bool NatNetClient::is_late(const NatNetFrame& frame) {
    const std::int64_t ahead =
        last_number_ ? std::int64_t{frame.number} - std::int64_t{*last_number_} : 1;
    if (ahead <= 0 && ahead > -kRestart_frames) {
        return true;
    }
    last_number_ = frame.number;
    return false;
}

void NatNetClient::hear(std::span<const std::byte> packet, double time_s) {
    ++count_.packets;
    if (const std::optional<NatNetServer> server = decode_server(packet)) {
        server_ = server;
        return;
    }
    NatNetSeen& seen = count_.latest;
    const std::optional<NatNetFrame> frame =
        decode_frame(packet, version(), options_.body_id, &seen);
    if (frame && is_late(*frame)) {
        seen.refusal = NatNetRefusal::late;
    }
    ++count_.frames.at(static_cast<std::size_t>(seen.refusal));
    if (seen.refusal == NatNetRefusal::none) {
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

// --- for people ---------------------------------------------------------------------------------

/// Nothing but the server's answer, or not even that.
std::string NatNetClient::silence() const {
    const wire::Transport& wire = data_ != nullptr ? *data_ : *command_;
    if (!server_) {
        return fmt::format("nothing comes over {}", wire.describe());
    }
    if (!understood(server_->version)) {
        return reason(NatNetRefusal::version);
    }
    const auto& g = server_->group;
    const std::string to = server_->multicast ? fmt::format("multicast to {}.{}.{}.{}:{}", g[0],
                                                            g[1], g[2], g[3], server_->data_port)
                                              : "unicast";
    return fmt::format("no frame comes over {}; Motive says that it streams {}", wire.describe(),
                       to);
}

std::string NatNetClient::reason(NatNetRefusal refusal) const {
    const NatNetVersion now = version();
    switch (refusal) {
        case NatNetRefusal::none: return "";
        case NatNetRefusal::not_natnet: return "what comes is no frame of NatNet";
        case NatNetRefusal::version:
            return fmt::format("Motive speaks NatNet {}.{}, understood are 3.0 to 4.x", now.major,
                               now.minor);
        case NatNetRefusal::unreadable:
            return fmt::format("frames cannot be read as NatNet {}.{}{}", now.major, now.minor,
                               server_ ? "" : ", which is assumed: the server has not answered");
        case NatNetRefusal::absent: {
            const NatNetSeen& seen = count_.latest;
            std::string ids;
            for (std::size_t i = 0; i < std::min(seen.bodies, seen.ids.size()); ++i) {
                ids += fmt::format("{}{}", ids.empty() ? "" : ", ", seen.ids[i]);
            }
            return fmt::format("body {} is not streamed, {}", options_.body_id,
                               ids.empty()
                                   ? "nor any other"
                                   : fmt::format("streamed: {}{}", ids,
                                                 seen.bodies > seen.ids.size() ? ", ..." : ""));
        }
        case NatNetRefusal::untracked:
            return fmt::format("body {} is streamed but not tracked", options_.body_id);
        case NatNetRefusal::not_finite:
            return fmt::format("position or attitude of body {} is not finite", options_.body_id);
        case NatNetRefusal::no_attitude:
            return fmt::format("the quaternion of body {} is not of length 1", options_.body_id);
        case NatNetRefusal::late: return "frames are older than one before";
    }
    throw InternalError("NatNet refusal out of range");
}

std::string NatNetClient::obstacle() const {
    const bool any = std::any_of(count_.frames.begin(), count_.frames.end(),
                                 [](std::uint64_t count) { return count > 0; });
    return any ? reason(count_.latest.refusal) : silence();
}

}  // namespace limpet::devices
