// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/results.hpp"

#include <fmt/format.h>

#include <system_error>
#include <type_traits>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/version.hpp"

namespace limpet::campaign {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kApplication = 0x4C4D5054;  ///< "LMPT", in the header of our databases
constexpr std::int64_t kSchema = 1;

/// Calls each(name, type, value) for the columns of the table `runs`, in their order.
/// @param row  with a sample as wide as the campaign's keys
template <class Row, class Each>
void for_each_column(const Campaign& campaign, Row&& row, const Each& each) {
    each("run", "INTEGER PRIMARY KEY", row.run);
    each("seed", "INTEGER", row.seed);
    for (std::size_t i = 0; i < campaign.keys.size(); ++i) {
        const VariedKey& key = campaign.keys[i];
        each(key.key, is_named(key) ? "TEXT" : "REAL", row.sample[i]);
    }
    each("outcome", "TEXT", row.outcome);
    each("reason", "TEXT", row.reason);
    each("attempts", "INTEGER", row.attempts);
    for (const simulation::MetricInfo& metric : simulation::metric_table()) {
        each(metric.name, "REAL", row.metrics.*metric.field);
    }
    each("simulated_s", "REAL", row.simulated_s);
    each("physics_steps", "INTEGER", row.physics_steps);
    each("state_hash", "TEXT", row.state_hash);
}

RunRow empty_row(const Campaign& campaign) {
    RunRow row;
    for (const VariedKey& key : campaign.keys) {
        row.sample.push_back(is_named(key) ? SampledValue(std::string()) : SampledValue(0.0));
    }
    return row;
}

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

std::string campaign_hash(const Campaign& campaign) {
    return hash_text(hash_of(campaign.yaml));
}

std::string scenario_hash(const Campaign& campaign) {
    std::uint64_t hash = hash_of("");
    for (const scenario::ScenarioText& text : campaign.scenarios) {
        hash = hash_of(text.yaml(), hash);
    }
    return hash_text(hash);
}

void write_campaign(SQLite::Database& database, const Campaign& campaign) {
    SQLite::Transaction transaction(database);
    database.exec(
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};"
                    "CREATE TABLE campaign (name TEXT, limpet TEXT, yaml TEXT, campaign_hash TEXT, "
                    "scenario_hash TEXT);"
                    "CREATE TABLE scenarios (variant INTEGER PRIMARY KEY, yaml TEXT);"
                    "{}",
                    kApplication, kSchema, create_sql(campaign)));
    SQLite::Statement insert(database, "INSERT INTO campaign VALUES (?, ?, ?, ?, ?)");
    SQLite::bind(insert, campaign.name, std::string(kVersion), campaign.yaml,
                 campaign_hash(campaign), scenario_hash(campaign));
    insert.exec();
    SQLite::Statement scenario(database, "INSERT INTO scenarios VALUES (?, ?)");
    for (std::size_t i = 0; i < campaign.scenarios.size(); ++i) {
        SQLite::bind(scenario, static_cast<std::int64_t>(i), campaign.scenarios[i].yaml());
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

template <class... Values>
[[noreturn]] void refuse(const SQLite::Database& database, fmt::format_string<Values...> why,
                         Values&&... values) {
    throw InputError(database.getFilename() + ": " +
                     fmt::format(why, std::forward<Values>(values)...));
}

/// What the header says before anything else is believed.
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

/// Values that no run of ours was given: somebody else wrote them.
void require_values(SQLite::Database& database, const Campaign& campaign) {
    for (const VariedKey& key : campaign.keys) {
        const std::string column = sql_name(key.key);
        const std::string good =
            is_named(key) ? fmt::format("typeof({}) = 'text'", column)
                          : fmt::format("typeof({0}) = 'real' AND abs({0}) < 1e300", column);
        if (integer(database, fmt::format("SELECT count(*) FROM runs WHERE NOT ({})", good)) > 0) {
            refuse(database, "is damaged: column {} holds what no run was given", column);
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
        if (text(database_, "SELECT sql FROM sqlite_master WHERE name = 'runs'") !=
            create_sql(campaign_)) {
            refuse(database_, "has other columns than this Limpet ({}) writes; it was begun by {}",
                   kVersion, version_);
        }
        if (text(database_, "SELECT campaign_hash FROM campaign") != campaign_hash(campaign_) ||
            text(database_, "SELECT scenario_hash FROM campaign") != scenario_hash(campaign_)) {
            refuse(database_,
                   "is damaged: campaign or scenarios are not those that it was begun with");
        }
        require_values(database_, campaign_);
    });
}

void Results::require_same(const Campaign& campaign) const {
    const char* what = nullptr;
    if (campaign_.yaml != campaign.yaml) {
        what = "the campaign's file";
    } else if (campaign_.scenarios != campaign.scenarios) {
        what = "the scenario, its vehicle or a surface";
    } else if (version_ != kVersion) {
        what = "Limpet itself";
    }
    if (what != nullptr) {
        refuse(database_,
               "{} has changed since these results were begun; finish them with what they were "
               "begun with, or give another --out",
               what);
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
            (void)insert_->tryReset();  // also after one that failed, which was told
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
            refuse(database_, "there is no run {}; {} of {} are finished, counted from 0", run,
                   finished(), campaign_.runs);
        }
        RunRow found = empty_row(campaign_);
        int at = 0;
        for_each_column(campaign_, found, [&](const auto&, const char*, auto& value) {
            read(select.getColumn(at++), value);
        });
        return found;
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
