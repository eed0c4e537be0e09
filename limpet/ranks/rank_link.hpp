// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace limpet::ranks {

/// What ties the processes of one campaign together, on one machine or many. One thread of a
/// process calls it. Messages between two ranks arrive whole and in order.
class RankLink {
public:
    struct Message {
        int from = 0;
        std::string bytes;
    };

    RankLink() = default;
    /// Without leave() before it takes all ranks along: some of them wait for this one.
    virtual ~RankLink() = default;
    RankLink(const RankLink&) = delete;
    RankLink& operator=(const RankLink&) = delete;

    [[nodiscard]] virtual int rank() const = 0;
    [[nodiscard]] virtual int ranks() const = 0;
    /// Of the machine that this rank is on.
    [[nodiscard]] virtual std::string host() const = 0;
    /// This rank's share of the processors of its machine, at least 1.
    [[nodiscard]] virtual int processors() const = 0;
    /// Never waits for the other.
    virtual void send(int to, const std::string& bytes) = 0;
    /// @return none when nothing has come; never waits
    [[nodiscard]] virtual std::optional<Message> receive() = 0;
    /// The end, in good order; every rank calls it.
    virtual void leave() = 0;
};

/// The function of the module that brings MPI, found by its name, so that a program that is linked
/// to no MPI can do without. May exit the process where MPI cannot start.
using OpenRankLink = RankLink*();
inline constexpr const char* kOpenRankLink = "limpet_open_mpi_link";

}  // namespace limpet::ranks
