// SPDX-License-Identifier: Apache-2.0
#include <condition_variable>
#include <deque>
#include <mutex>

#include "limpet/campaign/columns.hpp"
#include "limpet/campaign/fliers.hpp"
#include "limpet/ranks/rank_message.hpp"
#include "limpet/ranks/ranks.hpp"

namespace limpet::ranks {
namespace {

/// Runs that wait at a rank for each of its threads, so that none waits for an answer of rank 0.
constexpr std::size_t kSpareRuns = 4;

/// Any other rank: keeps a few runs ready for its threads, and their rows until they are sent.
/// Threads wait in next() only while a request to rank 0 is open.
class Worker final : public campaign::RunSource {
public:
    Worker(const campaign::Campaign& campaign, int jobs)
        : campaign_(campaign), ahead_(kSpareRuns * static_cast<std::size_t>(jobs)) {}

    [[nodiscard]] std::optional<campaign::RunToFly> next() override {
        std::unique_lock lock(mutex_);
        changed_here_.notify_one();
        assigned_.wait(lock, [this] { return !runs_.empty() || last_ || stopped_; });
        if (runs_.empty() || stopped_) {
            return std::nullopt;
        }
        const std::uint32_t run = runs_.front();
        runs_.pop_front();
        return campaign::RunToFly{row_to_fly(campaign_, run), {}};
    }

    void land(const campaign::RunRow& row) override {
        const std::lock_guard lock(mutex_);
        rows_.push_back(row);
        changed_here_.notify_one();
    }

    void fail(std::exception_ptr why) noexcept override {
        const std::lock_guard lock(mutex_);
        if (!stopped_) {
            failed_ = failure(why);
        }
        stopped_ = true;
        assigned_.notify_all();
        changed_here_.notify_one();
    }

    /// The next message to rank 0; none: there is nothing to report.
    [[nodiscard]] std::optional<std::string> news() {
        const std::lock_guard lock(mutex_);
        if (!failed_.empty()) {
            return std::exchange(failed_, {});
        }
        const bool ask = !asked_ && !last_ && !stopped_ && runs_.size() < ahead_;
        if (rows_.empty() && !ask) {
            return std::nullopt;
        }
        asked_ = asked_ || ask;
        const std::size_t wanted = ask ? ahead_ - runs_.size() : 0;
        Writer report(Word::report);
        report.put(static_cast<std::uint32_t>(wanted))
            .put(static_cast<std::uint32_t>(rows_.size()));
        for (const campaign::RunRow& row : rows_) {
            campaign::for_each_column(
                campaign_, row,
                [&](const auto&, const char*, const auto& value) { report.put(value); });
        }
        rows_.clear();
        return report.bytes();
    }

    void assign(Reader& reader) {
        const std::lock_guard lock(mutex_);
        last_ = reader.get<bool>() || last_;
        for (auto runs = reader.get<std::uint32_t>(); runs > 0; --runs) {
            runs_.push_back(reader.get<std::uint32_t>());
        }
        asked_ = false;
        assigned_.notify_all();
    }

    void stop() {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        assigned_.notify_all();
    }

    /// Until a thread has landed or is out of runs, or the time is over.
    void wait(microseconds time) {
        std::unique_lock lock(mutex_);
        changed_here_.wait_for(lock, time);
    }

private:
    static std::string failure(const std::exception_ptr& why) {
        try {
            std::rethrow_exception(why);
        } catch (const InputError& error) {
            return Writer(Word::bad_input).put(std::string(error.what())).bytes();
        } catch (const std::exception& error) {
            return Writer(Word::our_fault).put(std::string(error.what())).bytes();
        }
    }

    const campaign::Campaign& campaign_;
    const std::size_t ahead_;
    std::mutex mutex_;
    std::condition_variable assigned_;
    std::condition_variable changed_here_;
    std::deque<std::uint32_t> runs_;
    bool asked_ = false;  ///< for more, and not answered yet
    bool last_ = false;   ///< rank 0 has no more
    bool stopped_ = false;
    std::vector<campaign::RunRow> rows_;
    std::string failed_;  ///< message to rank 0; empty: no thread has failed
};

/// Joins; @return whether rank 0 lets this rank begin
bool join(RankLink& link, const campaign::Campaign* campaign, const std::string& why_not) {
    if (campaign == nullptr) {
        link.send(0, Writer(Word::cannot).put(link.host()).put(why_not).bytes());
    } else {
        const campaign::Identity identity = campaign::identity_of(*campaign);
        link.send(0, Writer(Word::hello)
                         .put(link.host())
                         .put(identity.campaign)
                         .put(identity.scenarios)
                         .put(identity.version)
                         .bytes());
    }
    return Reader(next_message(link).bytes).word() == Word::begin;
}

/// @return whether it is over
bool handle(const RankLink::Message& message, Worker& worker, std::atomic<bool>& stop) {
    Reader reader(message.bytes);
    const Word word = reader.word();
    if (word == Word::assign) {
        worker.assign(reader);
    } else if (word == Word::stop) {
        stop = true;
        worker.stop();
    }
    return word == Word::shut_down;
}

/// Until rank 0 shuts this rank down.
void exchange(RankLink& link, Worker& worker, const campaign::Fliers& fliers,
              std::atomic<bool>& stop, const std::atomic<bool>* stop_here) {
    Patience patience;
    bool sent_stop = false;
    bool sent_bye = false;
    while (true) {
        const bool done = fliers.done();  // before their rows are taken
        if (stop_here != nullptr && *stop_here && !sent_stop) {
            sent_stop = true;
            stop = true;
            worker.stop();
            link.send(0, Writer(Word::stop).bytes());
        }
        if (const auto news = worker.news()) {
            link.send(0, *news);
            patience.traffic();
        } else if (done && !sent_bye) {
            sent_bye = true;
            link.send(0, Writer(Word::bye).bytes());
        }
        if (const auto message = link.receive()) {
            if (handle(*message, worker, stop)) {
                return;
            }
            patience.traffic();
        } else {
            worker.wait(patience.next());
        }
    }
}

void run_worker(RankLink& link, const campaign::Campaign& campaign, int jobs,
                const std::atomic<bool>* stop_here) {
    Worker worker(campaign, jobs);
    std::atomic<bool> stop = false;
    const campaign::Fliers fliers(jobs, campaign, worker, &stop);
    try {
        exchange(link, worker, fliers, stop, stop_here);
    } catch (...) {  // its threads must end before it can be reported
        stop = true;
        worker.stop();
        throw;
    }
}

}  // namespace

void serve_rank_0(RankLink& link, const campaign::Campaign* campaign, const std::string& why_not,
                  int jobs, const std::atomic<bool>* stop) {
    if (join(link, campaign, why_not)) {
        run_worker(link, *campaign, jobs, stop);
    }
    link.leave();
}

}  // namespace limpet::ranks
