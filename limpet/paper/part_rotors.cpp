// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "limpet/identification/rotor_bench.hpp"
#include "limpet/paper/paper_tables.hpp"
#include "limpet/paper/study.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/parts.hpp"

namespace limpet::paper {
namespace {

/// A vehicle's rotor, measured.
struct Bench {
    TableOne paper = {};
    vehicle::RotorParameters used = {};
    std::vector<identification::ThrustStandRow> stand = {};
    identification::RotorConstants constants = {};
    identification::CrossWindResult tunnel = {};
};

constexpr double kAir_kg_m3 = 1.225;  ///< sea level; it cancels out of eqs. (3), (4)

/// Weighs a rotor as the paper's source did, and takes eqs. (3), (4) of it.
void weigh(Bench& bench) {
    bench.used = scenario::load_vehicle(bench.paper.vehicle, scenario::data_root()).rotor;
    const double highest_rpm = bench.used.speed_max_rad_s * 60.0 / (2.0 * kPi);
    std::vector<double> speeds_rpm;
    constexpr int kSpeeds = 12;
    for (int i = 3; i <= kSpeeds; ++i) {
        speeds_rpm.push_back(highest_rpm * i / kSpeeds);
    }
    bench.stand = identification::static_thrust_stand(bench.used, speeds_rpm);
    std::vector<identification::PropellerRow> rows;
    for (const identification::ThrustStandRow& row : bench.stand) {
        rows.push_back(row.coefficients);
    }
    bench.constants = fitted_constants(rows, 2.0 * bench.used.radius_m, kAir_kg_m3);
    bench.tunnel =
        identification::cross_wind_tunnel(bench.used, 0.7 * highest_rpm, {1.0, 2.0, 4.0, 8.0});
}

report::PageFigure thrust_figure(const std::array<Bench, 2>& benches, const Study& study) {
    draw::ChartPanel thrust{.x_label = "rotor speed  [rad/s]",
                            .y_label = "thrust of one rotor  [N]"};
    for (const Bench& bench : benches) {
        draw::ChartSeries points{.name = std::string(bench.paper.vehicle) + ", weighed",
                                 .mark = draw::ChartSeries::Mark::points};
        draw::ChartSeries curve{.name = std::string(bench.paper.vehicle) + ", paper's k_mot w²"};
        for (const identification::ThrustStandRow& row : bench.stand) {
            points.x.push_back(row.speed_rad_s);
            points.y.push_back(row.thrust_N);
        }
        constexpr int kPoints = 60;
        for (int i = 0; i <= kPoints; ++i) {
            const double w = bench.used.speed_max_rad_s * i / kPoints;
            curve.x.push_back(w);
            curve.y.push_back(bench.paper.motor_constant_kg_m * w * w);
        }
        thrust.series.push_back(std::move(points));
        thrust.series.push_back(std::move(curve));
    }
    return study.figure(
        {.title = "Thrust on the simulated stand", .panels = {thrust}}, "fig-thrust",
        "Each rotor is commanded, spins up and is weighed; the lines are the paper's constants.",
        "Thrust over rotor speed for both vehicles, points on the lines of Table I");
}

report::PageTable table_one(const std::array<Bench, 2>& benches) {
    report::PageTable table{.id = "table1",
                            .title = "Table I: used, and recovered from simulated measurements",
                            .columns = {"quantity", "vehicle", "paper", "used", "recovered"},
                            .caption =
                                "k_mot and k_mom by eqs. (3), (4) from C_T and C_P of the static "
                                "stand, as `limpet rotor` does from a UIUC file; lambda_1 from the "
                                "drag in a cross wind."};
    const auto text = [](double value) { return fmt::format("{:.3g}", value); };
    for (const Bench& bench : benches) {
        const std::string vehicle = bench.paper.vehicle;
        table.rows.push_back(
            {std::string("k_mot, kg m"), vehicle, text(bench.paper.motor_constant_kg_m),
             text(bench.used.motor_constant_kg_m), text(bench.constants.motor_constant_kg_m)});
        table.rows.push_back({std::string("k_mom, m"), vehicle, text(bench.paper.moment_constant_m),
                              text(bench.used.moment_constant_m),
                              text(bench.constants.moment_constant_m)});
        table.rows.push_back({std::string("lambda_1, kg"), vehicle,
                              text(bench.paper.drag_constant_kg), text(bench.used.drag_constant_kg),
                              text(bench.tunnel.drag_constant_kg)});
    }
    return table;
}

void study_rotors(Study& study) {
    std::array<Bench, 2> benches;
    for (std::size_t i = 0; i < benches.size(); ++i) {
        Bench& bench = benches[i];
        bench.paper = kTableOne[i];
        weigh(bench);
        const std::string key = std::string("rotor.") + bench.paper.vehicle;
        study.evidence.set(key + ".motor_constant_kg_m", bench.constants.motor_constant_kg_m);
        study.evidence.set(key + ".moment_constant_m", bench.constants.moment_constant_m);
        study.evidence.set(key + ".drag_constant_kg", bench.tunnel.drag_constant_kg);
    }
    report::PageSection section{.id = "part-rotors"};
    section.blocks.emplace_back(
        "The rotor model's constants, measured on the model as it flies: a static thrust stand and "
        "a cross wind.");
    section.blocks.emplace_back(thrust_figure(benches, study));
    section.blocks.emplace_back(table_one(benches));
    study.sections.push_back(std::move(section));
}

}  // namespace

StudyPart rotors_part() {
    StudyPart part{"rotors", "Rotors: Table I", study_rotors, {}};
    for (const TableOne& column : kTableOne) {
        for (const char* constant :
             {"motor_constant_kg_m", "moment_constant_m", "drag_constant_kg"}) {
            part.measures.push_back(fmt::format("rotor.{}.{}", column.vehicle, constant));
        }
    }
    return part;
}

}  // namespace limpet::paper
