// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <optional>

#include "limpet/core/clock_origin.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/mcap/reader.hpp"
#include "limpet/record/topics.hpp"

namespace limpet::record {
namespace {

constexpr std::size_t kMostProblems = 5;  ///< told one by one

/// A table and what fills it; without a reader the topic is of a kind that is not read.
struct TopicReader {
    Table table;
    std::unique_ptr<TableReader> reader;
};

/// A reader of the channel's messages, which fills the topic's table.
/// @throws InputError when they are of a kind that is not read
void open(const mcap::Contents& contents, const mcap::Channel& channel, TableAllowance& allowance,
          TopicReader& topic) {
    topic.table.topic = channel.topic;
    const auto schema = contents.schemas.find(channel.schema_id);
    if (schema == contents.schemas.end() || schema->second.encoding != "ros2msg" ||
        channel.message_encoding != "cdr") {
        throw InputError("not cdr with a ros2msg schema");
    }
    allowance.take_definition(schema->second.text.size());
    const auto types = parse_ros2msg(schema->second.name, schema->second.text);
    topic.reader = std::make_unique<TableReader>(types, topic.table, allowance);
}

std::string text_at(const Table& table, const std::string& column, std::size_t row) {
    const TextColumn* found = table.find_text(column);
    return found != nullptr ? found->values[row] : std::string();
}

std::vector<RecordedEvent> events_of(const Table& table) {
    std::vector<RecordedEvent> events;
    const Column* lengths = table.find("values.length");
    std::vector<std::pair<const TextColumn*, const Column*>> values;  // in the order of the array
    for (std::size_t i = 0; i < kMaxArrayColumns; ++i) {
        const Column* value = table.find(fmt::format("values[{}]", i));
        if (value == nullptr) {
            break;
        }
        values.emplace_back(table.find_text(fmt::format("value_names[{}]", i)), value);
    }
    for (std::size_t row = 0; row < table.time_s.size(); ++row) {
        RecordedEvent event{.time_s = table.time_s[row],
                            .station = text_at(table, "station", row),
                            .name = text_at(table, "name", row),
                            .reason = text_at(table, "reason", row),
                            .values = {}};
        const double count = lengths == nullptr ? 0.0 : lengths->values[row];
        for (std::size_t i = 0; i < values.size() && static_cast<double>(i) < count; ++i) {
            const auto& [name, value] = values[i];
            event.values.emplace_back(name != nullptr ? name->values[row] : "", value->values[row]);
        }
        events.push_back(std::move(event));
    }
    return events;
}

double seconds_after(std::uint64_t origin_ns, std::uint64_t time_ns) {
    return time_ns >= origin_ns ? 1e-9 * static_cast<double>(time_ns - origin_ns)
                                : -1e-9 * static_cast<double>(origin_ns - time_ns);
}

}  // namespace

const Table& Recording::table(std::string_view topic) const {
    const Table* found = find_by(tables, &Table::topic, topic);
    if (found == nullptr) {
        throw InputError(fmt::format("{}: no topic {}; there are: {}", path.string(), topic,
                                     listed(names_of(tables, &Table::topic))));
    }
    return *found;
}

Series Recording::series(std::string_view topic, std::string_view column) const {
    const Table& of_topic = table(topic);
    const Column* found = of_topic.find(column);
    if (found == nullptr) {
        throw InputError(fmt::format("{}: no column {} in {}; there are: {}", path.string(), column,
                                     topic, listed(names_of(of_topic.columns))));
    }
    return {of_topic.time_s, found->values};
}

const mcap::Attachment* Recording::attachment(std::string_view name) const {
    return find_by(attachments, &mcap::Attachment::name, name);
}

Recording read_recording(const std::filesystem::path& path) {
    std::error_code ignored;  // what is no file is refused by the reader
    const auto file_bytes = std::filesystem::file_size(path, ignored);
    TableAllowance allowance(mcap::unpacked_allowance_bytes(ignored ? 0 : file_bytes));
    std::map<std::uint16_t, TopicReader> topics;  // by channel; nodes stay where readers point
    std::vector<std::string> problems;
    std::size_t unread = 0;
    std::optional<std::uint64_t> origin_ns;  // whole: a double of a clock's time ends at 0.2 us
    mcap::Contents contents = mcap::read(path, [&](const mcap::Contents& so_far,
                                                   const mcap::Message& message) {
        const auto [at, is_new] = topics.try_emplace(message.channel_id);
        TopicReader& topic = at->second;
        const mcap::Channel& channel = so_far.channels.at(message.channel_id);
        try {
            if (is_new && !is_of_scene(channel.topic)) {
                open(so_far, channel, allowance, topic);
            }
            if (topic.reader) {
                if (!origin_ns) {
                    origin_ns = clock_origin_ns(message.log_time_ns);
                }
                topic.reader->append(seconds_after(*origin_ns, message.log_time_ns), message.data);
            }
        } catch (const TooMuch& problem) {
            throw InputError(fmt::format("{}: {}", path.string(), problem.what()));
        } catch (const InputError& problem) {
            topic.reader.reset();
            ++unread;
            if (problems.size() < kMostProblems) {
                problems.push_back(
                    fmt::format("topic {} is not read: {}", channel.topic, problem.what()));
            }
        }
    });

    Recording recording;
    recording.path = path;
    recording.origin_ns = origin_ns.value_or(0);
    for (auto& [id, topic] : topics) {
        if (topic.reader) {
            recording.tables.push_back(std::move(topic.table));
        }
    }
    recording.attachments = std::move(contents.attachments);
    for (mcap::Metadata& metadata : contents.metadata) {
        recording.metadata[metadata.name] = std::move(metadata.values);
    }
    for (const Table& table : recording.tables) {
        if (table.type == info(Topic::events).type) {
            recording.events = events_of(table);
        }
    }
    if (unread > problems.size()) {
        problems.push_back(fmt::format("{} topics more are not read", unread - problems.size()));
    }
    if (!contents.damage.empty()) {
        problems.insert(problems.begin(), contents.damage);
    }
    recording.damage = fmt::format("{}", fmt::join(problems, "; "));
    return recording;
}

}  // namespace limpet::record
