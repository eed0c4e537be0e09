// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/results.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"

namespace limpet::campaign {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kApplication = 0x4C4D5054;  ///< "LMPT", in the header of our databases
constexpr std::int64_t kSchema = 1;

struct Column {
    std::string name;
    const char* type;
};

/// Of the table `runs`, in the order in which rows are bound and read.
std::vector<Column> columns_of(const Campaign& campaign) {
    std::vector<Column> columns = {{"run", "INTEGER PRIMARY KEY"}, {"seed", "INTEGER"}};
    for (const VariedKey& key : campaign.keys) {
        columns.push_back({key.key, is_named(key) ? "TEXT" : "REAL"});
    }
    columns.insert(columns.end(),
                   {{"outcome", "TEXT"}, {"reason", "TEXT"}, {"attempts", "INTEGER"}});
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        columns.push_back({std::string(metric.name), "REAL"});
    }
    columns.insert(columns.end(),
                   {{"simulated_s", "REAL"}, {"physics_steps", "INTEGER"}, {"state_hash", "TEXT"}});
    return columns;
}

std::string create_sql(const Campaign& campaign) {
    std::string list;
    for (const Column& column : columns_of(campaign)) {
        list +=
            fmt::format("{}{} {}", list.empty() ? "" : ", ", sql_name(column.name), column.type);
    }
    return fmt::format("CREATE TABLE runs ({})", list);
}

std::string insert_sql(const Campaign& campaign) {
    std::string marks;
    for (std::size_t i = 0; i < columns_of(campaign).size(); ++i) {
        marks += marks.empty() ? "?" : ", ?";
    }
    return fmt::format("INSERT INTO runs VALUES ({})", marks);
}

/// FNV-1a, 64 bits.
std::uint64_t hash_of(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325U) {
    for (const char c : text) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    }
    return hash;
}

std::string campaign_hash(const Campaign& campaign) {
    return hash_text(hash_of(campaign.yaml));
}

std::string scenario_hash(const Campaign& campaign) {
    std::uint64_t hash = hash_of("");
    for (const std::string& text : campaign.scenarios) {
        hash = hash_of(text, hash);
    }
    return hash_text(hash);
}

void write_campaign(SQLite::Database& database, const Campaign& campaign) {
    SQLite::Transaction transaction(database);
    database.exec(fmt::format("PRAGMA application_id = {}", kApplication));
    database.exec(fmt::format("PRAGMA user_version = {}", kSchema));
    database.exec(
        "CREATE TABLE campaign (name TEXT, limpet TEXT, yaml TEXT, campaign_hash TEXT, "
        "scenario_hash TEXT)");
    database.exec("CREATE TABLE scenarios (variant INTEGER PRIMARY KEY, yaml TEXT)");
    database.exec(create_sql(campaign));
    SQLite::Statement insert(database, "INSERT INTO campaign VALUES (?, ?, ?, ?, ?)");
    int parameter = 1;
    for (const std::string& text : {campaign.name, std::string(kVersion), campaign.yaml,
                                    campaign_hash(campaign), scenario_hash(campaign)}) {
        insert.bind(parameter++, text);
    }
    insert.exec();
    SQLite::Statement scenario(database, "INSERT INTO scenarios VALUES (?, ?)");
    for (std::size_t i = 0; i < campaign.scenarios.size(); ++i) {
        scenario.bind(1, static_cast<std::int64_t>(i));
        scenario.bind(2, campaign.scenarios[i]);
        scenario.exec();
        scenario.reset();
    }
    transaction.commit();
}

/// First number, first text of the first row.
std::int64_t integer(SQLite::Database& database, const std::string& sql) {
    return asking(database, [&] { return database.execAndGet(sql).getInt64(); });
}
std::string text(SQLite::Database& database, const std::string& sql) {
    return database.execAndGet(sql).getString();
}

/// What the header says before anything else is believed.
void require_ours(SQLite::Database& database) {
    if (integer(database, "PRAGMA application_id") != kApplication) {
        throw InputError(database.getFilename() + ": is not a database of results");
    }
    const std::int64_t schema = integer(database, "PRAGMA user_version");
    if (schema != kSchema) {
        throw InputError(fmt::format("{}: has schema {}, this Limpet ({}) reads schema {}",
                                     database.getFilename(), schema, kVersion, kSchema));
    }
    if (text(database, "PRAGMA quick_check(1)") != "ok") {
        throw InputError(database.getFilename() + ": is damaged or cut short");
    }
}

void require_tables(SQLite::Database& database) {
    for (const char* table : {"campaign", "scenarios", "runs"}) {
        if (integer(database,
                    fmt::format(
                        "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = '{}'",
                        table)) != 1) {
            throw InputError(
                fmt::format("{}: is damaged: there is no table {}", database.getFilename(), table));
        }
    }
    if (integer(database, "SELECT count(*) FROM campaign") != 1) {
        throw InputError(database.getFilename() +
                         ": is damaged: table campaign does not have one row");
    }
}

/// Values that no run of ours was given: somebody else wrote them.
void require_values(SQLite::Database& database, const Campaign& campaign) {
    for (const VariedKey& key : campaign.keys) {
        const std::string column = sql_name(key.key);
        const std::string good =
            is_named(key) ? fmt::format("typeof({}) = 'text'", column)
                          : fmt::format("typeof({0}) = 'real' AND abs({0}) < 1e300", column);
        if (integer(database, fmt::format("SELECT count(*) FROM runs WHERE NOT ({})", good)) > 0) {
            throw InputError(fmt::format("{}: is damaged: column {} holds what no run was given",
                                         database.getFilename(), column));
        }
    }
}

Campaign read_campaign(SQLite::Database& database) {
    std::vector<std::string> scenarios;
    SQLite::Statement scenario(database, "SELECT yaml FROM scenarios ORDER BY variant");
    while (scenario.executeStep()) {
        scenarios.push_back(scenario.getColumn(0).getString());
    }
    return restore_campaign(text(database, "SELECT yaml FROM campaign"),
                            text(database, "SELECT name FROM campaign"), std::move(scenarios));
}

}  // namespace

std::string hash_text(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

fs::path Results::file_of(const fs::path& wanted) {
    std::error_code ignored;
    return fs::is_directory(wanted, ignored) ? wanted / kFileName : wanted;
}

void Results::create(const fs::path& path, const Campaign& campaign) {
    const fs::path part = path.string() + ".part";
    std::error_code error;
    fs::remove(part, error);
    {
        SQLite::Database database = open_database(part, Access::create);
        asking(database, [&] { write_campaign(database, campaign); });
    }
    fs::rename(part, path, error);
    if (error) {
        throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
    }
}

Results::Results(const fs::path& path, Access access) : database_(open_database(path, access)) {
    asking(database_, [this] {
        require_ours(database_);
        require_tables(database_);
        campaign_ = read_campaign(database_);
        version_ = text(database_, "SELECT limpet FROM campaign");
        campaign_hash_ = text(database_, "SELECT campaign_hash FROM campaign");
        scenario_hash_ = text(database_, "SELECT scenario_hash FROM campaign");
        if (text(database_, "SELECT sql FROM sqlite_master WHERE name = 'runs'") !=
            create_sql(campaign_)) {
            throw InputError(
                fmt::format("{}: has other columns than this Limpet ({}) writes; it was "
                            "begun by {}",
                            database_.getFilename(), kVersion, version_));
        }
        if (campaign_hash_ != campaign_hash(campaign_) ||
            scenario_hash_ != scenario_hash(campaign_)) {
            throw InputError(
                database_.getFilename() +
                ": is damaged: campaign or scenarios are not those that it was begun with");
        }
        require_values(database_, campaign_);
    });
}

void Results::require_same(const Campaign& campaign) const {
    const char* what = nullptr;
    if (campaign_hash_ != campaign_hash(campaign)) {
        what = "the campaign's file";
    } else if (scenario_hash_ != scenario_hash(campaign)) {
        what = "the scenario, its vehicle or a surface";
    } else if (version_ != kVersion) {
        what = "Limpet itself";
    }
    if (what != nullptr) {
        throw InputError(
            fmt::format("{}: {} has changed since these results were begun; finish "
                        "them with what they were begun with, or give another --out",
                        database_.getFilename(), what));
    }
}

/// Not before there is something to write: whoever is refused leaves the file as it was.
void Results::start_log() {
    database_.exec("PRAGMA journal_mode = WAL");
    database_.exec("PRAGMA synchronous = NORMAL");
    insert_.emplace(database_, insert_sql(campaign_));
}

void Results::add(const std::vector<RunRow>& rows) {
    asking(database_, [&] {
        if (!insert_) {
            start_log();
        }
        SQLite::Transaction transaction(database_);
        for (const RunRow& row : rows) {
            int at = 1;
            insert_->bind(at++, std::int64_t{row.run});
            insert_->bind(at++, static_cast<std::int64_t>(row.seed));
            for (const SampledValue& value : row.sample) {
                std::visit([&](const auto& v) { insert_->bind(at++, v); }, value);
            }
            insert_->bind(at++, row.outcome);
            insert_->bind(at++, row.reason);
            insert_->bind(at++, std::int64_t{row.attempts});
            for (const simulation::MetricInfo& metric : simulation::metric_table()) {
                insert_->bind(at++, row.metrics.*metric.field);
            }
            insert_->bind(at++, row.simulated_s);
            insert_->bind(at++, static_cast<std::int64_t>(row.physics_steps));
            insert_->bind(at++, hash_text(row.state_hash));
            insert_->exec();
            insert_->reset();
        }
        transaction.commit();
    });
}

void Results::finish() {
    asking(database_, [this] {
        insert_.reset();
        database_.exec("PRAGMA wal_checkpoint(TRUNCATE)");
        database_.exec("PRAGMA journal_mode = DELETE");
    });
}

std::uint32_t Results::finished() {
    return static_cast<std::uint32_t>(integer(database_, "SELECT count(*) FROM runs"));
}

std::map<std::string, std::uint32_t> Results::outcomes() {
    return asking(database_, [this] {
        std::map<std::string, std::uint32_t> counts;
        SQLite::Statement select(database_, "SELECT outcome, count(*) FROM runs GROUP BY outcome");
        while (select.executeStep()) {
            counts[select.getColumn(0).getString()] =
                static_cast<std::uint32_t>(select.getColumn(1).getInt64());
        }
        return counts;
    });
}

std::uint32_t Results::first_missing() {
    return static_cast<std::uint32_t>(
        integer(database_,
                "SELECT CASE WHEN NOT EXISTS (SELECT 1 FROM runs WHERE run = 0) THEN 0 ELSE "
                "(SELECT min(run) + 1 FROM runs AS r WHERE NOT EXISTS "
                "(SELECT 1 FROM runs WHERE run = r.run + 1)) END"));
}

std::vector<std::uint32_t> Results::finished_from(std::uint32_t first) {
    return asking(database_, [&] {
        std::vector<std::uint32_t> runs;
        SQLite::Statement select(database_, "SELECT run FROM runs WHERE run >= ? ORDER BY run");
        select.bind(1, std::int64_t{first});
        while (select.executeStep()) {
            runs.push_back(static_cast<std::uint32_t>(select.getColumn(0).getInt64()));
        }
        return runs;
    });
}

RunRow Results::row(std::uint32_t run) {
    return asking(database_, [&] {
        SQLite::Statement select(database_, "SELECT * FROM runs WHERE run = ?");
        select.bind(1, std::int64_t{run});
        if (!select.executeStep()) {
            throw InputError(
                fmt::format("{}: there is no run {}; {} of {} are finished, counted from 0",
                            database_.getFilename(), run, finished(), campaign_.runs));
        }
        RunRow row;
        int at = 0;
        row.run = static_cast<std::uint32_t>(select.getColumn(at++).getInt64());
        row.seed = static_cast<std::uint64_t>(select.getColumn(at++).getInt64());
        for (const VariedKey& key : campaign_.keys) {
            row.sample.push_back(is_named(key) ? SampledValue(select.getColumn(at).getString())
                                               : SampledValue(number(select.getColumn(at))));
            ++at;
        }
        row.outcome = select.getColumn(at++).getString();
        row.reason = select.getColumn(at++).getString();
        row.attempts = static_cast<int>(select.getColumn(at++).getInt64());
        for (const simulation::MetricInfo& metric : simulation::metric_table()) {
            row.metrics.*metric.field = number(select.getColumn(at++));
        }
        row.simulated_s = number(select.getColumn(at++));
        row.physics_steps = select.getColumn(at++).getInt64();
        row.state_hash = std::stoull(select.getColumn(at).getString(), nullptr, 16);
        return row;
    });
}

Results begin_results(const Campaign& campaign, const fs::path& folder, bool resume) {
    const fs::path path = folder / Results::kFileName;
    std::error_code ignored;
    const bool there = fs::exists(path, ignored);
    if (there && !resume) {
        throw InputError(path.string() +
                         ": is there already: --resume goes on with it, --out puts new results "
                         "elsewhere");
    }
    if (!there) {
        Results::create(path, campaign);
    }
    Results results(path, Access::write);
    results.require_same(campaign);
    return results;
}

}  // namespace limpet::campaign
