// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "limpet/core/errors.hpp"
#include "limpet/mcap/reader.hpp"
#include "limpet/record/topics.hpp"

namespace limpet::record {
namespace {

/// A table and what fills it; without a reader the topic is of a kind that is not read.
struct TopicReader {
    Table table;
    std::unique_ptr<TableReader> reader;
};

/// Sorts messages into tables, by channel.
class Collector {
public:
    void message(const mcap::Contents& contents, const mcap::Message& message) {
        const auto [at, is_new] = topics_.try_emplace(message.channel_id);
        TopicReader& topic = at->second;
        if (is_new) {
            open(contents, contents.channels.at(message.channel_id), topic);
        }
        if (topic.reader) {
            topic.reader->append(static_cast<double>(message.log_time_ns) * 1e-9, message.data);
        }
    }

    std::vector<Table> take_tables() {
        std::vector<Table> tables;
        for (auto& [id, topic] : topics_) {
            if (topic.reader) {
                tables.push_back(std::move(topic.table));
            }
        }
        topics_.clear();
        return tables;
    }

    [[nodiscard]] const std::string& problems() const { return problems_; }

private:
    void open(const mcap::Contents& contents, const mcap::Channel& channel, TopicReader& topic) {
        topic.table.topic = channel.topic;
        const auto schema = contents.schemas.find(channel.schema_id);
        try {
            if (schema == contents.schemas.end() || schema->second.encoding != "ros2msg" ||
                channel.message_encoding != "cdr") {
                throw InputError("not cdr with a ros2msg schema");
            }
            const auto types = parse_ros2msg(schema->second.name, schema->second.text);
            topic.reader = std::make_unique<TableReader>(types, topic.table);
        } catch (const InputError& problem) {
            problems_ += fmt::format("{}topic {} is not read: {}", problems_.empty() ? "" : "; ",
                                     channel.topic, problem.what());
        }
    }

    std::map<std::uint16_t, TopicReader> topics_;  // nodes stay where they are: readers point there
    std::string problems_;
};

std::string text_at(const Table& table, const std::string& column, std::size_t row) {
    const TextColumn* found = table.find_text(column);
    return found != nullptr ? found->values[row] : std::string();
}

std::vector<RecordedEvent> events_of(const Table& table) {
    std::vector<RecordedEvent> events;
    const Column* lengths = table.find("values.length");
    for (std::size_t row = 0; row < table.time_s.size(); ++row) {
        RecordedEvent event{.time_s = table.time_s[row],
                            .station = text_at(table, "station", row),
                            .name = text_at(table, "name", row),
                            .reason = text_at(table, "reason", row),
                            .values = {}};
        const double count = lengths == nullptr ? 0.0 : lengths->values[row];
        for (int i = 0; i < count; ++i) {
            const Column* value = table.find(fmt::format("values[{}]", i));
            if (value == nullptr) {
                break;
            }
            event.values.emplace_back(text_at(table, fmt::format("value_names[{}]", i), row),
                                      value->values[row]);
        }
        events.push_back(std::move(event));
    }
    return events;
}

template <class Items>
std::string names_of(const Items& items, std::string (*name)(const typename Items::value_type&)) {
    std::vector<std::string> names;
    std::transform(items.begin(), items.end(), std::back_inserter(names), name);
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

const Table& Recording::table(std::string_view topic) const {
    const auto found = std::find_if(tables.begin(), tables.end(),
                                    [topic](const Table& t) { return t.topic == topic; });
    if (found == tables.end()) {
        throw InputError(fmt::format("{}: no topic {}; there are: {}", path.string(), topic,
                                     names_of(
                                         tables, +[](const Table& t) { return t.topic; })));
    }
    return *found;
}

Series Recording::series(std::string_view topic, std::string_view column) const {
    const Table& of_topic = table(topic);
    const Column* found = of_topic.find(column);
    if (found == nullptr) {
        throw InputError(
            fmt::format("{}: no column {} in {}; there are: {}", path.string(), column, topic,
                        names_of(
                            of_topic.columns, +[](const Column& c) { return c.name; })));
    }
    return {of_topic.time_s, found->values};
}

const mcap::Attachment* Recording::attachment(std::string_view name) const {
    const auto found = std::find_if(attachments.begin(), attachments.end(),
                                    [name](const mcap::Attachment& a) { return a.name == name; });
    return found == attachments.end() ? nullptr : &*found;
}

Recording read_recording(const std::filesystem::path& path) {
    Collector collector;
    mcap::Contents contents =
        mcap::read(path, [&collector](const mcap::Contents& so_far, const mcap::Message& message) {
            collector.message(so_far, message);
        });

    Recording recording;
    recording.path = path;
    recording.tables = collector.take_tables();
    recording.attachments = std::move(contents.attachments);
    for (mcap::Metadata& metadata : contents.metadata) {
        recording.metadata[metadata.name] = std::move(metadata.values);
    }
    for (const Table& table : recording.tables) {
        if (table.type == info(Topic::events).type) {
            recording.events = events_of(table);
        }
    }
    recording.damage = contents.damage;
    if (!collector.problems().empty()) {
        recording.damage += (recording.damage.empty() ? "" : "; ") + collector.problems();
    }
    return recording;
}

}  // namespace limpet::record
