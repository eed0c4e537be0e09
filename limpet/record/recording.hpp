// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "limpet/core/signals/event.hpp"
#include "limpet/mcap/format.hpp"
#include "limpet/record/table.hpp"

namespace limpet::record {

/// An event as it was recorded; names are texts, so that recordings of other versions can be read.
struct RecordedEvent {
    double time_s = 0.0;
    std::string station;
    std::string name;
    std::string reason;
    std::vector<std::pair<std::string, double>> values;

    [[nodiscard]] bool is(EventName which) const { return name == to_string(which); }
};

/// One column against its topic's time; a view into the recording.
struct Series {
    std::span<const double> time_s;
    std::span<const double> values;
};

/// A recording read back into memory.
struct Recording {
    std::filesystem::path path;
    std::map<std::string, mcap::StringMap> metadata;  ///< "limpet" -> {"seed" -> "1", ...}
    std::vector<mcap::Attachment> attachments;
    std::vector<Table> tables;  ///< one a topic that has messages, in the order of their channels
    std::vector<RecordedEvent> events;
    std::uint64_t origin_ns = 0;  ///< of all times, in the clock of the file (core/time.hpp)
    std::string damage;           ///< what is missing, in one sentence; empty when whole
    /// What is no damage: a line for each topic that does not become columns, "topic /x is not
    /// taken: why".
    std::vector<std::string> remarks;

    /// @throws InputError naming the topics that are there
    [[nodiscard]] const Table& table(std::string_view topic) const;
    /// @throws InputError naming the topics or the columns that are there
    [[nodiscard]] Series series(std::string_view topic, std::string_view column) const;
    /// @return nullptr if there is none of that name
    [[nodiscard]] const mcap::Attachment* attachment(std::string_view name) const;
};

/// @return the attached summary.json; empty where there is none, or one that is larger than any
/// flight's: as a tree it takes many times its size
[[nodiscard]] std::string_view summary_text(const Recording& recording);

/// @param head  eight bytes of a file
/// @return whether it begins as read_recording() takes it, packed as a whole or not
[[nodiscard]] bool begins_as_recording(std::string_view head);

/// Reads a whole recording, or what is whole in a damaged one: see Recording::damage. Any MCAP file
/// of ROS 2 messages with "ros2msg" schemas can be read, not ours alone. Topics of another
/// encoding, of arrays of messages, of services' events and of wide characters are named in
/// `remarks`, those whose definition makes no sense in `damage`. A file that zstd or LZ4 has packed
/// as a whole is read as it is.
/// Times of a clock count from the first message.
/// @throws InputError if path is no MCAP file, or needs more memory than one of its size may
[[nodiscard]] Recording read_recording(const std::filesystem::path& path);

}  // namespace limpet::record
