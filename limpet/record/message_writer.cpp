// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/message_writer.hpp"

#include <algorithm>

#include "limpet/record/schema.hpp"

namespace limpet::record {
namespace {

constexpr std::string_view kEncoding = "cdr", kSchemaEncoding = "ros2msg";

}  // namespace

std::uint16_t MessageWriter::add_channel(std::string_view topic, std::string_view type) {
    return add_channel(topic, type, ros2msg_schema(type));
}

std::uint16_t MessageWriter::add_channel(std::string_view topic, std::string_view type,
                                         std::string_view schema) {
    if (!topics_.empty() && std::find(topics_.begin(), topics_.end(), topic) == topics_.end()) {
        return kNowhere;
    }
    auto known = schemas_.find(type);
    if (known == schemas_.end()) {
        known = schemas_.emplace(type, file_.add_schema(type, kSchemaEncoding, schema)).first;
    }
    // The profile "ros2" wants the key; empty means the player's default.
    const std::uint16_t id =
        file_.add_channel(known->second, topic, kEncoding, {{"offered_qos_profiles", ""}});
    if (mirror_ != nullptr) {
        mirror_->channel({.id = id,
                          .topic = topic,
                          .type = type,
                          .encoding = kEncoding,
                          .schema_encoding = kSchemaEncoding,
                          .schema = schema});
    }
    return id;
}

void MessageWriter::add_attachment(const mcap::Attachment& attachment) {
    file_.add_attachment(attachment);
    if (mirror_ != nullptr) {
        mirror_->attachment(attachment);
    }
}

}  // namespace limpet::record
