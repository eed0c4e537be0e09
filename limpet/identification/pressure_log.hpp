// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "limpet/identification/pressure_curve.hpp"

namespace limpet::identification {

/// Reads a log of pressure as CSV: a header that names `t_s` and `pressure_Pa` among any other
/// columns in any order (`time_s` and `fluid_pressure_Pa` will do, so that `limpet csv` writes such
/// logs), then a row a sample. Blank lines and lines that begin with '#' are passed
/// over; columns are parted by commas, or as the header has it by semicolons (whose numbers may
/// have a comma for their point) or tabs; what `rostopic echo -p` writes is taken, too; lines end
/// in "\n" or "\r\n"; fields may stand in quotes. Times of a clock are counted from the first
/// sample.
/// @param name  of the file, for errors
/// @throws InputError with name:line: a column that is not there, a cell that is no finite number,
///         a negative pressure, a time that does not rise, no samples, no text
[[nodiscard]] PressureTrace read_pressure_log(std::istream& text, const std::string& name);

/// The same from a file.
/// @throws InputError also when it cannot be read
[[nodiscard]] PressureTrace read_pressure_log(const std::filesystem::path& path);

}  // namespace limpet::identification
