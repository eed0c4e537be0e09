// SPDX-License-Identifier: Apache-2.0
#include "limpet/mcap/records.hpp"

namespace limpet::mcap {
namespace {

constexpr std::uint64_t kCreateTimeUnknown_ns = 0;

}  // namespace

void put(Bytes& out, const Schema& schema) {
    put_record(out, OpCode::schema, [&] {
        put(out, schema.id);
        put_string(out, schema.name);
        put_string(out, schema.encoding);
        put_string(out, schema.text);
    });
}

Schema get_schema(ByteView content) {
    Cursor in(content);
    Schema schema;
    schema.id = in.get<std::uint16_t>();
    schema.name = in.string();
    schema.encoding = in.string();
    schema.text = in.string();
    return schema;
}

void put(Bytes& out, const Channel& channel) {
    put_record(out, OpCode::channel, [&] {
        put(out, channel.id);
        put(out, channel.schema_id);
        put_string(out, channel.topic);
        put_string(out, channel.message_encoding);
        put_map(out, channel.metadata);
    });
}

Channel get_channel(ByteView content) {
    Cursor in(content);
    Channel channel;
    channel.id = in.get<std::uint16_t>();
    channel.schema_id = in.get<std::uint16_t>();
    channel.topic = in.string();
    channel.message_encoding = in.string();
    channel.metadata = in.map();
    return channel;
}

void put(Bytes& out, const Attachment& attachment) {
    put_record(out, OpCode::attachment, [&] {
        const std::size_t start = out.size();
        put(out, attachment.log_time_ns);
        put(out, kCreateTimeUnknown_ns);
        put_string(out, attachment.name);
        put_string(out, attachment.media_type);
        put(out, std::uint64_t{attachment.text.size()});
        out.insert(out.end(), attachment.text.begin(), attachment.text.end());
        put(out, crc32(ByteView(out).subspan(start)));
    });
}

Attachment get_attachment(ByteView content) {
    Cursor in(content);
    Attachment attachment;
    attachment.log_time_ns = in.get<std::uint64_t>();
    in.get<std::uint64_t>();  // create time
    attachment.name = in.string();
    attachment.media_type = in.string();
    attachment.text = Cursor::text(in.take(in.get<std::uint64_t>()));
    const ByteView covered = content.first(content.size() - in.left());
    const auto crc = in.get<std::uint32_t>();
    if (crc != 0 && crc != crc32(covered)) {
        throw Malformed("attachment with a wrong checksum");
    }
    return attachment;
}

void put_index(Bytes& out, const Attachment& attachment, std::uint64_t offset,
               std::uint64_t length) {
    put_record(out, OpCode::attachment_index, [&] {
        put(out, offset);
        put(out, length);
        put(out, attachment.log_time_ns);
        put(out, kCreateTimeUnknown_ns);
        put(out, std::uint64_t{attachment.text.size()});
        put_string(out, attachment.name);
        put_string(out, attachment.media_type);
    });
}

void put(Bytes& out, const Metadata& metadata) {
    put_record(out, OpCode::metadata, [&] {
        put_string(out, metadata.name);
        put_map(out, metadata.values);
    });
}

Metadata get_metadata(ByteView content) {
    Cursor in(content);
    Metadata metadata;
    metadata.name = in.string();
    metadata.values = in.map();
    return metadata;
}

void put_index(Bytes& out, const Metadata& metadata, std::uint64_t offset, std::uint64_t length) {
    put_record(out, OpCode::metadata_index, [&] {
        put(out, offset);
        put(out, length);
        put_string(out, metadata.name);
    });
}

Message get_message(ByteView content) {
    Cursor in(content);
    Message message;
    message.channel_id = in.get<std::uint16_t>();
    message.sequence = in.get<std::uint32_t>();
    message.log_time_ns = in.get<std::uint64_t>();
    message.publish_time_ns = in.get<std::uint64_t>();
    message.data = in.rest();
    return message;
}

void put(Bytes& out, const ChunkHeader& header) {
    put(out, header.first_time_ns);
    put(out, header.last_time_ns);
    put(out, header.size);
    put(out, header.crc);
    put_string(out, header.compression);
    put(out, header.stored_size);
}

ChunkHeader get_chunk_header(Cursor& in) {
    ChunkHeader header;
    header.first_time_ns = in.get<std::uint64_t>();
    header.last_time_ns = in.get<std::uint64_t>();
    header.size = in.get<std::uint64_t>();
    header.crc = in.get<std::uint32_t>();
    const ByteView compression = in.take(in.get<std::uint32_t>());
    header.compression = {reinterpret_cast<const char*>(compression.data()), compression.size()};
    header.stored_size = in.get<std::uint64_t>();
    return header;
}

}  // namespace limpet::mcap
