// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "limpet/compare/report.hpp"

namespace limpet::compare {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has a value for what is not there; numbers that are none become it by themselves.
Json or_null(const std::string& text) {
    return text.empty() ? Json() : Json(text);
}

}  // namespace

// Found by nlohmann::json, vectors of them too.

static void to_json(Json& json, const FlightIdentity& flight) {
    json = {{"label", flight.label},
            {"recording", flight.path},
            {"scenario", or_null(flight.summary.scenario)},
            {"seed", or_null(flight.summary.seed)},
            {"outcome", or_null(flight.summary.outcome)},
            {"reason", or_null(flight.summary.reason)},
            {"from_s", flight.from_s},
            {"to_s", flight.to_s}};
}

static void to_json(Json& json, const Extremes& extremes) {
    json = {{"lowest", extremes.lowest}, {"highest", extremes.highest}};
}

static void to_json(Json& json, const ChannelDifference& channel) {
    const bool any = channel.samples > 0;
    json = {{"name", channel.name},
            {"unit", or_null(channel.unit)},
            {"largest", any ? Json(channel.largest) : Json()},
            {"at_s", any ? Json(channel.at_s) : Json()},
            {"phase", or_null(channel.phase)},
            {"rms", any ? Json(channel.rms) : Json()},
            {"samples", channel.samples},
            {"reference", channel.reference},
            {"other", channel.other}};
}

static void to_json(Json& json, const Piece& piece) {
    json = {{"from", piece.from},
            {"from_s", piece.window.from_s},
            {"to_s", piece.window.to_s},
            {"shift_s", piece.shift_s},
            {"reference_left_out_s", piece.reference_left_out_s},
            {"other_left_out_s", piece.other_left_out_s}};
}

static void to_json(Json& json, const FlightFigure& figure) {
    json = {{"name", figure.name},
            {"reference", figure.reference},
            {"other", figure.other},
            {"difference", figure.other - figure.reference}};
}

static void to_json(Json& json, const ContactDifference& contact) {
    json = {{"stage", contact.sealing ? "sealing" : "unsealing"},
            {"reference_from_s", contact.reference_from_s},
            {"other_from_s", contact.other_from_s},
            {"span_s", contact.span_s},
            {"shift_s", contact.shift_s},
            {"largest_hPa", contact.largest_hPa},
            {"rms_hPa", contact.rms_hPa}};
}

static void to_json(Json& json, const Excess& check) {
    json = {{"name", check.limit.name},      {"most", check.limit.most},
            {"measured", check.measured},    {"flight", check.other},
            {"where", or_null(check.where)}, {"exceeded", check.exceeded()}};
}

static void to_json(Json& json, const FlightComparison& comparison) {
    Json events = Json::array();
    for (const EventPair& event : comparison.events) {
        events.push_back({{"name", event.name},
                          {"occurrence", event.occurrence},
                          {"reference_s", event.reference_s},
                          {"other_s", event.other_s},
                          {"difference_s", comparison.event_difference_s(event)}});
    }
    json = {
        {"flight", comparison.other},
        {"outcome_alike", comparison.reference.summary.outcome == comparison.other.summary.outcome},
        {"events", events},
        {"pieces", comparison.pieces},
        {"figures", comparison.figures},
        {"contacts", comparison.contacts},
        {"channels", comparison.channels},
        {"only_in_reference", comparison.only_in_reference},
        {"only_in_other", comparison.only_in_other}};
}

std::string comparison_json(const std::vector<FlightComparison>& comparisons,
                            const std::vector<Excess>& checked) {
    const Json all = {
        {"reference", comparisons.front().reference}, {"others", comparisons}, {"limits", checked}};
    return all.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace limpet::compare
