// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "limpet/draw/chart.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/report/page.hpp"

/// A page with everything that a page may hold, and texts that mean harm.
namespace limpet::test {

inline const std::string kHostile =
    "<script>alert(1)</script> \"><img src=x onerror=alert(2)> & 'ü' {} \\ %s";
inline const std::string kLongWord =
    "Donaudampfschifffahrtselektrizitätenhauptbetriebswerkbauunterbeamtengesellschaft"
    "/really/long/path/that/never/seems/to/end_and_goes_on_and_on_and_on.mcap";

/// Draws into `folder`: success.png and .svg, growth.png and .svg.
inline void draw_samples(const std::filesystem::path& folder) {
    draw::ChartSeries fit{.name = "logistic fit", .colour = draw::colours::kOrange};
    draw::ChartSeries trials{.name = "trials",
                             .mark = draw::ChartSeries::Mark::points,
                             .colour = draw::colours::kDarkBlue};
    for (int i = 0; i <= 28; ++i) {
        const double v = 0.05 * i, p = 1.0 / (1.0 + std::exp(-8.0 * (v - 0.8)));
        fit.add(v, p);
        if (i % 2 == 1) {
            trials.add(v, p, {0.85 * p, 0.85 * p + 0.15});
        }
    }
    (void)draw::draw_chart(
        {.title = "Success against impact speed",
         .subtitle = "porous concrete; 95 % intervals",
         .panels = {draw::ChartPanel{.x_label = "impact speed  [m/s]",
                                     .y_label = "probability of success",
                                     .series = {fit, trials},
                                     .levels = {{0.5, "half"}},
                                     .moments = {{0.4, "none below"}, {1.0, "best"}}}}},
        "success", folder);
    draw::HeatPanel map{.x_label = "motor lag  [s]",
                        .y_label = "distance of the pivot  [m]",
                        .z_label = "growth rate  [1/s]",
                        .levels = {-1.0, 0.5},
                        .points = {{0.012, 0.2, "paper's simulation"}}};
    for (int i = 0; i <= 16; ++i) {
        map.x.push_back(0.006 * i);
        map.y.push_back(0.018 * i);
    }
    for (const double y : map.y) {
        for (const double x : map.x) {
            map.z.push_back(-1.2 + 20.0 * x * (0.4 + 2.0 * y));
        }
    }
    (void)draw::draw_chart({.title = "Stability map", .panels = {map}}, "growth", folder);
}

/// Its figures are those of draw_samples(), its recording lies at "flights/a b#1.mcap".
inline report::Page sample_page() {
    report::Page page;
    page.title = "Perching and take-off on vertical surfaces, reproduced";
    page.subtitle = "Every number, table and figure of the paper beside what was simulated";
    page.summary = {
        "Made by one command. **Verdicts are computed**, never typed in; where the "
        "paper contradicts itself the note says so. " +
        kHostile};
    for (int i = 0; i < 24; ++i) {
        report::Claim claim{
            .id = "c" + std::to_string(i + 1),
            .section = i % 3 == 0 ? "IV-B" : "Fig. 11",
            .statement =
                "The pressure in the cup falls below 880 hPa within half a second "
                "after the impact on porous concrete.",
            .paper = draw::Range{0.8, 1.4},
            .simulated = 1.26 + 0.01 * i,
            .unit = "s",
            .difference = std::string("within"),
            .verdict = static_cast<report::Verdict>(i % 3),
            .basis = i < 18 ? "measured" : "by construction",
            .same_as = i == 1 ? "c5" : "",
            .note = i % 2 == 0 ? "The range is **assumed**; the paper says `about 1 s`." : "",
            .figure = i % 4 == 0 ? "fig-success" : "",
            .recording = i % 5 == 0 ? "flights/a b#1.mcap" : ""};
        if (i == 3) {
            claim.paper = -0.0005;
            claim.difference = 0.031;
            claim.statement = kHostile;
            claim.note = kLongWord;
        }
        if (i == 4) {
            claim.paper = std::string("lets go at once");
            claim.simulated = std::string("detached within 0.25 s of the valve");
            claim.difference = std::string("none");
            claim.unit = "";
        }
        if (i == 20) {
            claim.verdict = report::Verdict::hangs_on_assumptions;
            claim.hangs_on = {"`vehicle.slider.damping_N_s_m` 20 % less: 1.6"};
            claim.turned = 288;
        }
        page.claims.push_back(claim);
    }
    report::PageTable table{
        .id = "table-2",
        .title = "Table II: surfaces",
        .columns = {"surface", "τ₁ paper [s]", "τ₁ fitted [s]", "P_vac paper [hPa]",
                    "P_vac fitted [hPa]", "τ₂ paper [s]", "τ₂ fitted [s]", "interval"},
        .caption = "Fitted to simulated measurements with noise, ripple and gaps."};
    for (const char* name : {"cinder block", "porous concrete", "metal", "glass"}) {
        table.rows.push_back({std::string(name), 0.21, 0.2103, 590.0, 589.6, 1.32, 1.318,
                              draw::Range{0.208, 0.2126}});
    }
    table.rows.push_back({kHostile, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, std::string("none")});
    const report::PageFigure success{
        .id = "fig-success",
        .title = "Fig. 3: success against impact speed.",
        .caption = "253 trials; the band is the fit's 95 % interval.",
        .alt = "Probability of success rising from 0 to 1 with impact speed",
        .png = "success.png",
        .svg = "success.svg"};
    page.sections = {
        {"claims", "Claims of the paper", {std::string("Line by line."), report::ClaimTable{}}},
        {"tables", "Tables I and II", {table, std::string("The paper calls concrete slowest.")}},
        {"figures", "Figures " + kLongWord, {success}}};
    for (int i = 0; i < 12; ++i) {
        report::PageFigure figure = success;
        figure.id = "fig-" + std::to_string(i);
        if (i % 2 == 0) {
            figure.png = "growth.png";
            figure.svg = i % 4 == 0 ? "growth.svg" : "";
            figure.alt = kHostile;
            figure.title = "Growth rate over motor lag and pivot.";
            figure.caption = kHostile + " " + kLongWord;
            figure.wide = true;
        }
        page.sections.back().blocks.push_back(figure);
    }
    page.environment = {{"version", std::string("0.1.0")},
                        {"seed", 7.0},
                        {"mode", std::string("quick")},
                        {"command", std::string("`limpet reproduce --quick --out out/reproduce`")},
                        {"folder", kLongWord}};
    return page;
}

}  // namespace limpet::test
