// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "limpet/mavlink/codec.hpp"
#include "limpet/mavlink/signing.hpp"
#include "limpet/mavlink/stamp_file.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::mavlink {

/// Components of a MAVLink system.
inline constexpr std::uint8_t kAutopilotComponent = MavComponent::autopilot1;
inline constexpr std::uint8_t kGroundStationComponent = MavComponent::missionplanner;
inline constexpr std::uint8_t kCompanionComponent = MavComponent::onboard_computer;

/// So many frames are taken from a wire before other work has its turn: a flood of them must not
/// stop a loop. No autopilot sends as many in 10 ms.
inline constexpr int kFramesAtOnce = 1000;
/// For send(): who does not listen is not waited for.
inline constexpr std::chrono::nanoseconds kAtOnce{0};

/// Signs what goes, refuses what comes without a right signature.
struct LinkSigning {
    SigningKey key = {};
    std::uint8_t link_id = 0;
    std::function<std::uint64_t()> unix_us;  ///< the clock [us since 1970 UTC]
    std::shared_ptr<StampFile> stamps = {};  ///< goes on from there, and keeps them there
};

/// What a link has carried since it was made.
struct LinkCount {
    std::uint64_t sent = 0;      ///< messages that went whole
    std::uint64_t not_sent = 0;  ///< nobody was there, or the peer took too long
    std::uint64_t received = 0;  ///< frames handed out
    std::uint64_t lost = 0;      ///< left out by sequence number
    std::uint64_t damaged = 0;   ///< wrong checksum
    std::uint64_t discarded_bytes = 0;
    Refusals refusals;  ///< of who wants to be a peer, too
};

/// Messages to and from one peer: a transport, a parser, a sequence number and, when requested,
/// signatures. For one thread. Sending and receiving allocate nothing.
class Link {
public:
    /// @param self  system and component that its messages carry
    Link(std::unique_ptr<wire::Transport> transport, Sender self);

    void sign(LinkSigning signing);
    /// Over UDP a listening end takes nobody for its peer before a whole message of theirs, rightly
    /// signed where the link is.
    /// @param message  of that kind alone; empty: of any that is known
    void admit_by(std::optional<std::uint32_t> message);

    /// @param timeout  longest wait for space in the wire
    template <class Message>
    wire::TransferStatus send(const Message& message,
                              std::chrono::nanoseconds timeout = std::chrono::milliseconds(100)) {
        return send_frame(encode(message, self_, out_), timeout);
    }

    /// From here on messages are kept, up to uncork(), which sends them in one piece: one system
    /// call, and a peer that wakes up once.
    void cork() { corked_ = true; }
    wire::TransferStatus uncork(std::chrono::nanoseconds timeout = std::chrono::milliseconds(100));

    /// Waits for the next frame. A peer that goes shows in generation().
    /// @param timeout  longest wait; 0: what is there already
    /// @return valid until the next call; nothing also when what came was a flood of rubbish
    [[nodiscard]] std::optional<Frame> receive(std::chrono::nanoseconds timeout = {});

    [[nodiscard]] bool wait_for_peer(std::chrono::nanoseconds timeout) {
        return transport_->wait_for_peer(timeout);
    }
    /// Changes whenever a peer comes or goes: what was agreed upon with it is void.
    [[nodiscard]] std::uint64_t generation() const;

    [[nodiscard]] LinkCount count() const;
    /// Why signing timestamps could not be kept; empty: they could, or need not be.
    [[nodiscard]] std::string trouble_with_stamps() const;
    [[nodiscard]] const Sender& self() const { return self_; }
    [[nodiscard]] const wire::Transport& transport() const { return *transport_; }

private:
    wire::TransferStatus send_frame(ByteView frame, std::chrono::nanoseconds timeout);
    wire::TransferStatus send_bytes(ByteView bytes, std::uint64_t messages,
                                    std::chrono::nanoseconds timeout);

    /// Shared with the admission, which outlives a move of the link.
    struct Seal {
        Seal() = default;
        ~Seal();
        Seal(const Seal&) = delete;
        Seal& operator=(const Seal&) = delete;

        /// @param check  or only judge
        [[nodiscard]] bool accepts(const Frame& frame, bool check);
        void offer_stamps();

        std::optional<Signing> signing;
        std::function<std::uint64_t()> unix_us;
        std::shared_ptr<StampFile> stamps;
        std::uint64_t offered = 0;  ///< signing time
        Refusals refusals;
    };

    std::unique_ptr<wire::Transport> transport_;
    Sender self_;
    Parser parser_;
    std::shared_ptr<Seal> seal_ = std::make_shared<Seal>();
    std::array<std::byte, 4096> in_ = {};
    ByteView unread_;
    std::uint64_t heard_generation_ = 0;  ///< that of the bytes in the parser
    LinkStatistics before_;               ///< of parsers that served earlier peers
    LinkCount count_;
    FrameBuffer out_ = {};
    std::array<std::uint8_t, 1400> kept_ = {};  ///< while corked; fits a datagram
    std::size_t kept_bytes_ = 0;
    std::uint64_t kept_messages_ = 0;
    bool corked_ = false;
};

}  // namespace limpet::mavlink
