// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "limpet/devices/mocap_axes.hpp"

/// NatNet, the protocol of OptiTrack's Motive: packets to and from bytes. Little-endian; a header
/// of message id and payload length (two bytes each), then the payload.
/// Source: the direct depacketization samples of the NatNet SDK 3.0 to 4.1, as public clients write
/// them (mje-nz/python_natnet, TimSchneider42/python-natnet-client, libmotioncapture), and packets
/// of Motive 2.1 kept by the first.
namespace limpet::devices {

/// Version of the bit stream, as the server says; 3.0 to 4.x are understood.
struct NatNetVersion {
    std::uint8_t major = 3;
    std::uint8_t minor = 1;
    friend bool operator==(const NatNetVersion&, const NatNetVersion&) = default;
};
[[nodiscard]] bool understood(NatNetVersion version);

inline constexpr std::uint16_t kNatNetDataPort = 1511;
inline constexpr std::string_view kNatNetGroup = "239.255.42.99";
/// Longest datagram that Motive sends: UDP's own limit.
inline constexpr std::size_t kNatNetLongest_bytes = 65507;

enum class NatNetMessage : std::uint16_t {
    connect = 0,
    server_info = 1,
    frame_of_data = 7,
    keep_alive = 10,
};

/// @return what the packet says it is; nothing if it is shorter than its header says, or other
[[nodiscard]] std::optional<NatNetMessage> natnet_message(std::span<const std::byte> packet);

/// A rigid body in one frame.
struct NatNetBody {
    std::int32_t id = 1;  ///< the streaming id in Motive
    MocapPose pose = {};
    bool tracking_valid = false;  ///< false: not seen in this frame, the pose is an old one
};

/// Why a packet brings no pose of the body that was requested.
enum class NatNetRefusal {
    none,
    not_natnet,   ///< shorter than its header says, or of another kind
    version,      ///< the server's is not understood
    unreadable,   ///< cut, miscounted, or laid out by another version
    absent,       ///< the body is not streamed
    untracked,    ///< it is not seen in this frame
    not_finite,   ///< position or attitude
    no_attitude,  ///< its quaternion is not of length 1
    late,         ///< older than a frame before
};

/// What a packet held besides the requested pose.
struct NatNetSeen {
    NatNetRefusal refusal = NatNetRefusal::none;
    std::array<std::int32_t, 6> ids = {};  ///< the first bodies that are streamed
    std::size_t bodies = 0;                ///< how many are
};

/// What Limpet wants to know of a frame of motion-capture data.
struct NatNetFrame {
    std::int32_t number = 0;
    double motive_time_s = 0.0;            ///< since Motive's start of streaming
    std::uint64_t mid_exposure_ticks = 0;  ///< of the server's clock, see NatNetServer
    std::uint64_t transmit_ticks = 0;
    std::optional<NatNetBody> body = {};  ///< the one requested; nothing: it is not streamed
};

/// Never reads past the end, whatever the bytes are.
/// @param body_id  streaming id of the rigid body requested
/// @param seen     gets what the frame streams and why there is no pose; null: not wanted
/// @return nothing when it is no frame, is cut, miscounts, has bytes left over (before 4.1, where
///         nothing else shows another layout), or holds a pose that is none
[[nodiscard]] std::optional<NatNetFrame> decode_frame(std::span<const std::byte> packet,
                                                      NatNetVersion version, std::int32_t body_id,
                                                      NatNetSeen* seen = nullptr);

/// What a server says of itself.
struct NatNetServer {
    NatNetVersion version = {};
    std::uint64_t clock_Hz = 0;  ///< of its ticks; 0: not reported
    std::uint16_t data_port = kNatNetDataPort;
    bool multicast = true;
    std::array<std::uint8_t, 4> group = {};  ///< IPv4; zeros: not reported
};
[[nodiscard]] std::optional<NatNetServer> decode_server(std::span<const std::byte> packet);

/// Space for every packet that Limpet makes.
using NatNetBuffer = std::array<std::byte, 512>;

// Each returns the part of `into` that is the packet.

/// Asks who is there, and in unicast to be sent frames.
[[nodiscard]] std::span<const std::byte> encode_connect(NatNetVersion version, NatNetBuffer& into);
/// Unicast: Motive stops streaming to who says nothing.
[[nodiscard]] std::span<const std::byte> encode_keep_alive(NatNetBuffer& into);
[[nodiscard]] std::span<const std::byte> encode_server(const NatNetServer& server,
                                                       NatNetBuffer& into);
/// A frame with no or one rigid body and nothing else.
[[nodiscard]] std::span<const std::byte> encode_frame(const NatNetFrame& frame,
                                                      NatNetVersion version, NatNetBuffer& into);

}  // namespace limpet::devices
