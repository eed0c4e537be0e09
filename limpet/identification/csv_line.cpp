// SPDX-License-Identifier: Apache-2.0
#include "limpet/identification/csv_line.hpp"

#include <algorithm>

#include "limpet/core/user_text.hpp"

namespace limpet::identification {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kLongestLine = 100'000;  ///< beyond it this is no log

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r";
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) {
        return {};
    }
    text = text.substr(first, text.find_last_not_of(kSpace) - first + 1);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
        text = text.substr(1, text.size() - 2);
    }
    return text;
}

}  // namespace

std::vector<std::string_view> csv_fields(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') {
            quoted = !quoted;
        }
        if (i == line.size() || (line[i] == separator && !quoted)) {
            fields.push_back(trimmed(line.substr(begin, i - begin)));
            begin = i + 1;
        }
    }
    return fields;
}

char separator_of(std::string_view header) {
    for (const char separator : {',', ';', '\t'}) {
        if (header.find(separator) != std::string_view::npos) {
            return separator;
        }
    }
    return ',';
}

std::optional<double> number_in(std::string_view field, char separator) {
    std::string text(field);
    if (separator == ';' && std::count(text.begin(), text.end(), ',') == 1) {
        std::replace(text.begin(), text.end(), ',', '.');
    }
    return decimal(text);
}

void for_each_csv_line(std::istream& text, const std::string& name,
                       const std::function<void(const CsvLine&)>& each) {
    std::string row;
    for (std::size_t number = 1; std::getline(text, row); ++number) {
        if (number == 1 && row.starts_with(kByteOrderMark)) {
            row.erase(0, kByteOrderMark.size());
        }
        const CsvLine line{row, name, number};
        if (row.find('\0') != std::string::npos || row.size() > kLongestLine) {
            line.refuse("not a text file of rows and columns");
        }
        const std::string_view content = trimmed(row);
        if (!content.empty() && content.front() != '#') {
            each(line);
        }
    }
    if (text.bad()) {
        throw InputError(name + ": cannot be read");
    }
}

}  // namespace limpet::identification
