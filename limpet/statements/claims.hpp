// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/frames.hpp"
#include "limpet/report/page.hpp"

namespace limpet::statements {

/// What was measured on the simulation, under names that claims refer to: "perch_metal.release_s",
/// "press_metal.tau_1_s". NaN: it was looked for and did not come to pass.
class Evidence {
public:
    void set(const std::string& name, double value) { values_[name] = value; }
    /// @return NaN where nothing was measured under this name
    [[nodiscard]] double get(const std::string& name) const {
        const auto found = values_.find(name);
        return found == values_.end() ? kNaN : found->second;
    }
    [[nodiscard]] bool has(const std::string& name) const { return values_.count(name) > 0; }
    [[nodiscard]] const std::map<std::string, double>& all() const { return values_; }

private:
    std::map<std::string, double> values_;
};

/// How a value came about. "as set": read from the configuration; "recovered": measured, from what
/// was set so; "fitted": a free number was chosen so; "by construction": it cannot come out
/// otherwise; "measured": none of these.
inline constexpr std::array<std::string_view, 5> kBases = {"as set", "recovered", "fitted",
                                                           "by construction", "measured"};

/// A statement of the paper and what would bear it out. The verdict is not in it: judge() finds it.
struct PaperStatement {
    /// The paper's statement, the bounds' reasons, where to see it; its basis is one of kBases, or
    /// empty when not modelled.
    report::Claim claim = {};
    std::string evidence = {};  ///< name in Evidence; empty: the simulation has no such thing
    draw::Range accepted = {};  ///< of the evidence, ends included
    bool yes_no = false;        ///< of the evidence: 1 is yes
};

/// Every number and qualitative statement of the paper's text, in its order: a file like
/// data/paper/statements.yaml, whose head describes its keys.
/// @param measured  names of all evidence that there will be
/// @throws InputError for what is not so: an unknown key, an id twice, a name without evidence
[[nodiscard]] std::vector<PaperStatement> load_statements(const std::filesystem::path& file,
                                                          const std::vector<std::string>& measured);

/// The evidence with an assumed value turned.
struct TurnedEvidence {
    std::string turn;    ///< "`vehicle.slider.damping_N_s_m` 20 % less"
    double value = 0.0;  ///< NaN: it did not come to pass
};

/// reproduced: the evidence lies within the accepted range; differs: it does not, or did not come
/// to pass; hangs on assumptions: it does not, or does, with a value turned; not modelled: there is
/// no evidence to look for.
[[nodiscard]] report::Claim judge(const PaperStatement& statement, const Evidence& evidence,
                                  const std::vector<TurnedEvidence>& turned = {});

}  // namespace limpet::statements
