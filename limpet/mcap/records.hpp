// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/mcap/format.hpp"

/// The records that carry a file's structure, each with its way in and its way out. Readers take
/// the content of a record, without opcode and length, and throw Malformed.
namespace limpet::mcap {

void put(Bytes& out, const Schema& schema);
void put(Bytes& out, const Channel& channel);
/// With its CRC; the create time is "unknown": the wall clock stays out of recordings.
void put(Bytes& out, const Attachment& attachment);
void put(Bytes& out, const Metadata& metadata);
/// @param offset  of the record that is indexed, from the start of the file
/// @param length  of that record, with opcode and length
void put_index(Bytes& out, const Attachment& attachment, std::uint64_t offset,
               std::uint64_t length);
void put_index(Bytes& out, const Metadata& metadata, std::uint64_t offset, std::uint64_t length);

[[nodiscard]] Schema get_schema(ByteView content);
[[nodiscard]] Channel get_channel(ByteView content);
/// Checks the CRC.
[[nodiscard]] Attachment get_attachment(ByteView content);
[[nodiscard]] Metadata get_metadata(ByteView content);
[[nodiscard]] Message get_message(ByteView content);

/// What stands in a chunk ahead of its records.
struct ChunkHeader {
    std::uint64_t first_time_ns = 0;
    std::uint64_t last_time_ns = 0;
    std::uint64_t size = 0;  ///< of the records, unpacked
    std::uint32_t crc = 0;   ///< of the records, unpacked; 0: none
    std::string_view compression;
    std::uint64_t stored_size = 0;  ///< of the records, as they follow
};
void put(Bytes& out, const ChunkHeader& header);
[[nodiscard]] ChunkHeader get_chunk_header(Cursor& in);

}  // namespace limpet::mcap
