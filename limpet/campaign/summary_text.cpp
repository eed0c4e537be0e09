// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "limpet/campaign/summary.hpp"

namespace limpet::campaign {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kBar = 20;

/// "  0.873  0.81..0.92    48 of 55"
std::string cells(const statistics::Proportion& p) {
    const statistics::Interval interval = p.interval();
    return fmt::format("{:6.3f}  {:.2f}..{:.2f}  {:>6} of {}", p.probability(), interval.low,
                       interval.high, p.successes, p.runs);
}

std::string bar(const statistics::Proportion& p) {
    const double probability = p.runs == 0 ? 0.0 : p.probability();
    const auto full = static_cast<std::size_t>(std::lround(probability * kBar));
    return std::string(full, '#') + std::string(kBar - full, '.');
}

/// "chi2 17.7 on 7, p 0.014: the runs do not follow it"
std::string goodness_text(const statistics::Goodness& good) {
    return fmt::format("chi2 {:.3g} on {}, p {:.2g}{}", good.chi2, good.degrees, good.p,
                       good.rejected() ? ": the runs do not follow it" : "");
}

/// "with a plateau: 0.80 (0.70..0.93) at most, half at 0.756 (0.70..0.82); chi2 ..."
std::string curve_text(const statistics::SuccessCurve& curve) {
    const std::string half = curve.half
                                 ? fmt::format("half at {:.3g} ({:.3g}..{:.3g})", *curve.half,
                                               curve.half_95.low, curve.half_95.high)
                                 : "half not reached";
    return fmt::format("with a plateau: {:.2f} ({:.2f}..{:.2f}) at most, {}; {}", curve.plateau,
                       curve.plateau_95.low, curve.plateau_95.high, half,
                       goodness_text(curve.goodness));
}

class Text {
public:
    template <class... Values>
    void line(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
        text_ += '\n';
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    std::string text_;
};

void add_endings(Text& text, const CampaignSummary& summary) {
    text.line("\noutcome           share  95 %        runs");
    for (const EndingCount& ending : summary.outcomes) {
        text.line("{:<16} {}", ending.outcome, cells(ending.proportion));
    }
    text.line("\nin truth          share  95 %        runs");
    for (const EndingCount& ending : summary.true_ends) {
        text.line("{:<16} {}", ending.outcome, cells(ending.proportion));
    }
    if (!summary.failures.empty()) {
        text.line("\nwhat went wrong");
        for (const EndingCount& ending : summary.failures) {
            text.line("{:>7}  {:<16} {}", ending.proportion.successes, ending.outcome,
                      ending.reason);
        }
    }
}

void add_key(Text& text, const KeySummary& key) {
    std::size_t width = 14;
    for (const Group& group : key.groups) {
        width = std::max(width, group.label.size());
    }
    text.line("\nsuccess against {}", key.key);
    for (const Group& group : key.groups) {
        if (group.proportion.runs > 0) {
            text.line("{:>{}}  {}  {}", group.label, width, bar(group.proportion),
                      cells(group.proportion));
        }
    }
    if (key.fit) {
        const statistics::LogisticFit& fit = *key.fit;
        text.line("logistic fit: half at {:.4g} +- {:.2g}, slope {:.4g} +- {:.2g} (95 %){}",
                  fit.half, statistics::kNormal95 * fit.half_error, fit.slope,
                  statistics::kNormal95 * fit.slope_error,
                  key.fit_goodness ? "; " + goodness_text(*key.fit_goodness) : "");
        if (key.curve && key.fit_rejected()) {
            text.line("{}", curve_text(*key.curve));
        }
    }
}

void add_metrics(Text& text, const std::vector<MetricSummary>& metrics) {
    if (metrics.empty()) {
        return;
    }
    text.line("\n{:<28} {:>10} {:>10} {:>10}  runs", "", "5 %", "median", "95 %");
    for (const MetricSummary& metric : metrics) {
        text.line("{:<28} {:>10.5g} {:>10.5g} {:>10.5g}  {}", metric.name, metric.p05,
                  metric.median, metric.p95, metric.runs);
    }
}

Json json_of(const statistics::Proportion& p) {
    const statistics::Interval interval = p.interval();
    return {{"successes", p.successes},
            {"runs", p.runs},
            {"probability", p.runs > 0 ? Json(p.probability()) : Json(nullptr)},
            {"low", interval.low},
            {"high", interval.high}};
}

Json json_of(const std::vector<EndingCount>& endings, bool with_reason) {
    Json list = Json::array();
    for (const EndingCount& ending : endings) {
        Json entry = {{"outcome", ending.outcome}};
        if (with_reason) {
            entry["reason"] = ending.reason;
        }
        const statistics::Interval interval = ending.proportion.interval();
        entry["runs"] = ending.proportion.successes;
        entry["probability"] = ending.proportion.probability();
        entry["low"] = interval.low;
        entry["high"] = interval.high;
        list.push_back(std::move(entry));
    }
    return list;
}

Json json_of(const statistics::Goodness& good) {
    return {{"chi2", good.chi2}, {"degrees_of_freedom", good.degrees}, {"p", good.p}};
}

Json json_of(const statistics::SuccessCurve& curve) {
    return {{"along", curve.along_logarithm ? "logarithm" : "value"},
            {"intercept", curve.intercept},
            {"slope", curve.slope},
            {"plateau", curve.plateau},
            {"plateau_low", curve.plateau_95.low},
            {"plateau_high", curve.plateau_95.high},
            {"half", curve.half ? Json(*curve.half) : Json(nullptr)},
            {"half_low", curve.half ? Json(curve.half_95.low) : Json(nullptr)},
            {"half_high", curve.half ? Json(curve.half_95.high) : Json(nullptr)},
            {"goodness", json_of(curve.goodness)}};
}

Json json_of(const KeySummary& key) {
    Json groups = Json::array();
    for (const Group& group : key.groups) {
        Json entry = key.named ? Json{{"value", group.label}}
                               : Json{{"from", group.low}, {"to", group.high}};
        entry.update(json_of(group.proportion));
        groups.push_back(std::move(entry));
    }
    Json fit = nullptr;
    if (key.fit) {
        fit = {{"intercept", key.fit->intercept},
               {"slope", key.fit->slope},
               {"slope_standard_error", key.fit->slope_error},
               {"half", key.fit->half},
               {"half_standard_error", key.fit->half_error},
               {"goodness", key.fit_goodness ? json_of(*key.fit_goodness) : Json(nullptr)}};
    }
    return {{"key", key.key},
            {"groups", groups},
            {"logistic", fit},
            {"plateau", key.curve ? json_of(*key.curve) : Json(nullptr)}};
}

}  // namespace

std::string summary_text(const CampaignSummary& summary) {
    Text text;
    text.line("{}", headline(summary.name, summary.description));
    text.line("{} of {} runs of {}, seed {}, limpet {}", summary.finished, summary.runs,
              summary.scenario, summary.seed, summary.version);
    for (const std::string& autopilot : summary.autopilots) {
        text.line("flown by {}", autopilot);
    }
    if (summary.finished == 0) {
        return text.take();
    }
    text.line("\nsuccess ({}): {}", fmt::join(summary.success_means, " or "),
              cells(summary.success));
    add_endings(text, summary);
    for (const KeySummary& key : summary.keys) {
        add_key(text, key);
    }
    add_metrics(text, summary.metrics);
    return text.take();
}

std::string summary_json(const CampaignSummary& summary) {
    Json keys = Json::array();
    for (const KeySummary& key : summary.keys) {
        keys.push_back(json_of(key));
    }
    Json metrics = Json::object();
    for (const MetricSummary& metric : summary.metrics) {
        metrics[metric.name] = {{"runs", metric.runs},
                                {"p05", metric.p05},
                                {"median", metric.median},
                                {"p95", metric.p95}};
    }
    const Json json = {{"campaign", summary.name},
                       {"description", summary.description},
                       {"scenario", summary.scenario},
                       {"limpet", summary.version},
                       {"flown_by", summary.autopilots},
                       {"seed", summary.seed},
                       {"runs", summary.runs},
                       {"finished", summary.finished},
                       {"success_means", summary.success_means},
                       {"success", json_of(summary.success)},
                       {"outcomes", json_of(summary.outcomes, false)},
                       {"true_ends", json_of(summary.true_ends, false)},
                       {"failures", json_of(summary.failures, true)},
                       {"keys", keys},
                       {"metrics", metrics}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace limpet::campaign
