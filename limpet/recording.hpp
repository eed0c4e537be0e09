// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace limpet {

/// One column of a topic against time; a view into the recording.
struct Series {
    std::span<const double> time_s;
    std::span<const double> values;
};

/// An event as it was recorded; names are texts, so that recordings of other versions can be read.
struct PastEvent {
    double time_s = 0.0;
    std::string station;
    std::string name;
    std::string reason;
    std::vector<std::pair<std::string, double>> values;
};

/// A flight's MCAP file, or any other of ROS 2 messages, read back into memory.
class Recording {
public:
    /// @throws InputError if it is no MCAP file
    explicit Recording(const std::filesystem::path& file);

    [[nodiscard]] std::vector<std::string> topics() const;
    /// @throws InputError naming the topics that are there
    [[nodiscard]] std::vector<std::string> columns(std::string_view topic) const;
    /// @throws InputError naming the topics or the columns that are there
    [[nodiscard]] Series series(std::string_view topic, std::string_view column) const;
    [[nodiscard]] const std::vector<PastEvent>& events() const;
    /// Of the scenario: load() takes it again once it is a file.
    [[nodiscard]] std::string scenario_yaml() const;
    /// What is missing, in one sentence; empty when whole.
    [[nodiscard]] const std::string& damage() const;

private:
    struct Inside;
    std::shared_ptr<const Inside> inside_;
};

}  // namespace limpet
