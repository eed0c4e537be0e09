// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/results.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"

namespace limpet {
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
    for (const MetricInfo& metric : metric_table()) {
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

void write_campaign(Database& database, const Campaign& campaign) {
    Transaction transaction(database);
    database.execute(fmt::format("PRAGMA application_id = {}", kApplication));
    database.execute(fmt::format("PRAGMA user_version = {}", kSchema));
    database.execute(
        "CREATE TABLE campaign (name TEXT, limpet TEXT, yaml TEXT, campaign_hash TEXT, "
        "scenario_hash TEXT)");
    database.execute("CREATE TABLE scenarios (variant INTEGER PRIMARY KEY, yaml TEXT)");
    database.execute(create_sql(campaign));
    Statement insert = database.prepare("INSERT INTO campaign VALUES (?, ?, ?, ?, ?)");
    const std::string hashes[] = {campaign_hash(campaign), scenario_hash(campaign)};
    int parameter = 0;
    for (const std::string_view text :
         {std::string_view(campaign.name), kVersion, std::string_view(campaign.yaml),
          std::string_view(hashes[0]), std::string_view(hashes[1])}) {
        insert.bind(parameter++, text);
    }
    (void)insert.step();
    Statement scenario = database.prepare("INSERT INTO scenarios VALUES (?, ?)");
    for (std::size_t i = 0; i < campaign.scenarios.size(); ++i) {
        scenario.bind(0, static_cast<std::int64_t>(i));
        scenario.bind(1, std::string_view(campaign.scenarios[i]));
        (void)scenario.step();
    }
    transaction.finish();
}

/// What the header says before anything else is believed.
void require_ours(Database& database) {
    if (database.integer("PRAGMA application_id") != kApplication) {
        throw InputError(database.name() + ": is not a database of results");
    }
    const std::int64_t schema = database.integer("PRAGMA user_version");
    if (schema != kSchema) {
        throw InputError(fmt::format("{}: has schema {}, this Limpet ({}) reads schema {}",
                                     database.name(), schema, kVersion, kSchema));
    }
    if (database.text("PRAGMA quick_check(1)") != "ok") {
        throw InputError(database.name() + ": is damaged or cut short");
    }
}

void require_tables(Database& database) {
    for (const char* table : {"campaign", "scenarios", "runs"}) {
        if (database.integer(fmt::format(
                "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = '{}'",
                table)) != 1) {
            throw InputError(
                fmt::format("{}: is damaged: there is no table {}", database.name(), table));
        }
    }
    if (database.integer("SELECT count(*) FROM campaign") != 1) {
        throw InputError(database.name() + ": is damaged: table campaign does not have one row");
    }
}

/// Values that no run of ours was given: somebody else wrote them.
void require_values(Database& database, const Campaign& campaign) {
    for (const VariedKey& key : campaign.keys) {
        const std::string column = sql_name(key.key);
        const std::string good =
            is_named(key) ? fmt::format("typeof({}) = 'text'", column)
                          : fmt::format("typeof({0}) = 'real' AND abs({0}) < 1e300", column);
        if (database.integer(fmt::format("SELECT count(*) FROM runs WHERE NOT ({})", good)) > 0) {
            throw InputError(fmt::format("{}: is damaged: column {} holds what no run was given",
                                         database.name(), column));
        }
    }
}

Campaign read_campaign(Database& database) {
    std::vector<std::string> scenarios;
    Statement scenario = database.prepare("SELECT yaml FROM scenarios ORDER BY variant");
    while (scenario.step()) {
        scenarios.push_back(scenario.text(0));
    }
    return restore_campaign(database.text("SELECT yaml FROM campaign"),
                            database.text("SELECT name FROM campaign"), std::move(scenarios));
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
        Database database(part, Database::Access::create);
        write_campaign(database, campaign);
    }
    fs::rename(part, path, error);
    if (error) {
        throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
    }
}

Results::Results(const fs::path& path, Database::Access access) : database_(path, access) {
    require_ours(database_);
    require_tables(database_);
    campaign_ = read_campaign(database_);
    version_ = database_.text("SELECT limpet FROM campaign");
    campaign_hash_ = database_.text("SELECT campaign_hash FROM campaign");
    scenario_hash_ = database_.text("SELECT scenario_hash FROM campaign");
    if (database_.text("SELECT sql FROM sqlite_master WHERE name = 'runs'") !=
        create_sql(campaign_)) {
        throw InputError(
            fmt::format("{}: has other columns than this Limpet ({}) writes; it was "
                        "begun by {}",
                        database_.name(), kVersion, version_));
    }
    if (campaign_hash_ != campaign_hash(campaign_) || scenario_hash_ != scenario_hash(campaign_)) {
        throw InputError(
            database_.name() +
            ": is damaged: campaign or scenarios are not those that it was begun with");
    }
    require_values(database_, campaign_);
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
                        database_.name(), what));
    }
}

/// Not before there is something to write: whoever is refused leaves the file as it was.
void Results::start_log() {
    database_.execute("PRAGMA journal_mode = WAL");
    database_.execute("PRAGMA synchronous = NORMAL");
    insert_.emplace(database_.prepare(insert_sql(campaign_)));
}

void Results::add(const std::vector<RunRow>& rows) {
    if (!insert_) {
        start_log();
    }
    Transaction transaction(database_);
    for (const RunRow& row : rows) {
        int at = 0;
        insert_->bind(at++, std::int64_t{row.run});
        insert_->bind(at++, static_cast<std::int64_t>(row.seed));
        for (const SampledValue& value : row.sample) {
            std::visit([&](const auto& v) { insert_->bind(at++, v); }, value);
        }
        insert_->bind(at++, std::string_view(row.outcome));
        insert_->bind(at++, std::string_view(row.reason));
        insert_->bind(at++, std::int64_t{row.attempts});
        for (const MetricInfo& metric : metric_table()) {
            insert_->bind(at++, row.metrics.*metric.field);
        }
        insert_->bind(at++, row.simulated_s);
        insert_->bind(at++, static_cast<std::int64_t>(row.physics_steps));
        insert_->bind(at++, std::string_view(hash_text(row.state_hash)));
        (void)insert_->step();
    }
    transaction.finish();
}

void Results::finish() {
    insert_.reset();
    database_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
    database_.execute("PRAGMA journal_mode = DELETE");
}

std::uint32_t Results::finished() {
    return static_cast<std::uint32_t>(database_.integer("SELECT count(*) FROM runs"));
}

std::map<std::string, std::uint32_t> Results::outcomes() {
    std::map<std::string, std::uint32_t> counts;
    Statement select = database_.prepare("SELECT outcome, count(*) FROM runs GROUP BY outcome");
    while (select.step()) {
        counts[select.text(0)] = static_cast<std::uint32_t>(select.integer(1));
    }
    return counts;
}

std::uint32_t Results::first_missing() {
    return static_cast<std::uint32_t>(database_.integer(
        "SELECT CASE WHEN NOT EXISTS (SELECT 1 FROM runs WHERE run = 0) THEN 0 ELSE "
        "(SELECT min(run) + 1 FROM runs AS r WHERE NOT EXISTS "
        "(SELECT 1 FROM runs WHERE run = r.run + 1)) END"));
}

std::vector<std::uint32_t> Results::finished_from(std::uint32_t first) {
    std::vector<std::uint32_t> runs;
    Statement select = database_.prepare("SELECT run FROM runs WHERE run >= ? ORDER BY run");
    select.bind(0, std::int64_t{first});
    while (select.step()) {
        runs.push_back(static_cast<std::uint32_t>(select.integer(0)));
    }
    return runs;
}

RunRow Results::row(std::uint32_t run) {
    Statement select = database_.prepare("SELECT * FROM runs WHERE run = ?");
    select.bind(0, std::int64_t{run});
    if (!select.step()) {
        throw InputError(
            fmt::format("{}: there is no run {}; {} of {} are finished, counted from 0",
                        database_.name(), run, finished(), campaign_.runs));
    }
    RunRow row;
    int at = 0;
    row.run = static_cast<std::uint32_t>(select.integer(at++));
    row.seed = static_cast<std::uint64_t>(select.integer(at++));
    for (const VariedKey& key : campaign_.keys) {
        row.sample.push_back(is_named(key) ? SampledValue(select.text(at))
                                           : SampledValue(select.number(at)));
        ++at;
    }
    row.outcome = select.text(at++);
    row.reason = select.text(at++);
    row.attempts = static_cast<int>(select.integer(at++));
    for (const MetricInfo& metric : metric_table()) {
        row.metrics.*metric.field = select.number(at++);
    }
    row.simulated_s = select.number(at++);
    row.physics_steps = select.integer(at++);
    row.state_hash = std::stoull(select.text(at), nullptr, 16);
    return row;
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
    Results results(path, Database::Access::write);
    results.require_same(campaign);
    return results;
}

}  // namespace limpet
