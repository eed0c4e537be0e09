// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "limpet/report/page.hpp"

namespace limpet::report {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Quantity& quantity) {
    if (const auto* range = std::get_if<draw::Range>(&quantity)) {
        if (std::isfinite(range->low) && std::isfinite(range->high)) {
            return {{"low", range->low}, {"high", range->high}};
        }
    } else if (const auto* value = std::get_if<double>(&quantity)) {
        if (std::isfinite(*value)) {
            return *value;
        }
    }
    return to_text(quantity);
}

/// JSON has a value for what is not there.
Json or_null(const std::string& text) {
    return text.empty() ? Json() : Json(text);
}

Json json_of(const Claim& claim) {
    return {{"id", claim.id},
            {"section", claim.section},
            {"statement", claim.statement},
            {"paper", json_of(claim.paper)},
            {"simulated", json_of(claim.simulated)},
            {"unit", or_null(claim.unit)},
            {"difference", json_of(claim.difference)},
            {"verdict", to_text(claim.verdict)},
            {"accepted", or_null(claim.accepted)},
            {"basis", or_null(claim.basis)},
            {"assumes", claim.assumes},
            {"hangs_on", claim.hangs_on},
            {"turned", claim.turned},
            {"same_as", or_null(claim.same_as)},
            {"note", or_null(claim.note)},
            {"figure", or_null(claim.figure)},
            {"recording", or_null(claim.recording)}};
}

Json json_of(const PageTable& table) {
    Json rows = Json::array();
    for (const auto& row : table.rows) {
        Json cells = Json::array();
        for (const Quantity& cell : row) {
            cells.push_back(json_of(cell));
        }
        rows.push_back(cells);
    }
    Json json{{"id", table.id},
              {"title", table.title},
              {"caption", or_null(table.caption)},
              {"columns", table.columns},
              {"rows", rows}};
    if (!table.links.empty()) {
        json["links"] = table.links;
    }
    return json;
}

Json json_of(const PageFigure& figure) {
    return {{"id", figure.id},
            {"title", figure.title},
            {"caption", or_null(figure.caption)},
            {"alt", figure.alt},
            {"png", figure.png.generic_string()},
            {"svg", or_null(figure.svg.generic_string())}};
}

}  // namespace

std::string results_json(const Page& page) {
    check(page);
    Json claims = Json::array(), tables = Json::array(), figures = Json::array();
    for (const Claim& claim : page.claims) {
        claims.push_back(json_of(claim));
    }
    for (const PageSection& section : page.sections) {
        for (const PageBlock& block : section.blocks) {
            if (const auto* table = std::get_if<PageTable>(&block)) {
                tables.push_back(json_of(*table));
            } else if (const auto* figure = std::get_if<PageFigure>(&block)) {
                figures.push_back(json_of(*figure));
            }
        }
    }
    Json environment = Json::object();
    for (const auto& [key, value] : page.environment) {
        environment[key] = json_of(value);
    }
    const Json json = {
        {"claims", claims}, {"tables", tables}, {"figures", figures}, {"environment", environment}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace limpet::report
