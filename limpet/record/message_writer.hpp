// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "limpet/mcap/writer.hpp"
#include "limpet/record/message_sink.hpp"

namespace limpet::record {

/// A recording's channels. Log times are simulated nanoseconds from 0. write() allocates nothing.
class MessageWriter {
public:
    /// @param mirror  takes the same; null: nobody. Lives as long
    /// @param topics  that are written; none: all of them
    /// @throws InputError if the file cannot be written
    explicit MessageWriter(const std::filesystem::path& path, MessageSink* mirror = nullptr,
                           const mcap::WriterOptions& options = {},
                           std::vector<std::string> topics = {})
        : file_(path, options), mirror_(mirror), topics_(std::move(topics)) {}

    [[nodiscard]] mcap::Writer& file() { return file_; }
    [[nodiscard]] const mcap::Writer& file() const { return file_; }
    /// Of the latest message, 0 without any.
    [[nodiscard]] std::int64_t last_time_ns() const { return last_time_ns_; }

    /// @param type  one of message_definitions()
    /// @return for write(); of a topic that is not written its messages go nowhere
    std::uint16_t add_channel(std::string_view topic, std::string_view type);
    std::uint16_t add_channel(std::string_view topic, std::string_view type,
                              std::string_view schema);
    void add_attachment(const mcap::Attachment& attachment);
    /// Space for messages of so many bytes.
    void reserve(std::size_t bytes) { buffer_.resize(std::max(buffer_.size(), bytes)); }

    // Defined in cdr.hpp, for those who write messages.
    template <class... Fields>
    void write(std::uint16_t channel, double time_s, const Fields&... fields);
    /// A message that begins with its stamp.
    template <class... Fields>
    void write_stamped(std::uint16_t channel, double time_s, const Fields&... fields);

private:
    static constexpr std::uint16_t kNowhere = 0xFFFF;

    mcap::Writer file_;
    MessageSink* mirror_;
    std::vector<std::string> topics_;
    std::map<std::string, std::uint16_t, std::less<>> schemas_;  ///< by type
    std::vector<char> buffer_ = std::vector<char>(4096);
    std::int64_t last_time_ns_ = 0;
};

}  // namespace limpet::record
