// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/identification/propeller_file.hpp"
#include "limpet/scenario/catalogue.hpp"

namespace limpet::app {
namespace {

using Json = nlohmann::ordered_json;

struct RotorOptions {
    std::string file;
    std::string diameter;
    double density_kg_m3 = kAirDensity_kg_m3;
    std::optional<double> speed_rpm;
    bool json = false;
};

struct Finding {
    double diameter_m = 0.0;
    std::vector<identification::PropellerRow> rows;
    std::vector<identification::RotorConstants> constants;  ///< of each row
    identification::RotorConstants chosen;
};

/// @throws InputError that names the diameter and the file
void check(const RotorOptions& options, const Finding& found) {
    try {
        require_usable(found.chosen);
    } catch (const InputError& error) {
        throw InputError(fmt::format("--diameter {}: with {} {}", in_quotes(options.diameter),
                                     options.file, error.what()));
    }
}

Finding find(const RotorOptions& options) {
    if (!(options.density_kg_m3 >= 0.01 && options.density_kg_m3 <= 10.0)) {
        throw InputError(fmt::format("--density {:g}: is out of range, allowed 0.01..10 kg/m3",
                                     options.density_kg_m3));
    }
    Finding found;
    found.diameter_m = identification::length_m(options.diameter, "--diameter");
    found.rows = identification::read_propeller_file(scenario::find_sample(options.file, ".txt"));
    for (const identification::PropellerRow& row : found.rows) {
        found.constants.push_back(rotor_constants(row, found.diameter_m, options.density_kg_m3));
    }
    if (!options.speed_rpm) {
        found.chosen = fitted_constants(found.rows, found.diameter_m, options.density_kg_m3);
        return found;
    }
    try {
        found.chosen = rotor_constants(row_at(found.rows, *options.speed_rpm), found.diameter_m,
                                       options.density_kg_m3);
    } catch (const InputError& error) {
        throw InputError(fmt::format("--rpm: {}: {}", options.file, error.what()));
    }
    return found;
}

std::string how(const RotorOptions& options) {
    return options.speed_rpm ? fmt::format("at {:g} rpm", *options.speed_rpm)
                             : "least squares over all rows";
}

/// Ends of a constant over the rows, and how far they are off the one that is chosen.
std::string spread(const Finding& found, double identification::RotorConstants::*field) {
    const auto [least, most] =
        std::minmax_element(found.constants.begin(), found.constants.end(),
                            [field](const auto& a, const auto& b) { return a.*field < b.*field; });
    const double low = (*least).*field;
    const double high = (*most).*field;
    const double chosen = found.chosen.*field;
    return fmt::format("rows {:.4g} .. {:.4g}, {:+.1f} .. {:+.1f} %", low, high,
                       100.0 * (low / chosen - 1.0), 100.0 * (high / chosen - 1.0));
}

void print_text(const RotorOptions& options, const Finding& found) {
    fmt::print("{:>9}  {:>8}  {:>8}  {:>12}  {:>9}\n", "rpm", "C_T", "C_P", "k_mot kg m",
               "k_mom m");
    for (std::size_t i = 0; i < found.rows.size(); ++i) {
        const identification::PropellerRow& row = found.rows[i];
        fmt::print("{:9.1f}  {:8.5f}  {:8.5f}  {:12.4e}  {:9.5f}\n", row.speed_rpm,
                   row.thrust_coefficient, row.power_coefficient,
                   found.constants[i].motor_constant_kg_m, found.constants[i].moment_constant_m);
    }
    using K = identification::RotorConstants;
    fmt::print(
        "\nD {:g} m, rho {:g} kg/m3, eqs. (3) and (4), {}:\n"
        "  motor_constant_kg_m: {:.4e}   # {}\n"
        "  moment_constant_m: {:.4e}     # {}\n"
        "as the section `rotor` of a vehicle takes them\n",
        found.diameter_m, options.density_kg_m3, how(options), found.chosen.motor_constant_kg_m,
        spread(found, &K::motor_constant_kg_m), found.chosen.moment_constant_m,
        spread(found, &K::moment_constant_m));
}

Json json_of(const identification::RotorConstants& constants) {
    return {{"motor_constant_kg_m", constants.motor_constant_kg_m},
            {"moment_constant_m", constants.moment_constant_m}};
}

void print_json(const RotorOptions& options, const Finding& found) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < found.rows.size(); ++i) {
        Json row = {{"speed_rpm", found.rows[i].speed_rpm},
                    {"thrust_coefficient", found.rows[i].thrust_coefficient},
                    {"power_coefficient", found.rows[i].power_coefficient}};
        row.update(json_of(found.constants[i]));
        rows.push_back(row);
    }
    const Json json = {{"file", options.file},
                       {"diameter_m", found.diameter_m},
                       {"density_kg_m3", options.density_kg_m3},
                       {"how", how(options)},
                       {"rotor", json_of(found.chosen)},
                       {"rows", rows}};
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

OptionList options_of(RotorOptions& options) {
    return {{"file TXT", &options.file,
             "UIUC static file: columns RPM, CT, CP; or the name of a sample\n"
             "(limpet list samples)"},
            {"--diameter LENGTH", &options.diameter, "of the propeller, with its unit: 12in, 305mm",
             required()},
            {"--density RHO", &options.density_kg_m3, "of the air in the result, 1.225 kg/m3"},
            {"--rpm R", &options.speed_rpm,
             "take the coefficients at this speed, as at hover; else a fit over\n"
             "all rows, in which a row counts with the fourth power of its speed"},
            {"--json", &options.json, "one JSON object on standard output"}};
}

void work_out(const RotorOptions& options) {
    const Finding found = find(options);
    check(options, found);
    options.json ? print_json(options, found) : print_text(options, found);
}

}  // namespace

Verb rotor_verb() {
    return verb<RotorOptions>("rotor",
                              "Work out a rotor's constants from a propeller's static measurement",
                              options_of, work_out,
                              "Example:\n"
                              "  limpet rotor apce_12x5.5_static.txt --diameter 12in --rpm 5350\n"
                              "Files: m-selig.ae.illinois.edu/props/propDB.html\n");
}

}  // namespace limpet::app
