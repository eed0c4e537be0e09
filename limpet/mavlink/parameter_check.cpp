// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/parameter_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "limpet/mavlink/parameter_value.hpp"

namespace limpet::mavlink {
namespace {

constexpr int kMostRequests = 3;
constexpr int kRequestsAtOnce = 8;           // an autopilot's queue is short
constexpr double kRequestInterval_s = 0.05;  // between them
constexpr double kAnswer_s = 0.5;            // for which an answer is waited
constexpr std::chrono::milliseconds kSendLimit{5};

bool same_float(double a, double b) {
    constexpr double kFloat = 1e-6;  // it is a float on the way, and in it
    return std::abs(a - b) <= kFloat * std::max({std::abs(a), std::abs(b), 1e-3});
}

std::string with_reason(const std::string& text, const ExpectedParameter& expected) {
    return expected.reason.empty() ? text : text + " (" + expected.reason + ")";
}

}  // namespace

std::string text_of(const ParameterDifference& difference) {
    const ExpectedParameter& expected = difference.expected;
    return with_reason(difference.value ? fmt::format("{} {:g} instead of {:g}", expected.name,
                                                      *difference.value, expected.value)
                                        : "no " + expected.name,
                       expected);
}

std::vector<std::string> lines_of(const std::vector<ParameterDifference>& found) {
    constexpr std::size_t kMost = 5;
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < std::min(found.size(), kMost); ++i) {
        lines.push_back(text_of(found[i]));
    }
    if (found.size() > kMost) {
        lines.push_back(fmt::format("and {} more; limpet px4-params writes what is expected",
                                    found.size() - kMost));
    }
    return lines;
}

ParameterCheck::ParameterCheck(std::vector<ExpectedParameter> expected) {
    rows_.reserve(expected.size());
    for (ExpectedParameter& each : expected) {
        rows_.push_back({.expected = std::move(each)});
    }
}

void ParameterCheck::hear(const ParamValue& message) {
    const std::string_view name = text_of(message.param_id);
    const auto row = std::find_if(rows_.begin(), rows_.end(),
                                  [&](const Row& each) { return each.expected.name == name; });
    if (row != rows_.end()) {
        row->value = parameter_value(message);
    }
}

bool ParameterCheck::settled(const Row& row, double time_s) const {
    return row.value || (row.requests >= kMostRequests && time_s - row.requested_s >= kAnswer_s);
}

bool ParameterCheck::done(double time_s) const {
    return std::all_of(rows_.begin(), rows_.end(),
                       [&](const Row& row) { return settled(row, time_s); });
}

void ParameterCheck::update(Link& link, std::uint8_t target_system, double time_s) {
    if (time_s - sent_s_ < kRequestInterval_s) {
        return;
    }
    sent_s_ = time_s;
    int sent = 0;
    for (Row& row : rows_) {
        if (sent == kRequestsAtOnce) {
            break;
        }
        if (row.value || row.requests >= kMostRequests || time_s - row.requested_s < kAnswer_s) {
            continue;
        }
        ++row.requests;
        row.requested_s = time_s;
        ++sent;
        ParamRequestRead request{.target_system = target_system,
                                 .target_component = kAutopilotComponent,
                                 .param_index = -1};
        set_text(request.param_id, row.expected.name);
        (void)link.send(request, kSendLimit);
    }
}

std::vector<ParameterDifference> ParameterCheck::differences(double time_s) const {
    const bool reports = std::any_of(rows_.begin(), rows_.end(),
                                     [](const Row& row) { return row.value.has_value(); });
    std::vector<ParameterDifference> found;
    for (const Row& row : rows_) {
        const bool missing = reports && !row.value && settled(row, time_s);
        if (missing || (row.value && !same_float(*row.value, row.expected.value))) {
            found.push_back({row.expected, row.value});
        }
    }
    return found;
}

}  // namespace limpet::mavlink
