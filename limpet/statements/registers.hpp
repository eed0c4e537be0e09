// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/assumptions/assumptions.hpp"
#include "limpet/statements/study.hpp"

/// The register of assumptions on a page: what a figure hangs on, and what would settle it.
namespace limpet::statements {

inline const std::vector<std::string> kMovedColumns = {
    "figure", "as it is", "hangs on", "set to", "change with 10 % more", "settled by"};
inline const std::vector<std::string> kSettledColumns = {"figure", "best settled by", "then by",
                                                         "flights that end otherwise"};

/// The five values that move a figure most, a row each; one row where none does.
/// @param name    of the rows: "release_s", "it perches"
/// @param figure  as assumptions::effect_of() takes it
[[nodiscard]] TableRows moved_rows(const std::string& name, std::string_view figure,
                                   const assumptions::Register& all);

/// The measurements that settle most of it, and the values that change how a flight ends.
[[nodiscard]] TableRows::value_type settled_row(const std::string& name, std::string_view figure,
                                                const assumptions::Register& all);

/// What README.md claims of a flight or a swing.
struct ReadmeClaim {
    std::string id;
    std::string says;
    std::string shown;  ///< the line of README.md that shows it
    std::string scenario;
    std::vector<std::string> set = {};  ///< as --set takes them
    std::string draws = {};             ///< campaign whose drawn keys each seed draws; empty: none
    std::string figure;                 ///< as assumptions::effect_of() takes it
    int seeds = 8;                      ///< flights of each value; --quick flies a quarter
};

/// A file like data/paper/readme.yaml, whose head describes its keys.
/// @throws InputError for what is not so
[[nodiscard]] std::vector<ReadmeClaim> load_readme_claims(const std::filesystem::path& file);
[[nodiscard]] std::filesystem::path readme_claims_file();

}  // namespace limpet::statements
