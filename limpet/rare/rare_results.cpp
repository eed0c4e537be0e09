// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/errors.hpp"
#include "limpet/rare/rare.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::rare {
namespace {

void create_tables(campaign::Results& results, const RareSearch& search, const RareGuide& guide) {
    SQLite::Database& database = results.database();
    SQLite::Transaction transaction(database);
    database.exec(
        "CREATE TABLE rare (event TEXT, falling TEXT, rising TEXT, level_runs INTEGER);"
        "CREATE TABLE rare_runs (run INTEGER PRIMARY KEY, level INTEGER, chain INTEGER, parent "
        "INTEGER, distance REAL, value REAL, event INTEGER, noise TEXT)");
    SQLite::Statement insert(database, "INSERT INTO rare VALUES (?, ?, ?, ?)");
    SQLite::bind(insert, search.event.text, guide.falling, guide.rising,
                 static_cast<std::int64_t>(search.level_runs));
    insert.exec();
    transaction.commit();
}

}  // namespace

std::optional<RareSearch> rare_search(campaign::Results& results) {
    return campaign::asking(results.database(), [&]() -> std::optional<RareSearch> {
        if (!results.database().tableExists("rare")) {
            return std::nullopt;
        }
        SQLite::Statement select(results.database(), "SELECT * FROM rare");
        if (!select.executeStep() || select.getColumnCount() != 4 ||
            !results.database().tableExists("rare_runs")) {
            campaign::refuse(results.database(),
                             "is damaged: it does not say which rare event it looks for");
        }
        try {
            return RareSearch{
                .event = parse_rare_event(select.getColumn(0).getString(),
                                          {.falling = select.getColumn(1).getString(),
                                           .rising = select.getColumn(2).getString()}),
                .level_runs = select.getColumn(3).getUInt()};
        } catch (const InputError& error) {
            campaign::refuse(results.database(), "is damaged: {}", error.what());
        }
    });
}

void begin_rare(campaign::Results& results, const RareSearch& search, const RareGuide& guide) {
    const std::optional<RareSearch> there = rare_search(results);
    if (there) {
        if (there->event.text != search.event.text || there->event.figure != search.event.figure ||
            there->event.rising != search.event.rising || there->level_runs != search.level_runs) {
            campaign::refuse(
                results.database(),
                "was begun with --rare '{}' on {} and {} runs a level; finish it so, or "
                "give another --out",
                there->event.text, there->event.figure, there->level_runs);
        }
        return;
    }
    if (const char* held = results.of_its_own_length()) {
        campaign::refuse(results.database(), "holds {}, not a search; give another --out", held);
    }
    if (results.finished() > 0) {
        campaign::refuse(results.database(), "holds a campaign without --rare; give another --out");
    }
    campaign::asking(results.database(), [&] { create_tables(results, search, guide); });
}

void require_plain(campaign::Results& results) {
    if (const auto search = rare_search(results)) {
        campaign::refuse(results.database(),
                         "holds a search for a rare event; go on with it by --rare '{}'",
                         search->event.text);
    }
}

void add_rare(campaign::Results& results, const RareEvent& event, const RareSample& sample,
              const campaign::RunRow& row) {
    campaign::asking(results.database(), [&] {
        SQLite::Statement insert(
            results.database(), "INSERT OR REPLACE INTO rare_runs VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
        SQLite::bind(
            insert, static_cast<std::int64_t>(sample.run), static_cast<std::int64_t>(sample.level),
            static_cast<std::int64_t>(sample.chain), static_cast<std::int64_t>(sample.parent),
            sample.point.distance(), event.value(row), event.happened(row) ? 1 : 0,
            scenario::noise_text(sample.point.noise));
        insert.exec();
    });
    results.add({row});
}

NoiseBlend rare_noise(campaign::Results& results, std::uint32_t run) {
    return campaign::asking(results.database(), [&]() -> NoiseBlend {
        if (!results.database().tableExists("rare_runs")) {
            return {};
        }
        SQLite::Statement select(results.database(), "SELECT noise FROM rare_runs WHERE run = ?");
        select.bind(1, static_cast<std::int64_t>(run));
        if (!select.executeStep()) {
            campaign::refuse(results.database(), "is damaged: table rare_runs has no run {}", run);
        }
        return scenario::noise_from(select.getColumn(0).getString(),
                                    results.database().getFilename());
    });
}

}  // namespace limpet::rare
