// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "limpet/mcap/format.hpp"

namespace limpet::record {

/// A channel as a recording has it; views of the call.
struct SinkChannel {
    std::uint16_t id = 0;  ///< from 0, in their order
    std::string_view topic, type, encoding;
    std::string_view schema_encoding, schema;
};

/// Takes what a recording takes, as it comes (limpet/live). Nothing here may wait.
class MessageSink {
public:
    virtual ~MessageSink() = default;
    virtual void channel(const SinkChannel& channel) = 0;
    /// What the recording has attached, a description's meshes among it.
    virtual void attachment(const mcap::Attachment& /*attachment*/) {}
    /// @param data  valid during the call
    virtual void message(std::uint16_t channel, std::uint64_t time_ns, mcap::ByteView data) = 0;

protected:
    MessageSink() = default;
    MessageSink(const MessageSink&) = default;
    MessageSink& operator=(const MessageSink&) = default;
};

}  // namespace limpet::record
