// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "limpet/core/signals/readings.hpp"
#include "limpet/devices/natnet.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::devices {

struct NatNetOptions {
    std::int32_t body_id = 1;
    MocapAxes axes = {};
    NatNetVersion version = {};    ///< until the server has told its own
    double connect_every_s = 1.0;  ///< said again; while unicast frames come it keeps them coming
};

struct NatNetCount {
    std::uint64_t frames = 0;        ///< well-formed
    std::uint64_t damaged = 0;       ///< datagrams that are none of NatNet's, or cut
    std::uint64_t without_body = 0;  ///< frames in which our body is not streamed
    std::uint64_t not_tracked = 0;   ///< frames in which it was not seen
    std::uint64_t out_of_order = 0;  ///< older than a frame before
    std::uint64_t lost = 0;          ///< left out by frame number
};

/// Poses of one rigid body from Motive. Multicast: the data wire joins the group; the command wire
/// asks for the version and the clock, and is not needed. Unicast: the command wire says connect,
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

    [[nodiscard]] const NatNetCount& count() const { return count_; }
    /// Nothing until it has answered.
    [[nodiscard]] const std::optional<NatNetServer>& server() const { return server_; }
    [[nodiscard]] double mean_error_m() const { return mean_error_m_; }

private:
    void hear(std::span<const std::byte> packet, double time_s);
    void hear_all(wire::Transport& wire, double time_s);
    [[nodiscard]] double delay_s(const NatNetFrame& frame) const;

    NatNetOptions options_;
    std::unique_ptr<wire::Transport> data_;
    std::unique_ptr<wire::Transport> command_;
    NatNetCount count_;
    std::optional<NatNetServer> server_;
    std::optional<std::int32_t> last_number_;
    std::optional<Sample<PoseReading>> newest_;
    double mean_error_m_ = 0.0;
    double said_s_ = -1e9;
    std::vector<std::byte> in_;
};

}  // namespace limpet::devices
