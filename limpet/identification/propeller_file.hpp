// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// From a propeller's static measurement to the motor model's constants, as the paper's Table I was
/// made: eqs. (3) and (4) on a file of the UIUC propeller database.
namespace limpet::identification {

/// One line of the file; n is in revolutions per second, T = C_T rho n^2 D^4, P = C_P rho n^3 D^5.
struct PropellerRow {
    double speed_rpm = 0.0;
    double thrust_coefficient = 0.0;  ///< C_T
    double power_coefficient = 0.0;   ///< C_P = 2 pi C_Q
};

/// Reads a UIUC static file: a header with the names RPM, CT and CP, then rows of numbers, all
/// separated by blanks or tabs, or as its header has it by commas or semicolons; a byte order mark
/// may stand before it. Other columns are passed over, empty lines and lines that begin with # too.
/// @return rows in the file's order, at least one; all numbers > 0
/// @throws InputError one line that names file:line
[[nodiscard]] std::vector<PropellerRow> read_propeller_file(const std::filesystem::path& path);

/// @return whether its first line is such a header
[[nodiscard]] bool is_propeller_file(const std::filesystem::path& path);

/// @param text  a number and in, cm, mm or m: "12in", "30.5 cm"
/// @param what  begins the complaint: "--diameter"
/// @return [m], 1 mm to 10 m
/// @throws InputError also for a bare number: 12 may be anything
[[nodiscard]] double length_m(std::string_view text, std::string_view what);

/// Constants of the motor model.
struct RotorConstants {
    double motor_constant_kg_m = 0.0;  ///< k_mot, eq. (3)
    double moment_constant_m = 0.0;    ///< k_mom, eq. (4)
};
[[nodiscard]] RotorConstants rotor_constants(const PropellerRow& row, double diameter_m,
                                             double density_kg_m3);

/// @throws InputError for constants that no vehicle file takes, as of a propeller of 0.1 mm
void require_usable(const RotorConstants& constants);

/// The constants that fit all rows: T = k_mot w^2 and Q = k_mom T by least squares, so that a row
/// counts with the fourth power of its speed. Slow rows, where small blades are worse and balances
/// too, hardly count.
/// @param rows  at least one
[[nodiscard]] RotorConstants fitted_constants(const std::vector<PropellerRow>& rows,
                                              double diameter_m, double density_kg_m3);

/// The coefficients at one speed, linear between the neighbouring rows.
/// @throws InputError when the speed is not between the slowest and the fastest row
[[nodiscard]] PropellerRow row_at(std::vector<PropellerRow> rows, double speed_rpm);

}  // namespace limpet::identification
