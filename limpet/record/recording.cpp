// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "limpet/core/errors.hpp"
#include "limpet/core/one_line.hpp"
#include "limpet/core/time.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/mcap/reader.hpp"
#include "limpet/mcap/unpack.hpp"
#include "limpet/record/topics.hpp"

namespace limpet::record {
namespace {

constexpr std::size_t kMostProblems = 5;  ///< reported one by one

/// A table and what fills it; without a reader the topic is of a kind that is not read.
struct TopicReader {
    Table table;
    std::unique_ptr<TableReader> reader;
};

/// "example_interfaces/srv/AddTwoInts_Event"
bool is_of_service(std::string_view type) {
    constexpr std::string_view kEnd = "_Event";
    return type.size() > kEnd.size() && type.substr(type.size() - kEnd.size()) == kEnd &&
           (type.find("/srv/") != std::string_view::npos ||
            type.find("/action/") != std::string_view::npos);
}

/// A name of others', fit for one line.
std::string plain(std::string_view name) {
    const std::string quoted = in_quotes(name);
    return quoted.substr(1, quoted.size() - 2);
}

/// Lines on topics that are left out, a few of them one by one.
class LeftOut {
public:
    void add(std::string line) {
        ++count_;
        if (lines_.size() < kMostProblems) {
            lines_.push_back(std::move(line));
        }
    }
    /// @param left_out  "are not read"
    [[nodiscard]] std::vector<std::string> lines(std::string_view left_out) && {
        if (count_ > lines_.size()) {
            lines_.push_back(fmt::format("{} topics more {}", count_ - lines_.size(), left_out));
        }
        return std::move(lines_);
    }

private:
    std::vector<std::string> lines_;
    std::size_t count_ = 0;
};

/// A reader of the channel's messages, which fills the topic's table.
/// @throws NotTaken when they are of a kind that does not become columns
/// @throws InputError when their definition makes no sense
void open(const mcap::Contents& contents, const mcap::Channel& channel, Allowance& allowance,
          TopicReader& topic) {
    topic.table.topic = channel.topic;
    const auto schema = contents.schemas.find(channel.schema_id);
    if (schema == contents.schemas.end() || schema->second.encoding != "ros2msg" ||
        channel.message_encoding != "cdr") {
        throw NotTaken(
            fmt::format("messages in {} with {}; those in cdr with a schema in ros2msg are",
                        in_quotes(channel.message_encoding),
                        schema == contents.schemas.end()
                            ? std::string("no schema")
                            : "a schema in " + in_quotes(schema->second.encoding)));
    }
    if (is_of_service(schema->second.name)) {
        throw NotTaken("a service's events, with requests and responses as arrays of messages");
    }
    allowance.take_definition(schema->second.text.size());
    const auto types = parse_ros2msg(schema->second.name, schema->second.text);
    topic.reader = std::make_unique<TableReader>(types, topic.table, allowance);
}

std::string text_at(const Table& table, const std::string& column, std::size_t row) {
    const TextColumn* found = table.find_text(column);
    return found != nullptr ? one_line(found->values[row]) : std::string();
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
            event.values.emplace_back(name != nullptr ? one_line(name->values[row]) : "",
                                      value->values[row]);
        }
        events.push_back(std::move(event));
    }
    return events;
}

/// Those of all channels that have some.
std::vector<RecordedEvent> events_of(const std::vector<Table>& tables) {
    std::vector<RecordedEvent> all;
    for (const Table& table : tables) {
        if (table.type == info(Topic::events).type) {
            const auto middle = static_cast<std::ptrdiff_t>(all.size());
            std::vector<RecordedEvent> events = events_of(table);
            for (RecordedEvent& event : events) {
                all.push_back(std::move(event));
            }
            std::inplace_merge(all.begin(), all.begin() + middle, all.end(),
                               [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
        }
    }
    return all;
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

std::string_view summary_text(const Recording& recording) {
    constexpr std::size_t kMost_bytes = 1'000'000;
    const mcap::Attachment* attached = recording.attachment("summary.json");
    return attached != nullptr && attached->text.size() <= kMost_bytes
               ? std::string_view(attached->text)
               : std::string_view();
}

bool begins_as_recording(std::string_view head) {
    return std::equal(mcap::kMagic.begin(), mcap::kMagic.end(), head.begin(), head.end(),
                      [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }) ||
           mcap::is_packed(head);
}

Recording read_recording(const std::filesystem::path& path) {
    std::error_code ignored;  // what is no file is refused by the reader
    const auto file_bytes = std::filesystem::file_size(path, ignored);
    Allowance allowance(mcap::unpacked_allowance_bytes(ignored ? 0 : file_bytes));
    std::map<std::uint16_t, TopicReader> topics;  // by channel; nodes stay where readers point
    LeftOut unread, not_taken;
    std::optional<std::uint64_t> origin_ns;  // whole: a double of a clock's time ends at 0.2 us
    mcap::Contents contents =
        mcap::read(path, [&](const mcap::Contents& so_far, const mcap::Message& message) {
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
                    topic.reader->append(message.log_time_ns, message.data, *origin_ns);
                }
            } catch (const TooMuch& problem) {
                throw InputError(fmt::format("{}: {}", path.string(), problem.what()));
            } catch (const NotTaken& problem) {
                topic.reader.reset();
                not_taken.add(
                    fmt::format("topic {} is not taken: {}", plain(channel.topic), problem.what()));
            } catch (const InputError& problem) {
                topic.reader.reset();
                unread.add(
                    fmt::format("topic {} is not read: {}", plain(channel.topic), problem.what()));
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
    recording.events = events_of(recording.tables);
    recording.remarks = std::move(not_taken).lines("are not taken");
    std::vector<std::string> problems = std::move(unread).lines("are not read");
    if (!contents.damage.empty()) {
        problems.insert(problems.begin(), contents.damage);
    }
    recording.damage = fmt::format("{}", fmt::join(problems, "; "));
    return recording;
}

}  // namespace limpet::record
