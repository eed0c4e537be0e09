// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/paper/evidence.hpp"
#include "limpet/report/claims.hpp"

namespace limpet::paper {

/// How a value came about. "as set": read from the configuration; "recovered": measured, from what
/// was set so; "fitted": a free number was chosen so; "by construction": it cannot come out
/// otherwise; "measured": none of these.
inline constexpr std::array<std::string_view, 5> kBases = {"as set", "recovered", "fitted",
                                                           "by construction", "measured"};

/// A statement of the paper and what would bear it out. The verdict is not in it: judge() finds it.
struct PaperStatement {
    /// What the paper says, the bounds' reasons, where to see it; its basis is one of kBases, or
    /// empty when not modelled.
    report::Claim claim = {};
    std::string evidence = {};  ///< name in Evidence; empty: the simulation has no such thing
    draw::Range accepted = {};  ///< of the evidence, ends included
    bool yes_no = false;        ///< of the evidence: 1 is yes
};

/// Every number and qualitative statement of the paper's text, in its order: a file like
/// data/paper/statements.yaml, whose head says what its keys are.
/// @param measured  names of all evidence that there will be
/// @throws InputError for what is not so: an unknown key, an id twice, a name without evidence
[[nodiscard]] std::vector<PaperStatement> load_statements(const std::filesystem::path& file,
                                                          const std::vector<std::string>& measured);

/// reproduced: the evidence lies within the accepted range; differs: it does not, or did not come
/// to pass; not modelled: there is no evidence to look for.
[[nodiscard]] report::Claim judge(const PaperStatement& statement, const Evidence& evidence);

}  // namespace limpet::paper
