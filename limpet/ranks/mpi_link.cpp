// SPDX-License-Identifier: Apache-2.0
#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <deque>
#include <vector>

#include "limpet/ranks/rank_link.hpp"

namespace limpet::ranks {
namespace {

constexpr int kTag = 0;
constexpr int kFault = 70;  ///< as the program's exit code

/// Ranks of a machine share its processors, unless the launcher has bound each to its own.
/// Called by all ranks.
int count_processors() {
    cpu_set_t mine;
    CPU_ZERO(&mine);
    if (sched_getaffinity(0, sizeof mine, &mine) != 0) {
        CPU_SET(0, &mine);  // a machine of more than 1024: the user gives --jobs
    }
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    int neighbours = 1;
    MPI_Comm_size(machine, &neighbours);
    std::vector<cpu_set_t> all(static_cast<std::size_t>(neighbours));
    MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, machine);
    MPI_Comm_free(&machine);
    int sharers = 0;
    for (const cpu_set_t& other : all) {
        cpu_set_t common;
        CPU_AND(&common, &mine, &other);
        sharers += CPU_COUNT(&common) > 0 ? 1 : 0;
    }
    return std::max(1, CPU_COUNT(&mine) / std::max(1, sharers));
}

/// One thread calls MPI, and polls for messages rather than wait for them: Open MPI's
/// waiting keeps a processor busy. Errors end all ranks, as is MPI's default.
class MpiLink final : public RankLink {
public:
    MpiLink() {
        int provided = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
        processors_ = count_processors();
    }
    ~MpiLink() override {
        if (!left_) {
            MPI_Abort(MPI_COMM_WORLD, kFault);
        }
    }
    MpiLink(const MpiLink&) = delete;
    MpiLink& operator=(const MpiLink&) = delete;

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int ranks() const override { return ranks_; }
    [[nodiscard]] int processors() const override { return processors_; }

    [[nodiscard]] std::string host() const override {
        std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
        int length = 0;
        MPI_Get_processor_name(name.data(), &length);
        return {name.data(), static_cast<std::size_t>(length)};
    }

    /// Until the other has looked, the message stays here: MPI_Send would wait for that, and spin.
    void send(int to, const std::string& bytes) override {
        Letter& letter = sent_.emplace_back();
        letter.bytes = bytes;
        MPI_Isend(letter.bytes.data(), static_cast<int>(letter.bytes.size()), MPI_BYTE, to, kTag,
                  MPI_COMM_WORLD, &letter.request);
        // NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): let_go() and leave() complete it
    }

    [[nodiscard]] std::optional<Message> receive() override {
        let_go();
        int there = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, kTag, MPI_COMM_WORLD, &there, &status);
        if (there == 0) {
            return std::nullopt;
        }
        int size = 0;
        MPI_Get_count(&status, MPI_BYTE, &size);
        Message message{.from = status.MPI_SOURCE,
                        .bytes = std::string(static_cast<std::size_t>(size), '\0')};
        MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.from, kTag, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
        return message;
    }

    void leave() override {
        left_ = true;
        for (Letter& letter : sent_) {
            // NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): as at send()
            MPI_Wait(&letter.request, MPI_STATUS_IGNORE);
        }
        MPI_Finalize();
    }

private:
    struct Letter {
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };

    /// What has gone, in the order in which it was sent.
    void let_go() {
        for (int gone = 1; gone != 0 && !sent_.empty();) {
            MPI_Test(&sent_.front().request, &gone, MPI_STATUS_IGNORE);
            if (gone != 0) {
                sent_.pop_front();
            }
        }
    }

    std::deque<Letter> sent_;  ///< whose elements stay where they are
    int rank_ = 0;
    int ranks_ = 1;
    int processors_ = 1;
    bool left_ = false;
};

}  // namespace
}  // namespace limpet::ranks

extern "C" [[gnu::visibility("default")]] limpet::ranks::RankLink* limpet_open_mpi_link() {
    return new limpet::ranks::MpiLink();
}
