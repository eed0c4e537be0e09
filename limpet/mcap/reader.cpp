// SPDX-License-Identifier: Apache-2.0
#include "limpet/mcap/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "limpet/core/allowance.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/read_file.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/mcap/unpack.hpp"

namespace limpet::mcap {
namespace {

/// A chunk that claims more is not unpacked: a few bytes of zstd can claim terabytes.
constexpr std::uint64_t kMaxChunk_bytes = 256u << 20;
/// What is beyond is no damaged file but one that was made to keep a reader busy.
constexpr std::uint64_t kMostDamaged = 100'000;
constexpr FileBound kRecording = {"recording", 1000};

/// A file as it is read, and as it lies on the disk.
struct Content {
    std::string bytes;
    std::uint64_t stored_bytes = 0;
};

/// @throws InputError
void unpack_file(const std::string& name, Content& content) {
    constexpr std::uint64_t kMost_bytes = kRecording.most_MB * 1'000'000;
    const std::uint64_t most =
        std::min(unpacked_allowance_bytes(content.stored_bytes), kMost_bytes);
    content.bytes = unpacked_file(content.bytes, most);
    if (content.bytes.size() > most) {
        throw InputError(
            fmt::format("{}: unpacks to more than {} MB, which no recording of {} "
                        "bytes does",
                        name, most / 1'000'000, content.stored_bytes));
    }
}

Content content_of(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::error_code problem;
    const auto status = std::filesystem::status(path, problem);
    if (status.type() == std::filesystem::file_type::not_found) {
        throw InputError(name + ": no such recording");
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw InputError(name + ": not a recording: not a regular file");
    }
    Content content{read_file(path, kRecording)};
    content.stored_bytes = content.bytes.size();
    if (content.bytes.empty()) {
        throw InputError(name + ": not a recording: empty file");
    }
    const bool packed = is_packed(content.bytes);
    if (packed) {
        unpack_file(name, content);
    }
    const std::string& bytes = content.bytes;
    const std::size_t compared = std::min(bytes.size(), kMagic.size());
    if ((packed && bytes.empty()) ||
        !std::equal(kMagic.begin(), kMagic.begin() + static_cast<std::ptrdiff_t>(compared),
                    bytes.begin(),
                    [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); })) {
        throw InputError(name + (packed ? ": not a recording: what is packed in it does not begin "
                                          "as an MCAP file does"
                                        : ": not a recording: does not begin as an MCAP file "
                                          "does"));
    }
    return content;
}

/// One pass over a file.
class Scan {
public:
    Scan(ByteView file, std::uint64_t stored_bytes, std::string name, const MessageVisitor& visit)
        : file_(file),
          stored_bytes_(stored_bytes),
          name_(std::move(name)),
          visit_(visit),
          unpacked_left_(unpacked_allowance_bytes(stored_bytes)),
          kept_(unpacked_allowance_bytes(stored_bytes)) {}

    Contents run() {
        Cursor in(file_.subspan(std::min(file_.size(), kMagic.size())));
        while (!footer_seen_ && next_record(in)) {
        }
        contents_.truncated = !footer_seen_ || !std::equal(in.rest().begin(), in.rest().end(),
                                                           kMagic.begin(), kMagic.end());
        contents_.unread_bytes = footer_seen_ ? 0 : in.left();
        contents_.damage = describe();
        return std::move(contents_);
    }

private:
    /// @return false when no whole record is left
    bool next_record(Cursor& in) {
        const Cursor start = in;
        if (in.left() < kRecordHeader_bytes) {
            return false;
        }
        const auto opcode = static_cast<OpCode>(in.get<std::uint8_t>());
        const auto length = in.get<std::uint64_t>();
        const bool blank = opcode == OpCode{0};  // no record: a tail that never reached the disk
        if (blank || length > in.left()) {
            if (opcode == OpCode::chunk) {
                cut_chunk(in.rest());
            }
            in = start;
            return false;
        }
        const std::size_t offset = file_.size() - start.left();
        const ByteView content = in.take(length);
        read_guarded([&] { record(opcode, content, offset); });
        return true;
    }

    template <class Read>
    void read_guarded(Read&& read) {
        try {
            read();
        } catch (const TooMuch& problem) {
            throw InputError(fmt::format("{}: {}", name_, problem.what()));
        } catch (const Malformed& problem) {
            ++contents_.skipped_records;
            if (first_problem_.empty()) {
                first_problem_ = problem.what();
            }
            if (contents_.skipped_records > kMostDamaged) {
                throw InputError(fmt::format("{}: more than {} damaged records, first a {}", name_,
                                             kMostDamaged, first_problem_));
            }
        }
    }

    void record(OpCode opcode, ByteView content, std::size_t offset) {
        Cursor in(content);
        take_kept(opcode, content);
        switch (opcode) {
            case OpCode::header:
                contents_.profile = in.get<std::string>();
                contents_.library = in.get<std::string>();
                break;
            case OpCode::schema: add(contents_.schemas, in.get<Schema>()); break;
            case OpCode::channel: add(contents_.channels, in.get<Channel>()); break;
            case OpCode::message: give(in.get<Message>()); break;
            case OpCode::chunk: chunk(in); break;
            case OpCode::attachment: attachment(content); break;
            case OpCode::metadata: contents_.metadata.push_back(in.get<Metadata>()); break;
            case OpCode::data_end: check_data(in, offset); break;
            case OpCode::footer:
                footer_seen_ = true;
                check_summary(in);
                if (data_end_ == 0) {
                    throw Malformed("data section without its end");
                }
                break;
            case OpCode::message_index:
            case OpCode::chunk_index:
            case OpCode::attachment_index:
            case OpCode::statistics:
            case OpCode::metadata_index:
            case OpCode::summary_offset: break;  // found by going through, not by looking up
        }
    }

    /// Texts are copied; an entry of a map takes more than its text.
    void take_kept(OpCode opcode, ByteView content) {
        constexpr std::uint64_t kRecord_bytes = 256;
        constexpr std::uint64_t kLeastEntry_bytes = 8;  ///< two lengths
        constexpr std::uint64_t kEntry_bytes = 112;
        if (opcode == OpCode::schema || opcode == OpCode::attachment) {
            kept_.take_bytes(kRecord_bytes + content.size());
        } else if (opcode == OpCode::channel || opcode == OpCode::metadata) {
            kept_.take_bytes(kRecord_bytes + content.size() / kLeastEntry_bytes * kEntry_bytes);
        }
    }

    template <class Record>
    static void add(std::map<std::uint16_t, Record>& records, Record&& record) {
        const std::uint16_t id = record.id;
        records.emplace(id, std::move(record));
    }

    void attachment(ByteView content) {
        Cursor in(content);
        const auto head = in.get<AttachmentHead>();
        const std::string_view text = Cursor::text(in.take(head.size));
        const ByteView covered = content.first(content.size() - in.left());
        const auto crc = in.get<std::uint32_t>();
        if (crc != 0 && crc != crc32(covered)) {
            throw Malformed("attachment with a wrong checksum");
        }
        contents_.attachments.push_back({std::string(head.name), std::string(head.media_type),
                                         std::string(text), head.log_time_ns});
    }

    void give(const Message& message) {
        if (contents_.channels.count(message.channel_id) == 0) {
            throw Malformed("message on a channel that is not there");
        }
        if (visit_) {
            visit_(contents_, message);
        }
        ++contents_.message_count;
        contents_.last_time_ns = std::max(contents_.last_time_ns, message.log_time_ns);
    }

    void chunk(Cursor in) {
        const auto header = in.get<ChunkHeader>();
        const ByteView records = unpack(header, in.take(header.stored_size));
        if (header.crc != 0 && header.crc != crc32(records)) {
            throw Malformed("chunk with a wrong checksum");
        }
        if (records_in_chunk(records) > 0) {
            throw Malformed("chunk that ends within a record");
        }
    }

    void cut_chunk(ByteView content) {
        Cursor in(content);
        try {
            if (in.get<ChunkHeader>().compression.empty()) {
                records_in_chunk(in.rest());
            }
        } catch (const Malformed&) {  // cut within the chunk's own head: counted as unread bytes
        }
    }

    /// @return bytes behind the last whole record
    std::size_t records_in_chunk(ByteView records) {
        Cursor in(records);
        while (in.left() >= kRecordHeader_bytes) {
            const Cursor start = in;
            const auto opcode = static_cast<OpCode>(in.get<std::uint8_t>());
            const auto length = in.get<std::uint64_t>();
            if (length > in.left()) {
                return start.left();
            }
            const ByteView content = in.take(length);
            if (opcode == OpCode::schema || opcode == OpCode::channel ||
                opcode == OpCode::message) {
                read_guarded([&] { record(opcode, content, 0); });
            }
        }
        return in.left();
    }

    ByteView unpack(const ChunkHeader& header, ByteView stored) {
        if (header.compression.empty()) {
            return stored;
        }
        if (!Unpacker::knows(header.compression)) {
            throw Malformed(fmt::format("chunk compressed by {} (zstd and lz4 are known)",
                                        in_quotes(header.compression)));
        }
        if (header.size > kMaxChunk_bytes) {
            throw Malformed("chunk larger than 256 MiB");
        }
        if (header.size > unpacked_left_) {
            throw InputError(fmt::format(
                "{}: unpacks to more than {} MB, which no recording of {} "
                "bytes does",
                name_, unpacked_allowance_bytes(stored_bytes_) / 1'000'000, stored_bytes_));
        }
        unpacked_left_ -= header.size;
        unpacked_.resize(static_cast<std::size_t>(header.size));
        unpacker_.unpack(header.compression, stored, unpacked_);
        return unpacked_;
    }

    void check_data(Cursor in, std::size_t offset) {
        data_end_ = offset + kRecordHeader_bytes + in.left();
        const auto crc = in.get<std::uint32_t>();
        // A damaged chunk has been named already; this finds what no other checksum covers.
        if (crc != 0 && contents_.skipped_records == 0 && crc != crc32(file_.first(offset))) {
            throw Malformed("data section with a wrong checksum");
        }
    }

    void check_summary(Cursor in) {
        const auto start = in.get<std::uint64_t>();
        in.get<std::uint64_t>();  // start of the summary offsets
        const std::uint8_t* crc_at = in.rest().data();
        const auto crc = in.get<std::uint32_t>();
        const auto end = static_cast<std::size_t>(crc_at - file_.data());
        if (start > end) {
            throw Malformed("summary that starts behind its end");
        }
        const auto first = static_cast<std::size_t>(start);
        if (crc != 0 && crc != crc32(file_.subspan(first, end - first))) {
            throw Malformed("summary with a wrong checksum");
        }
    }

    [[nodiscard]] std::string describe() const {
        std::string text;
        if (contents_.truncated) {
            text = data_end_ > 0 ? "all data is there, but the index at the end is not whole"
                   : contents_.unread_bytes > 0
                       ? fmt::format("cut off: the last {} bytes cannot be read",
                                     contents_.unread_bytes)
                       : "not closed: nothing follows the last whole chunk";
            text += contents_.message_count > 0
                        ? fmt::format("; messages end at {:.3f} s",
                                      static_cast<double>(contents_.last_time_ns) * 1e-9)
                        : std::string("; no message is whole");
        }
        if (contents_.skipped_records > 0) {
            text += fmt::format("{}{} damaged record{} left out, first a {}",
                                text.empty() ? "" : "; ", contents_.skipped_records,
                                contents_.skipped_records == 1 ? "" : "s", first_problem_);
        }
        return text;
    }

    ByteView file_;
    std::uint64_t stored_bytes_;
    std::string name_;
    const MessageVisitor& visit_;
    Unpacker unpacker_;
    std::uint64_t unpacked_left_;
    Allowance kept_;  ///< of schemas, channels, attachments and metadata
    Bytes unpacked_;
    Contents contents_;
    bool footer_seen_ = false;
    std::size_t data_end_ = 0;  ///< 0 until the data section has been read to its end
    std::string first_problem_;
};

}  // namespace

std::uint64_t unpacked_allowance_bytes(std::uint64_t file_bytes) {
    constexpr std::uint64_t kAnyFile_bytes = 256'000'000;
    constexpr std::uint64_t kMost_bytes = 4'000'000'000;
    constexpr std::uint64_t kTimes = 100;  // a flight's own unpack to some three times their size
    return std::min(kAnyFile_bytes + kTimes * file_bytes, kMost_bytes);
}

Contents read(const std::filesystem::path& path, const MessageVisitor& visit) {
    const Content file = content_of(path);
    const ByteView bytes(reinterpret_cast<const std::uint8_t*>(file.bytes.data()),
                         file.bytes.size());
    return Scan(bytes, file.stored_bytes, path.string(), visit).run();
}

}  // namespace limpet::mcap
