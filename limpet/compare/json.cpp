// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "limpet/compare/text.hpp"

namespace limpet {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json or_null(const std::string& text) {
    return text.empty() ? Json() : Json(text);
}

Json json_of(const FlightIdentity& flight) {
    return {{"label", flight.label},
            {"recording", flight.path},
            {"scenario", or_null(flight.summary.scenario)},
            {"seed", or_null(flight.summary.seed)},
            {"outcome", or_null(flight.summary.outcome)},
            {"reason", or_null(flight.summary.reason)},
            {"from_s", flight.from_s},
            {"to_s", flight.to_s}};
}

Json json_of(const Extremes& extremes) {
    return {{"lowest", or_null(extremes.lowest)}, {"highest", or_null(extremes.highest)}};
}

Json json_of(const ChannelDifference& channel) {
    const bool any = channel.samples > 0;
    return {{"name", channel.name},
            {"unit", or_null(channel.unit)},
            {"largest", any ? Json(channel.largest) : Json()},
            {"at_s", any ? Json(channel.at_s) : Json()},
            {"phase", or_null(channel.phase)},
            {"rms", any ? Json(channel.rms) : Json()},
            {"samples", channel.samples},
            {"reference", json_of(channel.reference)},
            {"other", json_of(channel.other)}};
}

Json events_json(const FlightComparison& comparison) {
    Json events = Json::array();
    for (const EventPair& event : comparison.events) {
        events.push_back({{"name", event.name},
                          {"occurrence", event.occurrence},
                          {"reference_s", or_null(event.reference_s)},
                          {"other_s", or_null(event.other_s)},
                          {"difference_s", or_null(comparison.event_difference_s(event))}});
    }
    return events;
}

Json pieces_json(const FlightComparison& comparison) {
    Json pieces = Json::array();
    for (const Piece& piece : comparison.pieces) {
        pieces.push_back({{"from", piece.from},
                          {"from_s", piece.window.from_s},
                          {"to_s", piece.window.to_s},
                          {"shift_s", piece.shift_s},
                          {"reference_left_out_s", piece.reference_left_out_s},
                          {"other_left_out_s", piece.other_left_out_s}});
    }
    return pieces;
}

Json json_of(const FlightComparison& comparison) {
    Json figures = Json::array();
    for (const FlightFigure& figure : comparison.figures) {
        figures.push_back({{"name", figure.name},
                           {"reference", or_null(figure.reference)},
                           {"other", or_null(figure.other)},
                           {"difference", or_null(figure.other - figure.reference)}});
    }
    Json contacts = Json::array();
    for (const ContactDifference& contact : comparison.contacts) {
        contacts.push_back({{"stage", contact.sealing ? "sealing" : "unsealing"},
                            {"reference_from_s", contact.reference_from_s},
                            {"other_from_s", contact.other_from_s},
                            {"span_s", contact.span_s},
                            {"shift_s", contact.shift_s},
                            {"largest_hPa", contact.largest_hPa},
                            {"rms_hPa", contact.rms_hPa}});
    }
    Json channels = Json::array();
    for (const ChannelDifference& channel : comparison.channels) {
        channels.push_back(json_of(channel));
    }
    return {
        {"flight", json_of(comparison.other)},
        {"outcome_alike", comparison.reference.summary.outcome == comparison.other.summary.outcome},
        {"events", events_json(comparison)},
        {"pieces", pieces_json(comparison)},
        {"figures", figures},
        {"contacts", contacts},
        {"channels", channels},
        {"only_in_reference", comparison.only_in_reference},
        {"only_in_other", comparison.only_in_other}};
}

}  // namespace

std::string comparison_json(const std::vector<FlightComparison>& comparisons,
                            const std::vector<Excess>& checked) {
    Json others = Json::array();
    for (const FlightComparison& comparison : comparisons) {
        others.push_back(json_of(comparison));
    }
    Json limits = Json::array();
    for (const Excess& check : checked) {
        limits.push_back({{"name", check.limit.name},
                          {"most", check.limit.most},
                          {"measured", or_null(check.measured)},
                          {"flight", check.other},
                          {"where", or_null(check.where)},
                          {"exceeded", check.exceeded()}});
    }
    const Json all = {{"reference", json_of(comparisons.front().reference)},
                      {"others", others},
                      {"limits", limits}};
    return all.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace limpet
