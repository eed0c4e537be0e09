// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "limpet/mavlink/codec.hpp"
#include "limpet/mcap/writer.hpp"
#include "limpet/wire/transport.hpp"

namespace limpet::simulation {

/// What went over a wire, byte by byte, as MCAP: topics /wire/sent and /wire/received, a message
/// for each piece as it was sent or came, in their order. Its times are wall time since it began.
class WireLog {
public:
    /// @throws InputError when the file cannot be written
    explicit WireLog(const std::filesystem::path& path);

    void sent(std::span<const std::byte> bytes) { write(sent_, bytes); }
    void received(std::span<const std::byte> bytes) { write(received_, bytes); }
    /// @throws InputError when the disk does not take it
    void finish() { writer_.close(); }
    [[nodiscard]] const std::filesystem::path& path() const { return writer_.path(); }

private:
    void write(std::uint16_t channel, std::span<const std::byte> bytes);

    mcap::Writer writer_;
    std::uint16_t sent_;
    std::uint16_t received_;
    std::chrono::steady_clock::time_point begin_;
};

/// What a wire log holds.
struct WireTally {
    struct Way {
        std::map<std::string_view, std::uint64_t> messages;  ///< by MAVLink's name
        mavlink::LinkStatistics statistics;
    };
    Way sent, received;
    double lasted_s = 0.0;
    std::string damage;  ///< of the file; empty for a whole one
};

/// @return nothing for an MCAP file of another kind
/// @throws InputError  as mcap::read() does
[[nodiscard]] std::optional<WireTally> read_wire_log(const std::filesystem::path& path);

/// The same wire, listened to.
/// @param log  outlives the wire
[[nodiscard]] std::unique_ptr<wire::Transport> tapped(std::unique_ptr<wire::Transport> wire,
                                                      WireLog& log);

}  // namespace limpet::simulation
