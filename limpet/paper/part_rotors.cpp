// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "limpet/identification/rotor_bench.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/parts.hpp"

namespace limpet::paper {
namespace {

constexpr std::array kVehicles = {"perching_uav", "iris"};  ///< columns of Table I

/// What the rows of Table I are.
struct Constants {
    double motor_kg_m = 0.0, moment_m = 0.0, drag_kg = 0.0;
};
struct Row {
    const char* evidence;
    const char* name;
    double Constants::*value;
};
constexpr std::array<Row, 3> kRows = {{
    {"motor_constant_kg_m", "k_mot, kg m", &Constants::motor_kg_m},
    {"moment_constant_m", "k_mom, m", &Constants::moment_m},
    {"drag_constant_kg", "lambda_1, kg", &Constants::drag_kg},
}};

std::string evidence_of(const char* vehicle, const Row& row) {
    return fmt::format("rotor.{}.{}", vehicle, row.evidence);
}

/// A vehicle's rotor, measured.
struct Bench {
    vehicle::RotorParameters rotor = {};
    std::vector<identification::ThrustStandRow> stand = {};
    Constants used = {};
    Constants recovered = {};
};

constexpr double kAir_kg_m3 = 1.225;  ///< sea level; it cancels out of eqs. (3), (4)

/// Weighs a rotor as the paper's source did, and takes eqs. (3), (4) of it.
Bench weighed(const char* vehicle) {
    Bench bench{.rotor = scenario::load_vehicle(vehicle, scenario::data_root()).rotor};
    const vehicle::RotorParameters& rotor = bench.rotor;
    bench.used = {rotor.motor_constant_kg_m, rotor.moment_constant_m, rotor.drag_constant_kg};
    const double highest_rpm = rotor.speed_max_rad_s * 60.0 / (2.0 * kPi);
    std::vector<double> speeds_rpm;
    constexpr int kSpeeds = 12;
    for (int i = 3; i <= kSpeeds; ++i) {
        speeds_rpm.push_back(highest_rpm * i / kSpeeds);
    }
    bench.stand = identification::static_thrust_stand(rotor, speeds_rpm);
    std::vector<identification::PropellerRow> rows;
    for (const identification::ThrustStandRow& row : bench.stand) {
        rows.push_back(row.coefficients);
    }
    const auto constants = fitted_constants(rows, 2.0 * rotor.radius_m, kAir_kg_m3);
    const auto tunnel =
        identification::cross_wind_tunnel(rotor, 0.7 * highest_rpm, {1.0, 2.0, 4.0, 8.0});
    bench.recovered = {constants.motor_constant_kg_m, constants.moment_constant_m,
                       tunnel.drag_constant_kg};
    return bench;
}

void study_rotors(Study& study) {
    draw::ChartPanel thrust{.x_label = "rotor speed  [rad/s]",
                            .y_label = "thrust of one rotor  [N]"};
    TableRows table;
    for (const char* vehicle : kVehicles) {
        const Bench bench = weighed(vehicle);
        draw::ChartSeries points{.name = fmt::format("{}, weighed", vehicle),
                                 .mark = draw::ChartSeries::Mark::points};
        for (const identification::ThrustStandRow& row : bench.stand) {
            points.add(row.speed_rad_s, row.thrust_N);
        }
        draw::ChartSeries curve{.name = fmt::format("{}, paper's k_mot w²", vehicle)};
        const double k_mot = study.stated(evidence_of(vehicle, kRows[0])).first;
        curve.add({0.0, bench.rotor.speed_max_rad_s}, 60,
                  [k_mot](double w) { return k_mot * w * w; });
        thrust.series.insert(thrust.series.end(), {points, curve});
        for (const Row& row : kRows) {
            const std::string evidence = evidence_of(vehicle, row);
            study.evidence.set(evidence, bench.recovered.*row.value);
            const auto text = [](double value) { return fmt::format("{:.3g}", value); };
            table.push_back({row.name, vehicle, text(study.stated(evidence).first),
                             text(bench.used.*row.value), text(bench.recovered.*row.value)});
        }
    }
    study.draw("fig-thrust", {.panels = {thrust}});
    study.table("table1", table);
}

}  // namespace

StudyPart rotors_part() {
    StudyPart part{"rotors", "Rotors: Table I", study_rotors, {}, {"fig-thrust", "table1"}};
    for (const char* vehicle : kVehicles) {
        for (const Row& row : kRows) {
            part.measures.push_back(evidence_of(vehicle, row));
        }
    }
    return part;
}

}  // namespace limpet::paper
