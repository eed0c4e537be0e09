// SPDX-License-Identifier: Apache-2.0
#include "limpet/ranks/ranks.hpp"

#include <fmt/format.h>

#include "limpet/campaign/columns.hpp"
#include "limpet/campaign/ledger.hpp"
#include "limpet/ranks/rank_message.hpp"

namespace limpet::ranks {
namespace {

void tell_all(RankLink& link, Word word) {
    for (int rank = 1; rank < link.ranks(); ++rank) {
        link.send(rank, Writer(word).bytes());
    }
}

/// @return each rank's first message, in their order
std::vector<std::string> hellos(RankLink& link) {
    std::vector<std::string> first(static_cast<std::size_t>(link.ranks()));
    for (int rank = 1; rank < link.ranks(); ++rank) {
        RankLink::Message message = next_message(link);
        first.at(static_cast<std::size_t>(message.from)) = std::move(message.bytes);
    }
    return first;
}

/// @return why a rank cannot fly with rank 0; empty: it can
std::string objection(int rank, const std::string& hello, const campaign::Identity& own) {
    Reader reader(hello);
    const Word word = reader.word();
    const auto who = fmt::format("rank {} on {}", rank, reader.get<std::string>());
    if (word == Word::cannot) {
        return fmt::format("{}: {}", who, reader.get<std::string>());
    }
    const auto campaign = reader.get<std::string>();
    const auto scenarios = reader.get<std::string>();
    const char* what = campaign::difference(
        own, {.campaign = campaign, .scenarios = scenarios, .version = reader.get<std::string>()});
    return what == nullptr ? ""
                           : fmt::format(
                                 "{}: {} is not the same as rank 0's on this machine; all "
                                 "ranks fly the same files and the same Limpet",
                                 who, what);
}

/// Rank 0 towards the others: their reports go to the ledger, its runs to them.
class Coordinator {
public:
    Coordinator(RankLink& link, const campaign::Campaign& campaign, campaign::Ledger& ledger)
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
            case Word::shut_down:
            case Word::assign: break;
        }
        throw InternalError("a rank sends what only rank 0 may");
    }

    [[nodiscard]] bool all_gone() const { return gone_ + 1 == link_.ranks(); }
    /// Some rank was stopped by a signal.
    [[nodiscard]] bool stop_wanted() const { return stop_wanted_; }

private:
    void report(int from, Reader& reader) {
        const auto wanted = reader.get<std::uint32_t>();
        const auto rows = reader.get<std::uint32_t>();
        try {
            for (std::uint32_t i = 0; i < rows; ++i) {
                campaign::RunRow row = campaign::empty_row(campaign_);
                campaign::for_each_column(
                    campaign_, row,
                    [&](const auto&, const char*, auto& value) { reader.read(value); });
                ledger_.land(row, from);
            }
        } catch (...) {
            ledger_.fail(std::current_exception());
        }
        if (wanted > 0) {
            assign(from, wanted);
        }
    }

    void assign(int to, std::uint32_t wanted) {
        std::vector<std::uint32_t> runs;
        while (runs.size() < wanted) {
            const auto next = ledger_.next();
            if (!next) {
                break;
            }
            runs.push_back(next->row.run);
        }
        Writer runs_message(Word::assign);
        runs_message.put(runs.size() < wanted).put(static_cast<std::uint32_t>(runs.size()));
        for (const std::uint32_t run : runs) {
            runs_message.put(run);
        }
        link_.send(to, runs_message.bytes());
    }

    RankLink& link_;
    const campaign::Campaign& campaign_;
    campaign::Ledger& ledger_;
    int gone_ = 0;
    bool stop_wanted_ = false;
};

}  // namespace

void gather_ranks(RankLink& link, const campaign::Campaign* campaign, const std::string& why_not) {
    const std::vector<std::string> first = hellos(link);
    if (campaign == nullptr) {
        throw InputError(why_not);
    }
    const campaign::Identity own = campaign::identity_of(*campaign);
    for (int rank = 1; rank < link.ranks(); ++rank) {
        const std::string against = objection(rank, first.at(static_cast<std::size_t>(rank)), own);
        if (!against.empty()) {
            throw InputError(against);
        }
    }
}

void dismiss_ranks(RankLink& link) {
    tell_all(link, Word::shut_down);
    link.leave();
}

campaign::Progress run_among_ranks(campaign::Results& results, int jobs,
                                   const campaign::CampaignWatch& watch, RankLink& link) {
    std::atomic<bool> stop = false;
    const campaign::CampaignWatch own{
        .on_progress = watch.on_progress, .stop = &stop, .on_row = watch.on_row};
    campaign::Ledger ledger(results, own, {}, link.ranks());
    Coordinator coordinator(link, results.campaign(), ledger);
    const campaign::Fliers fliers(jobs, results.campaign(), ledger, &stop);
    tell_all(link, Word::begin);
    Patience patience;
    while (!fliers.done() || !coordinator.all_gone()) {
        if (!stop && (coordinator.stop_wanted() || (watch.stop != nullptr && *watch.stop))) {
            stop = true;
            tell_all(link, Word::stop);
        }
        if (const auto message = link.receive()) {
            try {
                coordinator.handle(*message);
            } catch (...) {  // threads must end before it can be reported
                stop = true;
                throw;
            }
            patience.traffic();
        } else {
            patience.wait();
        }
    }

    try {
        campaign::Progress progress = ledger.conclude();
        dismiss_ranks(link);
        return progress;
    } catch (...) {
        dismiss_ranks(link);
        throw;
    }
}

}  // namespace limpet::ranks
