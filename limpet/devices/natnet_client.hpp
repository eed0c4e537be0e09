// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limpet/core/signals/readings.hpp"
#include "limpet/devices/natnet.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::devices {

struct NatNetOptions {
    std::int32_t body_id = 1;
    MocapAxes axes = {};
    NatNetVersion version = {};  ///< until the server has reported its own
};

/// What has come from Motive.
struct NatNetCount {
    static constexpr std::size_t kRefusals = static_cast<std::size_t>(NatNetRefusal::late) + 1;
    std::uint64_t packets = 0;  ///< all, of servers too
    /// Frames by why they brought no pose; those of `none` were taken.
    std::array<std::uint64_t, kRefusals> frames = {};
    NatNetSeen latest = {};  ///< of the last frame
};

/// Poses of one rigid body from Motive. Multicast: the data wire joins the group; the command wire
/// requests the version and the clock, and is not needed. Unicast: the command wire says connect,
/// and frames come back on it. Time is injected. For one thread; receiving allocates nothing.
class NatNetClient {
public:
    /// @param data     listens to the group; null with unicast
    /// @param command  speaks to the server's command port; may be null with multicast
    NatNetClient(const NatNetOptions& options, std::unique_ptr<wire::Transport> data,
                 std::unique_ptr<wire::Transport> command);

    /// Says connect or keep-alive when it is time.
    void update(double time_s);
    /// The newest pose of all datagrams that are there.
    /// @param time_s  now; a pose is stamped with it less the time that Motive took, as far as the
    ///                server's clock is known
    [[nodiscard]] std::optional<Sample<PoseReading>> receive(double time_s);

    /// Nothing until it has answered.
    [[nodiscard]] const std::optional<NatNetServer>& server() const { return server_; }
    [[nodiscard]] const NatNetCount& count() const { return count_; }
    /// Why the last packet brought no pose, for people: "body 3 is not streamed, bodies 1, 7 are";
    /// empty: it did.
    [[nodiscard]] std::string obstacle() const;

private:
    void hear(std::span<const std::byte> packet, double time_s);
    [[nodiscard]] NatNetVersion version() const;
    [[nodiscard]] bool is_late(const NatNetFrame& frame);
    [[nodiscard]] std::string silence() const;
    [[nodiscard]] std::string reason(NatNetRefusal refusal) const;
    [[nodiscard]] double delay_s(const NatNetFrame& frame) const;

    NatNetOptions options_;
    std::unique_ptr<wire::Transport> data_;
    std::unique_ptr<wire::Transport> command_;
    std::optional<NatNetServer> server_;
    std::optional<std::int32_t> last_number_;
    std::optional<Sample<PoseReading>> newest_;
    double said_s_ = -1e9;
    NatNetCount count_;
    std::vector<std::byte> in_;
};

}  // namespace limpet::devices
