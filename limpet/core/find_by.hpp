// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace limpet {

/// @param name  the member that is compared
/// @return the first that is called so, nullptr if there is none
template <class T>
[[nodiscard]] const T* find_by(const std::vector<T>& all, std::string T::*name,
                               std::string_view wanted) {
    const auto found = std::ranges::find(all, wanted, name);
    return found == all.end() ? nullptr : &*found;
}

}  // namespace limpet
