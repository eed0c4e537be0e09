// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"

namespace limpet::identification {

/// Text of a user's, with the line that it stands in.
struct CsvLine {
    std::string_view text;
    const std::string& file;
    std::size_t number = 0;

    template <class... Args>
    [[noreturn]] void refuse(fmt::format_string<const Args&...> what, const Args&... args) const {
        throw InputError(fmt::format("{}:{}: {}", file, number, fmt::format(what, args...)));
    }
};

/// Fields between separators, without blanks and quotes around them; separators inside quotes
/// belong to their field.
[[nodiscard]] std::vector<std::string_view> csv_fields(std::string_view line, char separator = ',');

/// What parts the columns of a log: a comma, else a semicolon, else a tab, whichever its header
/// has; a comma where it has none.
[[nodiscard]] char separator_of(std::string_view header);

/// A number in a field; between semicolons its point may be a comma.
/// @return nothing where it is none, or not finite
[[nodiscard]] std::optional<double> number_in(std::string_view field, char separator);

/// Every line with something in it, in turn; blank ones and those that begin with '#' are passed
/// over, a byte order mark too.
/// @param name  of the file, for errors
/// @throws InputError for what is no text of lines, or cannot be read
void for_each_csv_line(std::istream& text, const std::string& name,
                       const std::function<void(const CsvLine&)>& each);

}  // namespace limpet::identification
