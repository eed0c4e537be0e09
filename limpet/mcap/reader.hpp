// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "limpet/mcap/format.hpp"

namespace limpet::mcap {

/// Everything in a file except its messages.
struct Contents {
    std::string profile;
    std::string library;
    std::map<std::uint16_t, Schema> schemas;
    std::map<std::uint16_t, Channel> channels;
    std::vector<Attachment> attachments;
    std::vector<Metadata> metadata;
    std::uint64_t message_count = 0;
    std::uint64_t last_time_ns = 0;  ///< latest log time of a message, 0 without messages

    bool truncated = false;             ///< cut off, or never closed
    std::uint64_t unread_bytes = 0;     ///< at the end, that no whole record is made of
    std::uint64_t skipped_records = 0;  ///< wrong CRC, or not what the specification says
    std::string damage;                 ///< one sentence on all of that; empty for a whole file
};

/// Sees every whole message in the order of the file; `contents` has all that stood before it, the
/// message's data is valid until the visitor returns. May throw Malformed: the message then counts
/// as a damaged record.
using MessageVisitor = std::function<void(const Contents& contents, const Message& message)>;

/// What may come of a file of that size once it is unpacked: more than any flight's, far less than
/// a file that was made to fill the memory.
[[nodiscard]] std::uint64_t unpacked_allowance_bytes(std::uint64_t file_bytes);

/// Reads an MCAP file from its start to its end, never by its index: so a file that was cut off
/// anywhere gives everything that is whole in it, and a damaged chunk costs that chunk alone. Of a
/// chunk that is cut off, the messages that are whole are given if it is not compressed.
/// Knows chunks of the compressions "", "zstd" and "lz4", and files that are packed as a whole by
/// zstd or in frames of LZ4.
/// @param path   read as a whole into memory
/// @param visit  may be empty
/// @throws InputError  if path is no file, cannot be read, is empty, is no MCAP file, is larger
///                     than 1 GB, unpacks to more than it is allowed, keeps more in memory than
///                     that or has over 100,000 damaged records
[[nodiscard]] Contents read(const std::filesystem::path& path, const MessageVisitor& visit);

}  // namespace limpet::mcap
