// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "limpet/mcap/format.hpp"

/// What recordings are packed by: zstd (RFC 8878) and frames of LZ4, both by their libraries.
namespace limpet::mcap {

/// Unpacks chunks, one after the other, with one context.
class Unpacker {
public:
    Unpacker();
    ~Unpacker();
    Unpacker(const Unpacker&) = delete;
    Unpacker& operator=(const Unpacker&) = delete;

    [[nodiscard]] static bool knows(std::string_view compression);

    /// @param compression  one that is known: "zstd" or "lz4"
    /// @param out  as large as what comes out; filled
    /// @throws Malformed when it is not that, to the byte
    void unpack(std::string_view compression, ByteView stored, Bytes& out);

private:
    struct Contexts;
    std::unique_ptr<Contexts> contexts_;
};

/// Whether a file is packed as a whole, as rosbag2 writes .mcap.zstd and lz4 .mcap.lz4.
[[nodiscard]] bool is_packed(std::string_view file);

/// @param file  that is_packed()
/// @return what is in it, as far as it is whole; at most one byte more than `most_bytes`
[[nodiscard]] std::string unpacked_file(std::string_view file, std::uint64_t most_bytes);

}  // namespace limpet::mcap
