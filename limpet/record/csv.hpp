// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/work.hpp"
#include "limpet/record/recording.hpp"

namespace limpet::record {

/// Writes a recording as CSV (RFC 4180, but lines end in "\n"): one file a topic, `/truth/pose` as
/// truth_pose.csv, with units in the column names, and events.csv with the values of an event as
/// `name=value;name=value`. Numbers are the shortest that read back exactly; nan and inf as such;
/// times and 64-bit integers with all digits. No file is written over another: csv_names(). Each
/// file is written next to its place and renamed: none is ever half there.
/// @param folder  made if it is not there
/// @return the files, in the order of the topics, events.csv last
/// @throws InputError if a file cannot be written, naming it; Interrupted between two
std::vector<std::filesystem::path> write_csv(const Recording& recording,
                                             const std::filesystem::path& folder,
                                             const Work& work = {});

/// @return the files' names, one a table; empty for tables of events, which are in events.csv.
/// Names differ from each other, from events.csv and from those of attachments, in more than
/// capitals:
/// "_2" and so on is appended.
[[nodiscard]] std::vector<std::string> csv_names(const Recording& recording);

/// @return a line for each topic whose file is not called as it is
[[nodiscard]] std::vector<std::string> renamed_topics(const Recording& recording);

/// Writes what is attached to a recording into the folder, which is there, under its own names, of
/// two of one name the second with "_2".
/// @return the files
/// @throws InputError if a file cannot be written, naming it
std::vector<std::filesystem::path> write_attachments(const Recording& recording,
                                                     const std::filesystem::path& folder);

/// A recording may come from anybody, its names too: to be called before anything is written.
/// @throws InputError naming the first attachment whose name is no plain file name
void require_plain_names(const Recording& recording);

/// @return the text as a CSV field: in quotes if it holds a comma, a quote or a line break
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace limpet::record
