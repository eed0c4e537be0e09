// SPDX-License-Identifier: Apache-2.0
#include "limpet/statements/claims.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

namespace limpet::statements {
namespace {

report::Quantity shown(double value, bool yes_no) {
    if (!std::isfinite(value)) {
        return "did not come to pass";
    }
    if (yes_no) {
        return value > 0.5 ? "yes" : "no";
    }
    // Six figures: what is behind them is the noise of the arithmetic.
    return std::stod(fmt::format("{:.6g}", value));
}

/// "0.8 … 1.4", "at least 2", "2"
std::string accepted_text(const PaperStatement& statement) {
    const draw::Range& range = statement.accepted;
    if (statement.yes_no) {
        return "yes";
    }
    if (!std::isfinite(range.high)) {
        return fmt::format("at least {:.4g}", range.low);
    }
    return range.low == range.high ? fmt::format("{:.4g}", range.low)
                                   : fmt::format("{:.4g} … {:.4g}", range.low, range.high);
}

/// Less the noise of the last digits: six figures of what is compared.
double rounded(double difference, double scale) {
    const double unit = 1e-6 * std::abs(scale);
    return unit > 0.0 ? unit * std::round(difference / unit) : difference;
}

/// Simulated less paper, where that means something.
report::Quantity difference(const report::Quantity& stated, double value, bool holds) {
    if (!std::isfinite(value)) {
        return "no value";
    }
    if (const double* paper = std::get_if<double>(&stated)) {
        return rounded(value - *paper, *paper);
    }
    if (const draw::Range* range = std::get_if<draw::Range>(&stated)) {
        const double below = value - range->low, above = value - range->high;
        if (below >= 0.0 && above <= 0.0) {
            return "inside";
        }
        return below < 0.0 ? rounded(below, range->low) : rounded(above, range->high);
    }
    return holds ? "as stated" : "not as stated";
}

}  // namespace

report::Claim judge(const PaperStatement& statement, const Evidence& evidence,
                    const std::vector<TurnedEvidence>& turned) {
    report::Claim claim = statement.claim;
    if (statement.evidence.empty()) {
        claim.simulated = "not simulated";
        claim.difference = "not compared";
        return claim;
    }
    const double value = evidence.get(statement.evidence);
    const auto accepts = [&statement](double one) {
        return one >= statement.accepted.low && one <= statement.accepted.high;
    };
    const bool holds = accepts(value);
    claim.accepted = accepted_text(statement);
    claim.simulated = shown(value, statement.yes_no);
    claim.difference = difference(claim.paper, value, holds);
    claim.verdict = holds ? report::Verdict::reproduced : report::Verdict::differs;
    claim.turned = static_cast<int>(turned.size());
    for (const TurnedEvidence& one : turned) {
        if (accepts(one.value) != holds) {
            claim.hangs_on.push_back(fmt::format(
                "{}: {}", one.turn, report::to_text(shown(one.value, statement.yes_no))));
            claim.verdict = report::Verdict::hangs_on_assumptions;
        }
    }
    return claim;
}

}  // namespace limpet::statements
