// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "limpet/campaign/campaign.hpp"
#include "limpet/campaign/database.hpp"
#include "limpet/campaign/shard.hpp"
#include "limpet/simulation/metrics.hpp"

namespace limpet::campaign {

/// What is kept of a run. Nothing in it depends on the machine, the number of workers or the time.
struct RunRow {
    std::uint32_t run = 0;
    std::uint64_t seed = 0;
    std::vector<SampledValue> sample;
    /// Name of an Outcome; kFault when the flight broke off by a fault of ours, kNoFlight when a
    /// PX4 did not begin it.
    std::string outcome;
    std::string reason;
    std::string true_end;  ///< name of a TrueEnd; empty when there was no flight
    int attempts = 0;
    simulation::Metrics metrics;
    double simulated_s = 0.0;
    long long physics_steps = 0;
    std::string state_hash;  ///< as hash_text() writes it
    std::string autopilot;   ///< on PX4s: who answered, as it told
};
inline constexpr const char* kFault = "fault";
inline constexpr const char* kNoFlight = "no_flight";

/// By what two are known to fly the same: digests of the campaign's file and of the scenarios
/// spelled out, and Limpet's version.
struct Identity {
    std::string campaign;
    std::string scenarios;
    std::string version;
    bool on_px4 = false;
};
[[nodiscard]] Identity identity_of(const Campaign& campaign);
/// @return what differs first, as in "the campaign's file"; null: nothing
[[nodiscard]] const char* difference(const Identity& one, const Identity& other);

/// The results of a campaign: one file of SQLite that stands for itself.
///
///   campaign   one row: name, the file's text, version of Limpet, hashes of file and scenarios
///   scenarios  the scenario spelled out, for each combination of named values
///   runs       a row a run: run, seed, a column for each varied key (named like it: `"guidance.
///              dock_speed_m_s"`), outcome, reason, true_end, attempts, metrics, simulated_s,
///              physics_steps, state_hash; on PX4s autopilot, who flew it
///   on_px4     is there where PX4s fly it
///   shard      where the file holds a part of the campaign: part, parts
///
/// Every committed transaction outlives the death of the process (write-ahead log); when a campaign
/// ends the log is folded in and one plain file is left.
class Results {
public:
    static constexpr const char* kFileName = "results.sqlite";

    /// @param wanted  the file itself or the folder that holds it
    [[nodiscard]] static std::filesystem::path file_of(const std::filesystem::path& wanted);
    /// Starts a new file: whole, or not at all.
    static void create(const std::filesystem::path& path, const Campaign& campaign,
                       const Shard& shard = {});
    /// @throws InputError when there is none, when it is not one of ours, of another schema or
    ///         another version's columns, or damaged
    Results(const std::filesystem::path& path, Access access);

    /// The campaign as it was begun.
    [[nodiscard]] const Campaign& campaign() const { return campaign_; }
    [[nodiscard]] const std::string& version() const { return version_; }
    [[nodiscard]] Identity identity() const;
    /// What these results are to hold in the end.
    [[nodiscard]] const Shard& shard() const { return shard_; }
    /// What flies as many runs as it needs, not as many as the campaign says: "a search for a rare
    /// event", "a study"; null: neither.
    [[nodiscard]] const char* of_its_own_length() const;
    /// @throws InputError when `campaign` would not fly what was begun here, or not this part of it
    void require_same(const Campaign& campaign, const Shard& shard = {}) const;

    /// Rows in one transaction: all are kept or none.
    void add(const std::vector<RunRow>& rows);
    /// Folds the log into the file.
    void finish();

    [[nodiscard]] std::uint32_t finished();
    [[nodiscard]] std::map<std::string, std::uint32_t> outcomes();
    /// Ascending.
    [[nodiscard]] std::vector<std::uint32_t> finished_runs();
    /// @throws InputError when it is not there
    [[nodiscard]] RunRow row(std::uint32_t run);

    [[nodiscard]] SQLite::Database& database() { return database_; }

private:
    void start_log();

    SQLite::Database database_;
    Campaign campaign_;
    std::string version_;
    Shard shard_;
    std::optional<SQLite::Statement> insert_;
};

/// The results in a folder: new ones, or, when asked to resume, those that are there.
/// @throws InputError when there are some and nobody asked to resume, or `campaign` is not theirs
[[nodiscard]] Results begin_results(const Campaign& campaign, const std::filesystem::path& folder,
                                    bool resume, const Shard& shard = {});

/// @return 16 hexadecimal digits
[[nodiscard]] std::string hash_text(std::uint64_t hash);

}  // namespace limpet::campaign
