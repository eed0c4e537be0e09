// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <set>

#include "limpet/campaign/results.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::campaign {
namespace {

namespace fs = std::filesystem;

/// One of the files, closed again: there may be more than a process can hold open.
struct Part {
    fs::path path;
    Identity identity;
    Shard shard;
    std::uint32_t runs = 0;
};

Part looked_at(const fs::path& path, Campaign& campaign) {
    Results results(path, Access::read);
    if (const char* held = results.of_its_own_length()) {
        throw InputError(
            fmt::format("{}: holds {}, which has no parts to be merged", path.string(), held));
    }
    campaign = results.campaign();
    return {.path = path,
            .identity = results.identity(),
            .shard = results.shard(),
            .runs = results.finished()};
}

void require_one_campaign(const Part& first, const Part& other) {
    if (const char* what = difference(first.identity, other.identity)) {
        throw InputError(fmt::format("{}: is of another campaign than {}: {} differs",
                                     other.path.string(), first.path.string(), what));
    }
}

std::string runs_text(std::int64_t first, std::int64_t last) {
    return first == last ? fmt::format("run {}", first) : fmt::format("runs {} to {}", first, last);
}

void require_no_overlap(SQLite::Database& merged, const std::vector<Part>& before,
                        const Part& part) {
    SQLite::Statement common(
        merged, "SELECT count(*), min(run), max(run) FROM part.runs JOIN main.runs USING (run)");
    (void)common.executeStep();
    if (common.getColumn(0).getInt64() == 0) {
        return;
    }
    const std::int64_t run = common.getColumn(1).getInt64();
    for (const Part& other : before) {
        SQLite::Database there = open_database(other.path, Access::read);
        SQLite::Statement holds(there, "SELECT 1 FROM runs WHERE run = ?");
        holds.bind(1, run);
        if (holds.executeStep()) {
            throw InputError(fmt::format("{} and {} overlap: both hold {}", other.path.string(),
                                         part.path.string(),
                                         runs_text(run, common.getColumn(2).getInt64())));
        }
    }
    throw InternalError("two parts overlap, and no part holds the run");
}

/// @return "runs 64 to 127, 192" of those that are not there, the first few
std::string gaps(SQLite::Database& merged, std::int64_t runs) {
    constexpr std::size_t kMostShown = 3;
    std::vector<std::string> shown;
    SQLite::Statement there(merged, "SELECT run FROM main.runs ORDER BY run");
    for (std::int64_t next = 0; next < runs && shown.size() <= kMostShown; ++next) {
        const std::int64_t run = there.executeStep() ? there.getColumn(0).getInt64() : runs;
        if (run > next) {
            shown.push_back(shown.size() == kMostShown ? "..." : runs_text(next, run - 1));
        }
        next = run;
    }
    return fmt::format("{}", fmt::join(shown, ", "));
}

/// @return "; not given: shard 2/8, 5/8", where the parts say what they are
std::string shards_not_given(const std::vector<Part>& parts) {
    const std::uint32_t number = parts.front().shard.parts;
    std::set<std::uint32_t> given;
    for (const Part& part : parts) {
        if (part.shard.parts != number || number == 1) {
            return "";
        }
        given.insert(part.shard.part);
    }
    std::string text;
    for (std::uint32_t part = 1; part <= number; ++part) {
        if (!given.contains(part)) {
            text +=
                fmt::format("{} {}/{}", text.empty() ? "; not given: shard" : ",", part, number);
        }
    }
    return text;
}

void require_finished(const Part& part, const Campaign& campaign) {
    const std::uint32_t wanted = part.shard.end(campaign.runs) - part.shard.begin(campaign.runs);
    if (!part.shard.whole() && part.runs < wanted) {
        throw InputError(
            fmt::format("{}: {} of the {} runs of shard {} are missing; --resume flies them",
                        part.path.string(), wanted - part.runs, wanted, shard_text(part.shard)));
    }
}

std::uint32_t copy_all(SQLite::Database& merged, const std::vector<Part>& parts,
                       const Campaign& campaign) {
    merged.exec(
        "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF");  // a copy, made anew if cut short
    for (auto part = parts.begin(); part != parts.end(); ++part) {
        SQLite::Statement attach(merged, "ATTACH ? AS part");
        attach.bind(1, sqlite_path(part->path));
        attach.exec();
        require_no_overlap(merged, {parts.begin(), part}, *part);
        merged.exec("INSERT INTO main.runs SELECT * FROM part.runs ORDER BY run");
        merged.exec("DETACH part");
    }
    const auto rows = merged.execAndGet("SELECT count(*) FROM main.runs").getUInt();
    if (rows < campaign.runs) {
        throw InputError(fmt::format("{} of {} runs are missing: {}{}", campaign.runs - rows,
                                     campaign.runs, gaps(merged, campaign.runs),
                                     shards_not_given(parts)));
    }
    return rows;
}

}  // namespace

std::uint32_t merge_results(const std::vector<fs::path>& paths, const fs::path& target) {
    std::error_code error;
    if (fs::exists(target, error)) {
        throw InputError(target.string() + ": is there already: --out puts it elsewhere");
    }
    Campaign campaign;
    std::vector<Part> parts;
    for (const fs::path& path : paths) {
        parts.push_back(looked_at(path, campaign));
        require_one_campaign(parts.front(), parts.back());
    }
    for (const Part& part : parts) {
        require_finished(part, campaign);
    }
    // In the order of their runs: the file grows at its end.
    std::sort(parts.begin(), parts.end(), [&](const Part& a, const Part& b) {
        return a.shard.begin(campaign.runs) < b.shard.begin(campaign.runs);
    });
    const fs::path unfinished = target.string() + ".merging";
    fs::remove(unfinished, error);
    Results::create(unfinished, campaign);
    std::uint32_t rows = 0;
    try {
        SQLite::Database merged = open_database(unfinished, Access::write);
        rows = asking(merged, [&] { return copy_all(merged, parts, campaign); });
    } catch (...) {
        fs::remove(unfinished, error);
        throw;
    }
    fs::rename(unfinished, target, error);
    if (error) {
        throw InputError(
            fmt::format("{}: cannot be written: {}", target.string(), error.message()));
    }
    return rows;
}

}  // namespace limpet::campaign
