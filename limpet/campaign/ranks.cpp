// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/ranks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <type_traits>
#include <utility>

#include "limpet/campaign/columns.hpp"
#include "limpet/campaign/dealer.hpp"
#include "limpet/campaign/ledger.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::campaign {
namespace {

using std::chrono::microseconds;

/// Runs that wait at a rank for each of its threads, so that none waits for an answer of rank 0.
constexpr std::size_t kSpareRuns = 4;

/// The first byte of a message.
enum class Word : char {
    hello = 'h',      ///< to rank 0: who I am, what I was started for
    cannot = 'c',     ///< to rank 0 in hello's place: why I cannot
    begin = 'g',      ///< from rank 0: all were started for the same
    go_home = 'n',    ///< from rank 0: they were not, or it is over
    report = 'r',     ///< to rank 0: number of runs wanted, rows
    deal = 'd',       ///< from rank 0: whether these are the last, runs
    bad_input = 'i',  ///< to rank 0: text; this rank ends with what it has in the air
    our_fault = 'f',  ///< likewise
    stop = 's',       ///< either way: break off
    bye = 'b',        ///< to rank 0: nothing is in the air here any more
};

class Writer {
public:
    explicit Writer(Word word) : bytes_(1, static_cast<char>(word)) {}

    template <class Value>
    Writer& put(const Value& value) {
        if constexpr (std::is_same_v<Value, SampledValue>) {
            std::visit([this](const auto& held) { put(held); }, value);
        } else if constexpr (std::is_same_v<Value, std::string>) {
            put(static_cast<std::uint32_t>(value.size()));
            bytes_ += value;
        } else {
            static_assert(std::is_arithmetic_v<Value>);
            bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
        return *this;
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

class Reader {
public:
    explicit Reader(const std::string& bytes) : left_(bytes) {}

    [[nodiscard]] Word word() { return static_cast<Word>(get<char>()); }
    template <class Value>
    [[nodiscard]] Value get() {
        Value value;
        read(value);
        return value;
    }
    /// @param value  a sampled one says by what it holds whether a number or a name follows
    template <class Value>
    void read(Value& value) {
        if constexpr (std::is_same_v<Value, SampledValue>) {
            std::visit([this](auto& held) { read(held); }, value);
        } else if constexpr (std::is_same_v<Value, std::string>) {
            value = take(get<std::uint32_t>());
        } else {
            std::memcpy(&value, take(sizeof value).data(), sizeof value);
        }
    }

private:
    std::string_view take(std::size_t size) {
        require(size <= left_.size(), "a rank's message is whole");
        const std::string_view taken = left_.substr(0, size);
        left_.remove_prefix(size);
        return taken;
    }

    std::string_view left_;
};

/// How long until the next look at what has come: short while there is traffic.
class Patience {
public:
    void traffic() { next_ = kShort; }
    [[nodiscard]] microseconds next() {
        return std::exchange(next_, std::min(2 * next_, microseconds(kLong)));
    }
    void wait() { std::this_thread::sleep_for(next()); }

private:
    static constexpr microseconds kShort{50};
    static constexpr microseconds kLong{2000};
    microseconds next_ = kShort;
};

RankLink::Message next_message(RankLink& link) {
    Patience patience;
    while (true) {
        if (auto message = link.receive()) {
            return std::move(*message);
        }
        patience.wait();
    }
}

void tell_all(RankLink& link, Word word) {
    for (int rank = 1; rank < link.ranks(); ++rank) {
        link.send(rank, Writer(word).bytes());
    }
}

/// @return what each rank said first, in their order
std::vector<std::string> hellos(RankLink& link) {
    std::vector<std::string> said(static_cast<std::size_t>(link.ranks()));
    for (int rank = 1; rank < link.ranks(); ++rank) {
        RankLink::Message message = next_message(link);
        said.at(static_cast<std::size_t>(message.from)) = std::move(message.bytes);
    }
    return said;
}

/// @return why a rank cannot fly with rank 0; empty: it can
std::string objection(int rank, const std::string& hello, const Identity& ours) {
    Reader reader(hello);
    const Word word = reader.word();
    const auto who = fmt::format("rank {} on {}", rank, reader.get<std::string>());
    if (word == Word::cannot) {
        return fmt::format("{}: {}", who, reader.get<std::string>());
    }
    const auto campaign = reader.get<std::string>();
    const auto scenarios = reader.get<std::string>();
    const char* what = difference(
        ours, {.campaign = campaign, .scenarios = scenarios, .version = reader.get<std::string>()});
    return what == nullptr ? ""
                           : fmt::format(
                                 "{}: {} is not the same as rank 0's on this machine; all "
                                 "ranks fly the same files and the same Limpet",
                                 who, what);
}

/// Rank 0 towards the others: their reports go to the ledger, its runs to them.
class Host {
public:
    Host(RankLink& link, const Campaign& campaign, Ledger& ledger)
        : link_(link), campaign_(campaign), ledger_(ledger) {}

    void handle(const RankLink::Message& message) {
        Reader reader(message.bytes);
        switch (reader.word()) {
            case Word::report: report(message.from, reader); return;
            case Word::bad_input:
                ledger_.fail(std::make_exception_ptr(InputError(reader.get<std::string>())));
                return;
            case Word::our_fault:
                ledger_.fail(std::make_exception_ptr(InternalError(
                    fmt::format("rank {}: {}", message.from, reader.get<std::string>()))));
                return;
            case Word::stop: stop_wanted_ = true; return;
            case Word::bye: ++gone_; return;
            case Word::hello:
            case Word::cannot:
            case Word::begin:
            case Word::go_home:
            case Word::deal: break;
        }
        throw InternalError("a rank says what only rank 0 may");
    }

    [[nodiscard]] bool all_gone() const { return gone_ + 1 == link_.ranks(); }
    /// Some rank was told to stop, by a signal.
    [[nodiscard]] bool stop_wanted() const { return stop_wanted_; }

private:
    void report(int from, Reader& reader) {
        const auto wanted = reader.get<std::uint32_t>();
        const auto rows = reader.get<std::uint32_t>();
        try {
            for (std::uint32_t i = 0; i < rows; ++i) {
                RunRow row = empty_row(campaign_);
                for_each_column(campaign_, row,
                                [&](const auto&, const char*, auto& value) { reader.read(value); });
                ledger_.land(row, from);
            }
        } catch (...) {
            ledger_.fail(std::current_exception());
        }
        if (wanted > 0) {
            deal(from, wanted);
        }
    }

    void deal(int to, std::uint32_t wanted) {
        std::vector<std::uint32_t> runs;
        while (runs.size() < wanted) {
            const auto run = ledger_.next();
            if (!run) {
                break;
            }
            runs.push_back(*run);
        }
        Writer deal(Word::deal);
        deal.put(runs.size() < wanted).put(static_cast<std::uint32_t>(runs.size()));
        for (const std::uint32_t run : runs) {
            deal.put(run);
        }
        link_.send(to, deal.bytes());
    }

    RankLink& link_;
    const Campaign& campaign_;
    Ledger& ledger_;
    int gone_ = 0;
    bool stop_wanted_ = false;
};

/// Any other rank: keeps a few runs ahead of its threads, which fly them, and their rows until they
/// are sent. Threads wait in next() only when rank 0 has been asked.
class Errand final : public Dealer {
public:
    Errand(const Campaign& campaign, int jobs)
        : campaign_(campaign), ahead_(kSpareRuns * static_cast<std::size_t>(jobs)) {}

    [[nodiscard]] std::optional<std::uint32_t> next() override {
        std::unique_lock lock(mutex_);
        changed_here_.notify_one();
        dealt_.wait(lock, [this] { return !runs_.empty() || last_ || stopped_; });
        if (runs_.empty() || stopped_) {
            return std::nullopt;
        }
        const std::uint32_t run = runs_.front();
        runs_.pop_front();
        return run;
    }

    void land(const RunRow& row) override {
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
        dealt_.notify_all();
        changed_here_.notify_one();
    }

    /// What there is to tell rank 0; none: nothing.
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
        for (const RunRow& row : rows_) {
            for_each_column(campaign_, row, [&](const auto&, const char*, const auto& value) {
                report.put(value);
            });
        }
        rows_.clear();
        return report.bytes();
    }

    void deal(Reader& reader) {
        const std::lock_guard lock(mutex_);
        last_ = reader.get<bool>() || last_;
        for (auto runs = reader.get<std::uint32_t>(); runs > 0; --runs) {
            runs_.push_back(reader.get<std::uint32_t>());
        }
        asked_ = false;
        dealt_.notify_all();
    }

    void stop() {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        dealt_.notify_all();
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

    const Campaign& campaign_;
    const std::size_t ahead_;
    std::mutex mutex_;
    std::condition_variable dealt_;
    std::condition_variable changed_here_;
    std::deque<std::uint32_t> runs_;
    bool asked_ = false;  ///< for more, and not answered yet
    bool last_ = false;   ///< rank 0 has no more
    bool stopped_ = false;
    std::vector<RunRow> rows_;
    std::string failed_;  ///< as rank 0 is told; empty: nothing has
};

/// Joins; @return whether rank 0 lets this rank begin
bool join(RankLink& link, const Campaign* campaign, const std::string& why_not) {
    if (campaign == nullptr) {
        link.send(0, Writer(Word::cannot).put(link.host()).put(why_not).bytes());
    } else {
        const Identity identity = identity_of(*campaign);
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
bool hear(const RankLink::Message& message, Errand& errand, std::atomic<bool>& stop) {
    Reader reader(message.bytes);
    const Word word = reader.word();
    if (word == Word::deal) {
        errand.deal(reader);
    } else if (word == Word::stop) {
        stop = true;
        errand.stop();
    }
    return word == Word::go_home;
}

/// Until rank 0 says that it is over.
void report_and_hear(RankLink& link, Errand& errand, const Fliers& fliers, std::atomic<bool>& stop,
                     const std::atomic<bool>* stop_here) {
    Patience patience;
    bool said_stop = false;
    bool said_bye = false;
    while (true) {
        const bool done = fliers.done();  // before what they brought is asked for
        if (stop_here != nullptr && *stop_here && !said_stop) {
            said_stop = true;
            stop = true;
            errand.stop();
            link.send(0, Writer(Word::stop).bytes());
        }
        if (const auto news = errand.news()) {
            link.send(0, *news);
            patience.traffic();
        } else if (done && !said_bye) {
            said_bye = true;
            link.send(0, Writer(Word::bye).bytes());
        }
        if (const auto message = link.receive()) {
            if (hear(*message, errand, stop)) {
                return;
            }
            patience.traffic();
        } else {
            errand.wait(patience.next());
        }
    }
}

void run_errand(RankLink& link, const Campaign& campaign, int jobs,
                const std::atomic<bool>* stop_here) {
    Errand errand(campaign, jobs);
    std::atomic<bool> stop = false;
    const Fliers fliers(jobs, campaign, errand, &stop);
    try {
        report_and_hear(link, errand, fliers, stop, stop_here);
    } catch (...) {  // its threads must end before it can be told
        stop = true;
        errand.stop();
        throw;
    }
}

}  // namespace

void muster_ranks(RankLink& link, const Campaign* campaign, const std::string& why_not) {
    const std::vector<std::string> said = hellos(link);
    if (campaign == nullptr) {
        throw InputError(why_not);
    }
    const Identity ours = identity_of(*campaign);
    for (int rank = 1; rank < link.ranks(); ++rank) {
        const std::string against = objection(rank, said.at(static_cast<std::size_t>(rank)), ours);
        if (!against.empty()) {
            throw InputError(against);
        }
    }
}

void dismiss_ranks(RankLink& link) {
    tell_all(link, Word::go_home);
    link.leave();
}

Progress run_among_ranks(Results& results, int jobs, const CampaignWatch& watch, RankLink& link) {
    std::atomic<bool> stop = false;
    const CampaignWatch ours{
        .on_progress = watch.on_progress, .stop = &stop, .on_row = watch.on_row};
    Ledger ledger(results, ours, link.ranks());
    Host host(link, results.campaign(), ledger);
    const Fliers fliers(jobs, results.campaign(), ledger, &stop);
    tell_all(link, Word::begin);
    Patience patience;
    while (!fliers.done() || !host.all_gone()) {
        if (!stop && (host.stop_wanted() || (watch.stop != nullptr && *watch.stop))) {
            stop = true;
            tell_all(link, Word::stop);
        }
        if (const auto message = link.receive()) {
            try {
                host.handle(*message);
            } catch (...) {  // threads must end before it can be told
                stop = true;
                throw;
            }
            patience.traffic();
        } else {
            patience.wait();
        }
    }
    const auto farewell = [&link] {
        tell_all(link, Word::go_home);
        link.leave();
    };
    try {
        Progress progress = ledger.conclude();
        farewell();
        return progress;
    } catch (...) {
        farewell();
        throw;
    }
}

void serve_rank_0(RankLink& link, const Campaign* campaign, const std::string& why_not, int jobs,
                  const std::atomic<bool>* stop) {
    if (join(link, campaign, why_not)) {
        run_errand(link, *campaign, jobs, stop);
    }
    link.leave();
}

}  // namespace limpet::campaign
