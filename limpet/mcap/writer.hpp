// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "limpet/mcap/format.hpp"

struct ZSTD_CCtx_s;

namespace limpet::mcap {

struct WriterOptions {
    std::size_t chunk_bytes =
        std::size_t{256} * 1024;  ///< a chunk is closed at this size, before compression
    bool compress = true;         ///< zstd
    /// 1 is zstd's fastest ordinary level; higher ones cost more than the simulation itself.
    int compression_level = 1;
};

/// Writes one MCAP file: chunked, indexed, every part under a CRC.
///
/// It writes to `PATH.part` and renames to PATH in close(), so that PATH is whole whenever it is
/// there. A run that dies leaves PATH.part, which the reader takes: all closed chunks are in it,
/// and all metadata, attachments, schemas and channels that were added. Schemas and channels stand
/// outside the chunks, so that no lost chunk takes them along.
///
/// An empty PATH is nowhere, for a recording that others take as it comes (record::MessageSink).
///
/// write() allocates nothing as long as messages are smaller than a chunk; the index for the
/// summary grows by some 300 bytes a chunk, out of a reserve for 1 GB of messages.
class Writer {
public:
    /// @throws InputError if the file cannot be written, naming the path and why
    explicit Writer(std::filesystem::path path, const WriterOptions& options = {});
    /// Without close(): writes out the open chunk and leaves PATH.part.
    ~Writer();
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    /// @return the new schema's id, from 1
    std::uint16_t add_schema(std::string_view name, std::string_view encoding,
                             std::string_view text);
    /// @return the new channel's id, from 0
    std::uint16_t add_channel(std::uint16_t schema_id, std::string_view topic,
                              std::string_view message_encoding, const StringMap& metadata = {});
    // These two close the open chunk first, so that the file keeps the order of the calls.
    void add_metadata(const Metadata& metadata);
    void add_attachment(const Attachment& attachment);
    void write(std::uint16_t channel_id, std::uint64_t log_time_ns, ByteView data);
    /// Writes summary and footer and renames. Nothing can be written afterwards.
    /// @throws InputError if the disk does not take it
    void close();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    struct IndexEntry {
        std::uint16_t channel_id;
        std::uint64_t log_time_ns;
        std::uint64_t offset;  ///< of the message record in the chunk's uncompressed records
    };
    struct TimeRange {
        std::uint64_t first_ns = ~std::uint64_t{0};
        std::uint64_t last_ns = 0;
        void include(std::uint64_t time_ns);
        [[nodiscard]] std::uint64_t begin_ns() const { return first_ns <= last_ns ? first_ns : 0; }
    };

    void emit(ByteView bytes);
    void emit_staged();
    void close_chunk();
    void index_chunk(const ChunkHeader& header);
    bool stage_message_index(std::uint16_t channel_id);
    [[nodiscard]] ByteView compress_records();
    [[nodiscard]] Bytes statistics() const;
    void stage_summary();
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path path_;
    std::filesystem::path part_path_;
    WriterOptions options_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
    std::unique_ptr<ZSTD_CCtx_s, std::size_t (*)(ZSTD_CCtx_s*)> zstd_;
    std::uint64_t offset_ = 0;    ///< bytes in the file
    std::uint32_t data_crc_ = 0;  ///< of all bytes in the file

    Bytes staged_;   ///< on its way to the file
    Bytes records_;  ///< the open chunk
    Bytes compressed_;
    std::vector<IndexEntry> entries_;  ///< of the open chunk
    TimeRange chunk_range_;

    // For the summary; records are kept as they will be written.
    TimeRange range_;
    std::vector<std::uint32_t> message_counts_;  ///< by channel
    Bytes schemas_, channels_, chunk_indexes_, attachment_indexes_, metadata_indexes_;
    std::uint16_t schema_count_ = 0;
    std::uint32_t attachment_count_ = 0, metadata_count_ = 0, chunk_count_ = 0;
};

}  // namespace limpet::mcap
