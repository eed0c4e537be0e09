// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/plant/lane_group.hpp"
#include "limpet/rare/rare_results.hpp"
#include "limpet/study/study.hpp"

namespace limpet::study {
namespace {

using StudyClock = std::chrono::steady_clock;

/// Deals the runs out, the same in every thread.
class StudyFliers {
public:
    StudyFliers(campaign::Results& results, const StudyPlan& plan, const StudyWatch& watch)
        : results_(results), plan_(plan), watch_(watch), there_(results.finished_runs()) {
        progress_.runs = plan.runs();
        progress_.finished = static_cast<std::uint32_t>(there_.size());
    }

    StudyProgress fly(int jobs) {
        const auto fly_on = [this] { fly_lanes(); };
        {
            std::vector<std::jthread> others;
            try {
                while (others.size() + 1 < static_cast<std::size_t>(jobs)) {
                    others.emplace_back(fly_on);
                }
            } catch (const std::system_error&) {  // those there are will do
            } catch (const std::bad_alloc&) {     // nor is there memory for more
            }
            fly_on();
        }
        if (failed_) {
            std::rethrow_exception(failed_);
        }
        results_.finish();
        return progress_;
    }

private:
    void fly_lanes() noexcept {
        try {
            plant::fly_side_by_side([this] { fly_some(); });
        } catch (...) {
            fail(std::current_exception());
        }
    }

    void fail(std::exception_ptr why) noexcept {
        const std::lock_guard lock(mutex_);
        failed_ = failed_ ? failed_ : why;
    }

    void fly_some() noexcept {
        try {
            while (const auto run = next()) {
                const campaign::Campaign& campaign = results_.campaign();
                const StudyPoint point = point_of(plan_, *run);
                campaign::RunRow row;
                row.run = *run;
                row.seed = campaign.seed;
                row.sample = sample_at(campaign.keys, point.normals);
                fly_row(campaign, row, point.noise);
                land(row);
            }
        } catch (...) {
            fail(std::current_exception());
        }
    }

    [[nodiscard]] std::optional<std::uint32_t> next() {
        const std::lock_guard lock(mutex_);
        while (std::binary_search(there_.begin(), there_.end(), next_)) {
            ++next_;
        }
        const bool stop = failed_ || (watch_.stop != nullptr && *watch_.stop);
        return stop || next_ >= plan_.runs() ? std::nullopt : std::optional(next_++);
    }

    void land(const campaign::RunRow& row) {
        const std::lock_guard lock(mutex_);
        results_.add({row});
        ++progress_.finished;
        ++progress_.flown;
        progress_.elapsed_s = std::chrono::duration<double>(StudyClock::now() - begin_).count();
        if (watch_.on_progress) {
            watch_.on_progress(progress_);
        }
    }

    campaign::Results& results_;
    const StudyPlan plan_;
    const StudyWatch& watch_;
    const std::vector<std::uint32_t> there_;
    const StudyClock::time_point begin_ = StudyClock::now();
    std::uint32_t next_ = 0;
    StudyProgress progress_;
    std::mutex mutex_;
    std::exception_ptr failed_ = nullptr;
};

[[noreturn]] void refuse_study(campaign::Results& results, const std::string& why) {
    throw InputError(results.database().getFilename() + ": " + why);
}

}  // namespace

std::optional<StudyAsked> study_asked(campaign::Results& results) {
    return campaign::asking(results.database(), [&]() -> std::optional<StudyAsked> {
        if (!results.database().tableExists("study")) {
            return std::nullopt;
        }
        SQLite::Statement select(results.database(), "SELECT * FROM study");
        if (!select.executeStep() || select.getColumnCount() != 2) {
            refuse_study(results, "is damaged: it does not say what was studied");
        }
        StudyAsked asked{.figure = select.getColumn(0).getString(),
                         .samples = select.getColumn(1).getUInt()};
        if (asked.samples < 2) {
            refuse_study(results, "is damaged: a study of fewer than two samples");
        }
        return asked;
    });
}

void begin_study(campaign::Results& results, const StudyAsked& asked) {
    rare::require_plain(results);
    const std::optional<StudyAsked> there = study_asked(results);
    if (there && there->samples != asked.samples) {
        refuse_study(results, fmt::format("was begun with --samples {}; finish it so, or give "
                                          "another --out",
                                          there->samples));
    }
    if (!there && results.finished() > 0) {
        refuse_study(results, "holds a campaign, not a study; give another --out");
    }
    campaign::asking(results.database(), [&] {
        SQLite::Transaction transaction(results.database());
        results.database().exec(
            "CREATE TABLE IF NOT EXISTS study (figure TEXT, samples INTEGER);"
            "DELETE FROM study");
        SQLite::Statement insert(results.database(), "INSERT INTO study VALUES (?, ?)");
        SQLite::bind(insert, asked.figure, static_cast<std::int64_t>(asked.samples));
        insert.exec();
        transaction.commit();
    });
}

void require_no_study(campaign::Results& results) {
    if (const auto asked = study_asked(results)) {
        refuse_study(results, fmt::format("holds a study of {}; go on with it by limpet study",
                                          asked->figure));
    }
}

std::optional<NoiseBlend> study_noise(campaign::Results& results, std::uint32_t run) {
    const std::optional<StudyAsked> asked = study_asked(results);
    if (!asked) {
        return std::nullopt;
    }
    return point_of(plan_of(results.campaign(), asked->samples), run).noise;
}

StudyProgress fly_study(campaign::Results& results, int jobs, const StudyWatch& watch) {
    const std::optional<StudyAsked> asked = study_asked(results);
    require(asked.has_value(), "a study that was begun");
    return StudyFliers(results, plan_of(results.campaign(), asked->samples), watch).fly(jobs);
}

}  // namespace limpet::study
