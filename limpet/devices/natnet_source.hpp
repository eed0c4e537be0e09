// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "limpet/devices/natnet.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::devices {

/// Motive's end of NatNet, for simulators: answers requests and streams frames. With a
/// group to stream to it is a multicast server, without one it streams to the client that
/// connected. For one thread; allocates nothing once running.
class NatNetSource {
public:
    /// @param group    speaks to the multicast group; null: unicast
    /// @param command  listens on the command port; may be null with a group
    NatNetSource(NatNetServer server, std::unique_ptr<wire::Transport> group,
                 std::unique_ptr<wire::Transport> command);

    /// Answers the requests that came since.
    void answer();
    /// Waits for no one: a frame that nobody can take is gone.
    void stream(const NatNetFrame& frame);

    [[nodiscard]] std::string describe() const;

private:
    NatNetServer server_;
    std::unique_ptr<wire::Transport> group_;
    std::unique_ptr<wire::Transport> command_;
    bool connected_ = false;  ///< unicast: a client has connected
};

}  // namespace limpet::devices
