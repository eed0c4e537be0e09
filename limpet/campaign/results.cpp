// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/results.hpp"

#include <fmt/format.h>

#include <limits>
#include <system_error>
#include <type_traits>
#include <utility>

#include "limpet/campaign/columns.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/version.hpp"

namespace limpet::campaign {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kApplication = 0x4C4D5054;  ///< "LMPT", in the header of our databases
constexpr std::int64_t kSchema = 1;

std::string create_sql(const Campaign& campaign) {
    std::vector<std::string> columns;
    for_each_column(campaign, empty_row(campaign),
                    [&](std::string_view name, const char* type, const auto&) {
                        columns.push_back(fmt::format("{} {}", sql_name(name), type));
                    });
    return fmt::format("CREATE TABLE runs ({})", fmt::join(columns, ", "));
}

std::string insert_sql(const Campaign& campaign) {
    std::string marks;
    for_each_column(campaign, empty_row(campaign),
                    [&](const auto&...) { marks += marks.empty() ? "?" : ", ?"; });
    return fmt::format("INSERT INTO runs VALUES ({})", marks);
}

template <class Value>
void bind(SQLite::Statement& statement, int parameter, const Value& value) {
    if constexpr (std::is_same_v<Value, SampledValue>) {
        std::visit([&](const auto& held) { statement.bind(parameter, held); }, value);
    } else if constexpr (std::is_integral_v<Value>) {
        statement.bind(parameter, static_cast<std::int64_t>(value));
    } else {
        statement.bind(parameter, value);
    }
}

/// @param value  a sampled one says by what it holds whether the column has numbers or names
template <class Value>
void read(const SQLite::Column& column, Value& value) {
    if constexpr (std::is_same_v<Value, SampledValue>) {
        std::visit([&](auto& held) { read(column, held); }, value);
    } else if constexpr (std::is_integral_v<Value>) {
        value = static_cast<Value>(column.getInt64());
    } else if constexpr (std::is_same_v<Value, double>) {
        value = column.isNull() ? kNaN : column.getDouble();
    } else {
        value = column.getString();
    }
}

/// FNV-1a, 64 bits.
std::uint64_t hash_of(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325U) {
    for (const char c : text) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    }
    return hash;
}

void write_campaign(SQLite::Database& database, const Campaign& campaign, const Shard& shard) {
    SQLite::Transaction transaction(database);
    database.exec(
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};"
                    "CREATE TABLE campaign (name TEXT, limpet TEXT, yaml TEXT, campaign_hash TEXT, "
                    "scenario_hash TEXT);"
                    "CREATE TABLE scenarios (variant INTEGER PRIMARY KEY, yaml TEXT);"
                    "{}",
                    kApplication, kSchema, create_sql(campaign)));
    const Identity ours = identity_of(campaign);
    SQLite::Statement insert(database, "INSERT INTO campaign VALUES (?, ?, ?, ?, ?)");
    SQLite::bind(insert, campaign.name, std::string(kVersion), campaign.yaml, ours.campaign,
                 ours.scenarios);
    insert.exec();
    SQLite::Statement scenario(database, "INSERT INTO scenarios VALUES (?, ?)");
    for (std::size_t i = 0; i < campaign.scenarios.size(); ++i) {
        SQLite::bind(scenario, static_cast<std::int64_t>(i), campaign.scenarios[i].yaml());
        scenario.exec();
        scenario.reset();
    }
    if (campaign.on_px4) {
        database.exec("CREATE TABLE on_px4 (yes INTEGER)");
    }
    if (!shard.whole()) {
        database.exec(
            fmt::format("CREATE TABLE shard (part INTEGER, parts INTEGER);"
                        "INSERT INTO shard VALUES ({}, {})",
                        shard.part, shard.parts));
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

/// Checks the header before anything else is read.
void require_ours(SQLite::Database& database) {
    if (integer(database, "PRAGMA application_id") != kApplication) {
        refuse(database, "is not a database of results");
    }
    const std::int64_t schema = integer(database, "PRAGMA user_version");
    if (schema != kSchema) {
        refuse(database, "has schema {}, this Limpet ({}) reads schema {}", schema, kVersion,
               kSchema);
    }
    if (text(database, "PRAGMA quick_check(1)") != "ok") {
        refuse(database, "is damaged or cut short");
    }
}

void require_tables(SQLite::Database& database) {
    for (const char* table : {"campaign", "scenarios", "runs"}) {
        if (!database.tableExists(table)) {
            refuse(database, "is damaged: there is no table {}", table);
        }
    }
    if (integer(database, "SELECT count(*) FROM campaign") != 1) {
        refuse(database, "is damaged: table campaign does not have one row");
    }
}

/// Refuses values that no run was given: another program wrote them.
void require_values(SQLite::Database& database, const Campaign& campaign) {
    for (const VariedKey& key : campaign.keys) {
        const std::string column = sql_name(key.key);
        std::string wrong = fmt::format("typeof({0}) <> 'real' OR abs({0}) >= 1e300", column);
        if (is_named(key)) {
            std::vector<std::string> marks(key.values.size(), "?");
            wrong = fmt::format("typeof({0}) <> 'text' OR {0} NOT IN ({1})", column,
                                fmt::join(marks, ", "));
        }
        SQLite::Statement count(database, "SELECT count(*) FROM runs WHERE " + wrong);
        for (std::size_t i = 0; is_named(key) && i < key.values.size(); ++i) {
            count.bind(static_cast<int>(i) + 1, std::get<std::string>(key.values[i]));
        }
        (void)count.executeStep();
        if (count.getColumn(0).getInt64() > 0) {
            refuse(database, "is damaged: column {} holds what no run was given", column);
        }
    }
}

/// Reads what was the user's text once: what is wrong with it now is wrong with the file.
template <class Read>
auto written(const SQLite::Database& database, const char* what, const Read& read) {
    try {
        return read();
    } catch (const InputError& error) {
        refuse(database, "is damaged: {}: {}", what, error.what());
    }
}

Shard read_shard(SQLite::Database& database) {
    if (!database.tableExists("shard")) {
        return {};
    }
    return written(database, "table shard", [&] {
        return parse_shard(text(database, "SELECT part || '/' || parts FROM shard"));
    });
}

const char* own_length(const SQLite::Database& database) {
    return database.tableExists("rare")    ? "a search for a rare event"
           : database.tableExists("study") ? "a study"
                                           : nullptr;
}

/// Runs of another campaign, or of another part of this.
void require_runs(SQLite::Database& database, const Campaign& campaign, const Shard& shard) {
    const std::uint32_t end = own_length(database) != nullptr
                                  ? std::numeric_limits<std::uint32_t>::max()
                                  : shard.end(campaign.runs);
    if (integer(database,
                fmt::format("SELECT count(*) FROM runs WHERE run < {} OR run >= {} OR seed <> {}",
                            shard.begin(campaign.runs), end, campaign.seed)) > 0) {
        refuse(database, "is damaged: it holds runs that its campaign does not have");
    }
}

Campaign read_campaign(SQLite::Database& database) {
    std::vector<std::string> scenarios;
    SQLite::Statement scenario(database, "SELECT yaml FROM scenarios ORDER BY variant");
    while (scenario.executeStep()) {
        scenarios.push_back(scenario.getColumn(0).getString());
    }
    return written(database, "table campaign", [&] {
        return restore_campaign(text(database, "SELECT yaml FROM campaign"),
                                text(database, "SELECT name FROM campaign"), std::move(scenarios));
    });
}

}  // namespace

std::string hash_text(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

Identity identity_of(const Campaign& campaign) {
    std::uint64_t scenarios = hash_of("");
    for (const scenario::ScenarioText& text : campaign.scenarios) {
        scenarios = hash_of(text.yaml(), scenarios);
    }
    return {.campaign = hash_text(hash_of(campaign.yaml)),
            .scenarios = hash_text(scenarios),
            .version = std::string(kVersion),
            .on_px4 = campaign.on_px4};
}

const char* difference(const Identity& one, const Identity& other) {
    return one.campaign != other.campaign     ? "the campaign's file"
           : one.scenarios != other.scenarios ? "the scenario, its vehicle or a surface"
           : one.version != other.version     ? "Limpet itself"
           : one.on_px4 != other.on_px4       ? "the autopilot (--autopilot px4)"
                                              : nullptr;
}

fs::path Results::file_of(const fs::path& wanted) {
    return is_folder(wanted) ? wanted / kFileName : wanted;
}

void Results::create(const fs::path& path, const Campaign& campaign, const Shard& shard) {
    const fs::path part = path.string() + ".part";
    std::error_code error;
    fs::remove(part, error);
    try {
        SQLite::Database database = open_database(part, Access::create);
        asking(database, [&] { write_campaign(database, campaign, shard); });
    } catch (...) {
        fs::remove(part, error);
        throw;
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
        campaign_.on_px4 = database_.tableExists("on_px4");
        version_ = text(database_, "SELECT limpet FROM campaign");
        if (text(database_, "SELECT sql FROM sqlite_master WHERE name = 'runs'") !=
            create_sql(campaign_)) {
            refuse(database_, "has other columns than this Limpet ({}) writes; it was begun by {}",
                   kVersion, version_);
        }
        const Identity ours = identity_of(campaign_);
        if (text(database_, "SELECT campaign_hash FROM campaign") != ours.campaign ||
            text(database_, "SELECT scenario_hash FROM campaign") != ours.scenarios) {
            refuse(database_,
                   "is damaged: campaign or scenarios are not those that it was begun with");
        }
        shard_ = read_shard(database_);
        require_runs(database_, campaign_, shard_);
        require_values(database_, campaign_);
    });
}

const char* Results::of_its_own_length() const {
    return own_length(database_);
}

void Results::require_same(const Campaign& campaign, const Shard& shard) const {
    if (const char* what = difference(identity(), identity_of(campaign))) {
        refuse(database_,
               "{} has changed since these results were begun; finish them with what they were "
               "begun with, or give another --out",
               what);
    }
    if (shard_ != shard) {
        refuse(database_, "{} was begun here: go on {}, or give another --out",
               shard_.whole() ? "the whole campaign" : "shard " + shard_text(shard_),
               shard_.whole() ? "without --shard" : "with --shard " + shard_text(shard_));
    }
}

Identity Results::identity() const {
    Identity identity = identity_of(campaign_);
    identity.version = version_;
    return identity;
}

/// Not before there is something to write: a program that is refused leaves the file unchanged.
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
            (void)insert_->tryReset();  // also after one that failed, which was reported
            int at = 1;
            for_each_column(campaign_, row, [&](const auto&, const char*, const auto& value) {
                bind(*insert_, at++, value);
            });
            insert_->exec();
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
            counts[select.getColumn(0).getString()] = select.getColumn(1).getUInt();
        }
        return counts;
    });
}

std::vector<std::uint32_t> Results::finished_runs() {
    return asking(database_, [this] {
        std::vector<std::uint32_t> runs;
        SQLite::Statement select(database_, "SELECT run FROM runs ORDER BY run");
        while (select.executeStep()) {
            runs.push_back(select.getColumn(0).getUInt());
        }
        return runs;
    });
}

RunRow Results::row(std::uint32_t run) {
    return asking(database_, [&] {
        SQLite::Statement select(database_, "SELECT * FROM runs WHERE run = ?");
        select.bind(1, std::int64_t{run});
        if (!select.executeStep()) {
            const std::string all =
                of_its_own_length() != nullptr ? "" : fmt::format(" of {}", campaign_.runs);
            refuse(database_, "there is no run {}; {}{} are finished, counted from 0", run,
                   finished(), all);
        }
        RunRow found = empty_row(campaign_);
        int at = 0;
        for_each_column(campaign_, found, [&](const auto&, const char*, auto& value) {
            read(select.getColumn(at++), value);
        });
        return found;
    });
}

Results begin_results(const Campaign& campaign, const fs::path& folder, bool resume,
                      const Shard& shard) {
    const fs::path path = folder / Results::kFileName;
    const bool there = is_there(path);
    if (there && !resume) {
        throw InputError(path.string() +
                         ": is there already: --resume goes on with it, --out puts new results "
                         "elsewhere");
    }
    if (!there) {
        Results::create(path, campaign, shard);
    }
    Results results(path, Access::write);
    results.require_same(campaign, shard);
    return results;
}

}  // namespace limpet::campaign
