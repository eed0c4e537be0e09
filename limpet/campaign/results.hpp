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
#include "limpet/simulation/metrics.hpp"

namespace limpet::campaign {

/// A part of a campaign's runs, one after the other: a part spans the grids as evenly as the whole,
/// since neighbouring runs stand on neighbouring points.
struct Shard {
    std::uint32_t part = 1;  ///< 1..parts
    std::uint32_t parts = 1;

    /// The first run of it, and the first after it.
    [[nodiscard]] std::uint32_t begin(std::uint32_t runs) const;
    [[nodiscard]] std::uint32_t end(std::uint32_t runs) const;
    [[nodiscard]] bool whole() const { return parts == 1; }
    friend bool operator==(const Shard&, const Shard&) = default;
};

/// @param text  "2/8"
/// @throws InputError saying what is allowed
[[nodiscard]] Shard parse_shard(const std::string& text);
/// @return "2/8"
[[nodiscard]] std::string shard_text(const Shard& shard);

/// What is kept of a run. Nothing in it depends on the machine, the number of workers or the time.
struct RunRow {
    std::uint32_t run = 0;
    std::uint64_t seed = 0;
    std::vector<SampledValue> sample;
    /// Name of an Outcome; kFault when a fault of Limpet ended the flight, kNoFlight when a
    /// PX4 did not begin it.
    std::string outcome;
    std::string reason;
    std::string true_end;  ///< name of a TrueEnd; empty when there was no flight
    int attempts = 0;
    simulation::Metrics metrics;
    double simulated_s = 0.0;
    long long physics_steps = 0;
    std::string state_hash;  ///< as hash_text() writes it
    std::string autopilot;   ///< on PX4s: what the autopilot reported itself to be
};
inline constexpr const char* kFault = "fault";
inline constexpr const char* kNoFlight = "no_flight";

/// Whether a run ended with `outcome`, and so by the truth (core's true_end.hpp).
[[nodiscard]] bool ended_as(const RunRow& row, Outcome outcome);
/// A success: an outcome that the campaign names, borne out by the truth.
[[nodiscard]] bool is_success(const Campaign& campaign, const RunRow& row);
/// The same as a condition on the columns of the table `runs`.
[[nodiscard]] std::string success_sql(const Campaign& campaign);

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
    /// What determines its number of runs itself, in place of the campaign: "a search for a rare
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

/// The results in a folder: new ones, or, with `resume`, those that are there.
/// @throws InputError when there are some and `resume` is not set, or `campaign` is not theirs
[[nodiscard]] Results begin_results(const Campaign& campaign, const std::filesystem::path& folder,
                                    bool resume, const Shard& shard = {});

/// @return 16 hexadecimal digits
[[nodiscard]] std::string hash_text(std::uint64_t hash);

/// Makes one file of results of those that hold parts of a campaign, with the rows that the
/// campaign flown in one go has; whole, or not at all.
/// @param parts   files of results, in any order
/// @param target  file to write
/// @return rows in it
/// @throws InputError one line: the target is there, two parts are of different campaigns, hold the
///         same run, or runs are missing
std::uint32_t merge_results(const std::vector<std::filesystem::path>& parts,
                            const std::filesystem::path& target);

}  // namespace limpet::campaign
