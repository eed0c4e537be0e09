// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limpet::scenario {

/// Smallest number of letters to insert, delete or replace (Levenshtein).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// What somebody who wrote `wrong` may have meant.
/// @return empty when nothing is near: more than about a third of the letters differ, and neither
///         begins with the other
[[nodiscard]] std::string_view nearest(std::string_view wrong,
                                       const std::vector<std::string_view>& names);

/// End of an error message: `, did you mean hold_s?` or `; there are a, b, c` when nothing is near.
/// @param names  what is allowed; with more than a handful `where` is shown in their place
/// @param where    where to find them, "`limpet params guidance` lists what there is"; may be empty
[[nodiscard]] std::string hint(std::string_view wrong, const std::vector<std::string_view>& names,
                               std::string_view where = {});

}  // namespace limpet::scenario
