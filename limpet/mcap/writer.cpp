// SPDX-License-Identifier: Apache-2.0
#include "limpet/mcap/writer.hpp"

#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <numeric>
#include <system_error>
#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet::mcap {
namespace {

constexpr std::string_view kProfile = "ros2";
constexpr std::string_view kLibrary = "limpet";
constexpr const char* kNowhere = "/dev/null";
constexpr std::size_t kIndexReserve_bytes = 1 << 20;
/// Space behind a full chunk for the message that fills it, and for a chunk's message indexes.
constexpr std::size_t kSlack_bytes = 64 * 1024;

}  // namespace

void Writer::TimeRange::include(std::uint64_t time_ns) {
    first_ns = std::min(first_ns, time_ns);
    last_ns = std::max(last_ns, time_ns);
}

Writer::Writer(std::filesystem::path path, const WriterOptions& options)
    : path_(std::move(path)),
      part_path_(path_.empty() ? kNowhere : path_.string() + ".part"),
      options_(options),
      file_(nullptr, &std::fclose),
      zstd_(ZSTD_createCCtx(), &ZSTD_freeCCtx) {
    std::error_code ignored;
    if (!path_.empty() &&
        (!path_.has_filename() || std::filesystem::is_directory(path_, ignored))) {
        throw InputError(path_.string() + ": cannot write a recording: is a directory");
    }
    file_.reset(std::fopen(part_path_.c_str(), "wbe"));
    if (!file_) {
        fail("cannot write a recording");
    }
    // What arrives here is whole chunks: a second buffer would only copy them.
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);

    ZSTD_CCtx_setParameter(zstd_.get(), ZSTD_c_compressionLevel, options_.compression_level);
    const std::size_t full_chunk = options_.chunk_bytes + kSlack_bytes;
    records_.reserve(full_chunk);
    compressed_.resize(ZSTD_compressBound(full_chunk));
    staged_.reserve(compressed_.size() +
                    full_chunk);  // a message index is smaller than its message
    entries_.reserve(full_chunk / (kRecordHeader_bytes + kMessageHeader_bytes));
    chunk_indexes_.reserve(kIndexReserve_bytes);

    put(staged_, ByteView(kMagic));
    put_record(staged_, OpCode::header, kProfile, kLibrary);
    emit_staged();
}

Writer::~Writer() {
    if (file_) {
        try {
            close_chunk();
        } catch (...) {  // the disk or the memory is full: what is in the file stays readable
            return;
        }
    }
}

std::uint16_t Writer::add_schema(std::string_view name, std::string_view encoding,
                                 std::string_view text) {
    const std::uint16_t id = ++schema_count_;
    put_record(staged_, OpCode::schema, id, name, encoding, text);
    put(schemas_, staged_);
    emit_staged();
    return id;
}

std::uint16_t Writer::add_channel(std::uint16_t schema_id, std::string_view topic,
                                  std::string_view message_encoding, const StringMap& metadata) {
    require(schema_id <= schema_count_, "a channel's schema is added before the channel");
    const auto id = static_cast<std::uint16_t>(message_counts_.size());
    message_counts_.push_back(0);
    put_record(staged_, OpCode::channel, id, schema_id, topic, message_encoding, metadata);
    put(channels_, staged_);
    emit_staged();
    return id;
}

void Writer::add_metadata(const Metadata& metadata) {
    close_chunk();
    put_record(staged_, OpCode::metadata, metadata);
    put_record(metadata_indexes_, OpCode::metadata_index, offset_, staged_.size(), metadata.name);
    ++metadata_count_;
    emit_staged();
}

void Writer::add_attachment(const Attachment& attachment) {
    close_chunk();
    const AttachmentHead head{.log_time_ns = attachment.log_time_ns,
                              .name = attachment.name,
                              .media_type = attachment.media_type,
                              .size = attachment.text.size()};
    Bytes content;
    put(content, head);
    content.insert(content.end(), attachment.text.begin(), attachment.text.end());
    put_record(staged_, OpCode::attachment, content, crc32(content));
    put_record(attachment_indexes_, OpCode::attachment_index, offset_, staged_.size(),
               head.log_time_ns, head.create_time_ns, head.size, head.name, head.media_type);
    ++attachment_count_;
    emit_staged();
}

void Writer::write(std::uint16_t channel_id, std::uint64_t log_time_ns, ByteView data) {
    require(file_ != nullptr, "nothing is written to a closed recording");
    require(channel_id < message_counts_.size(), "a message's channel is added before the message");
    entries_.push_back({channel_id, log_time_ns, records_.size()});
    put_record(records_, OpCode::message,
               Message{.channel_id = channel_id,
                       .sequence = message_counts_[channel_id]++,
                       .log_time_ns = log_time_ns,
                       .publish_time_ns = log_time_ns,
                       .data = data});
    chunk_range_.include(log_time_ns);
    if (records_.size() >= options_.chunk_bytes) {
        close_chunk();
    }
}

void Writer::close_chunk() {
    if (entries_.empty()) {
        return;
    }
    const ByteView stored = options_.compress ? compress_records() : ByteView(records_);
    const ChunkHeader header{.first_time_ns = chunk_range_.begin_ns(),
                             .last_time_ns = chunk_range_.last_ns,
                             .size = records_.size(),
                             .crc = crc32(records_),
                             .compression = options_.compress ? "zstd" : "",
                             .stored_size = stored.size()};
    put_record(staged_, OpCode::chunk, header, stored);
    index_chunk(header);
    range_.include(header.first_time_ns);
    range_.include(header.last_time_ns);
    ++chunk_count_;
    records_.clear();
    entries_.clear();
    chunk_range_ = {};
    emit_staged();
}

ByteView Writer::compress_records() {
    compressed_.resize(std::max(compressed_.size(), ZSTD_compressBound(records_.size())));
    const std::size_t size = ZSTD_compress2(zstd_.get(), compressed_.data(), compressed_.size(),
                                            records_.data(), records_.size());
    require(!ZSTD_isError(size), "zstd compresses into a buffer of its own bound");
    return ByteView(compressed_).first(size);
}

/// Stages a message index for each channel of the chunk just staged, and notes for the summary
/// where chunk and indexes lie.
void Writer::index_chunk(const ChunkHeader& header) {
    const std::uint64_t chunk_length = staged_.size();
    Bytes& index = chunk_indexes_;
    const auto message_indexes = [&] {
        for (std::uint16_t id = 0; id < message_counts_.size(); ++id) {
            const std::uint64_t at = offset_ + staged_.size();
            if (stage_message_index(id)) {
                put(index, id);
                put(index, at);
            }
        }
    };
    put_record(
        index, OpCode::chunk_index, header.first_time_ns, header.last_time_ns, offset_,
        chunk_length,
        [&] {
            put_sized<std::uint32_t>(index, message_indexes);
            put(index, staged_.size() - chunk_length);
        },
        header.compression, header.stored_size, header.size);
}

/// @return false if the open chunk has no message of the channel
bool Writer::stage_message_index(std::uint16_t channel_id) {
    const auto of_channel = [channel_id](const IndexEntry& e) {
        return e.channel_id == channel_id;
    };
    if (std::none_of(entries_.begin(), entries_.end(), of_channel)) {
        return false;
    }
    put_record(staged_, OpCode::message_index, channel_id, [&] {
        put_sized<std::uint32_t>(staged_, [&] {
            for (const IndexEntry& entry : entries_) {
                if (of_channel(entry)) {
                    put(staged_, entry.log_time_ns);
                    put(staged_, entry.offset);
                }
            }
        });
    });
    return true;
}

void Writer::close() {
    require(file_ != nullptr, "a recording is closed once");
    close_chunk();
    const std::uint32_t crc = data_crc_;
    put_record(staged_, OpCode::data_end, crc);
    emit_staged();
    stage_summary();
    put(staged_, ByteView(kMagic));
    emit_staged();

    if (std::fclose(file_.release()) != 0) {
        fail("cannot write");
    }
    if (!path_.empty() && std::rename(part_path_.c_str(), path_.c_str()) != 0) {
        fail("cannot be renamed to its final name");
    }
}

Bytes Writer::statistics() const {
    Bytes record;
    const auto messages =
        std::accumulate(message_counts_.begin(), message_counts_.end(), std::uint64_t{0});
    put_record(record, OpCode::statistics, messages, schema_count_,
               static_cast<std::uint32_t>(message_counts_.size()), attachment_count_,
               metadata_count_, chunk_count_, range_.begin_ns(), range_.last_ns, [&] {
                   put_sized<std::uint32_t>(record, [&] {
                       for (std::uint16_t id = 0; id < message_counts_.size(); ++id) {
                           put(record, id);
                           put(record, std::uint64_t{message_counts_[id]});
                       }
                   });
               });
    return record;
}

/// Summary, summary offsets and footer; each group of records is found through its offset.
void Writer::stage_summary() {
    const Bytes counts = statistics();
    const std::pair<OpCode, const Bytes*> groups[] = {
        {OpCode::schema, &schemas_},
        {OpCode::channel, &channels_},
        {OpCode::statistics, &counts},
        {OpCode::chunk_index, &chunk_indexes_},
        {OpCode::attachment_index, &attachment_indexes_},
        {OpCode::metadata_index, &metadata_indexes_}};
    Bytes offsets;
    for (const auto& [opcode, records] : groups) {
        if (!records->empty()) {
            put_record(offsets, OpCode::summary_offset, static_cast<std::uint8_t>(opcode),
                       offset_ + staged_.size(), records->size());
            put(staged_, *records);
        }
    }
    const std::uint64_t offsets_start = offset_ + staged_.size();
    put(staged_, offsets);
    // The CRC covers everything up to itself, the footer's length included.
    put_record(staged_, OpCode::footer, offset_, offsets_start, std::uint32_t{0});
    staged_.resize(staged_.size() - sizeof(std::uint32_t));
    put(staged_, crc32(staged_));
}

void Writer::emit_staged() {
    emit(staged_);
    staged_.clear();
}

void Writer::emit(ByteView bytes) {
    require(file_ != nullptr, "nothing is written to a closed recording");
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
        const int reason = errno;
        file_.reset();  // nothing may follow half a record
        errno = reason;
        fail("cannot write");
    }
    offset_ += bytes.size();
    data_crc_ = crc32(bytes, data_crc_);
}

void Writer::fail(const char* what) const {
    throw InputError(part_path_.string() + ": " + what + ": " + std::strerror(errno));
}

}  // namespace limpet::mcap
