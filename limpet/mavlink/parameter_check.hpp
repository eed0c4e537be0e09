// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limpet/mavlink/link.hpp"
#include "limpet/mavlink/messages.hpp"

namespace limpet::mavlink {

struct ExpectedParameter {
    std::string name;
    double value = 0.0;
    std::string reason = {};  ///< for people
};

/// A parameter that an autopilot has otherwise.
struct ParameterDifference {
    ExpectedParameter expected;
    std::optional<double> value;  ///< nothing: it reports no such parameter
};
/// "FD_FAIL_P 60 instead of 0 (reason)"; "no COM_SPOOLUP_TIME (reason)".
[[nodiscard]] std::string text_of(const ParameterDifference& difference);

/// Of several, for people: the first five, then how many more there are.
[[nodiscard]] std::vector<std::string> lines_of(const std::vector<ParameterDifference>& found);

/// Compares an autopilot's parameters with those that a flight expects, before it is armed: each is
/// read by name over the parameter protocol, at most three times. Time is injected.
class ParameterCheck {
public:
    explicit ParameterCheck(std::vector<ExpectedParameter> expected);

    void hear(const ParamValue& message);
    /// Sends what is due: a few requests at a time.
    void update(Link& link, std::uint8_t target_system, double time_s);
    /// Each has been reported, or requested in vain; also when nothing is expected. An autopilot
    /// that reports none of them is none that can be compared.
    [[nodiscard]] bool done(double time_s) const;
    /// Of what has been reported so far, in the order in which they are expected; one that is
    /// reported in vain is in it once done().
    [[nodiscard]] std::vector<ParameterDifference> differences(double time_s) const;

private:
    struct Row {
        ExpectedParameter expected;
        std::optional<double> value = {};
        int requests = 0;
        double requested_s = -1e9;
    };
    [[nodiscard]] bool settled(const Row& row, double time_s) const;

    std::vector<Row> rows_;
    double sent_s_ = -1e9;
};

}  // namespace limpet::mavlink
