// SPDX-License-Identifier: Apache-2.0
#include "limpet/rare/rare_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::rare {
namespace {

template <class... Values>
[[noreturn]] void refuse_rare(campaign::Results& results, fmt::format_string<Values...> why,
                              Values&&... values) {
    throw InputError(results.database().getFilename() + ": " +
                     fmt::format(why, std::forward<Values>(values)...));
}

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

SubsetPlan plan_of(const campaign::Campaign& campaign, const RareSearch& search) {
    return {.seed = campaign.seed,
            .inputs = drawn_keys(campaign.keys),
            .level_runs = search.level_runs};
}

std::optional<RareSearch> rare_search(campaign::Results& results) {
    return campaign::asking(results.database(), [&]() -> std::optional<RareSearch> {
        if (!results.database().tableExists("rare")) {
            return std::nullopt;
        }
        SQLite::Statement select(results.database(), "SELECT * FROM rare");
        if (!select.executeStep() || select.getColumnCount() != 4 ||
            !results.database().tableExists("rare_runs")) {
            refuse_rare(results, "is damaged: it does not say which rare event it looks for");
        }
        try {
            return RareSearch{
                .event = parse_rare_event(select.getColumn(0).getString(),
                                          {.falling = select.getColumn(1).getString(),
                                           .rising = select.getColumn(2).getString()}),
                .level_runs = select.getColumn(3).getUInt()};
        } catch (const InputError& error) {
            refuse_rare(results, "is damaged: {}", error.what());
        }
    });
}

void begin_rare(campaign::Results& results, const RareSearch& search, const RareGuide& guide) {
    const std::optional<RareSearch> there = rare_search(results);
    if (there) {
        if (there->event.text != search.event.text || there->event.figure != search.event.figure ||
            there->event.rising != search.event.rising || there->level_runs != search.level_runs) {
            refuse_rare(results,
                        "was begun with --rare '{}' on {} and {} runs a level; finish it so, or "
                        "give another --out",
                        there->event.text, there->event.figure, there->level_runs);
        }
        return;
    }
    if (const char* held = results.of_its_own_length()) {
        refuse_rare(results, "holds {}, not a search; give another --out", held);
    }
    if (results.finished() > 0) {
        refuse_rare(results, "holds a campaign without --rare; give another --out");
    }
    campaign::asking(results.database(), [&] { create_tables(results, search, guide); });
}

void require_plain(campaign::Results& results) {
    if (const auto search = rare_search(results)) {
        refuse_rare(results, "holds a search for a rare event; go on with it by --rare '{}'",
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
            refuse_rare(results, "is damaged: table rare_runs has no run {}", run);
        }
        return scenario::noise_from(select.getColumn(0).getString(),
                                    results.database().getFilename());
    });
}

void require_run_of(campaign::Results& results, const campaign::RunRow& row,
                    const RareSample& sample) {
    if (row.sample != sample_at(results.campaign().keys, sample.point.normals)) {
        refuse_rare(results, "is damaged: run {} is not the one that the search flies", row.run);
    }
}

SubsetResult evaluate_rare(campaign::Results& results, const RareSearch& search) {
    const auto finished = results.finished_runs();
    return subset_simulation(
        plan_of(results.campaign(), search), [&](std::span<RareSample> runs, const SubsetResult&) {
            for (RareSample& sample : runs) {
                if (!std::binary_search(finished.begin(), finished.end(), sample.run)) {
                    return false;
                }
                const campaign::RunRow row = results.row(sample.run);
                require_run_of(results, row, sample);
                sample.fall = search.event.fall(row);
                sample.event = search.event.happened(row);
            }
            return true;
        });
}

}  // namespace limpet::rare
