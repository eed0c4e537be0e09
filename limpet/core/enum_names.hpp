// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "limpet/core/errors.hpp"

// Enumerators by the names that they have in the code, which recordings, scenarios and results take
// over. magic_enum does the same; Debian 11, on which Gazebo's plugins are built, has none.
namespace limpet {

/// How the compiler writes a value: `limpet::Outcome::crashed`; `(limpet::Outcome)6` for one that
/// no enumerator has.
template <auto kValue>
[[nodiscard]] constexpr std::string_view compilers_text() {
    constexpr std::string_view kText = __PRETTY_FUNCTION__;
    constexpr std::size_t kBegin = kText.find("kValue = ") + 9;
    return kText.substr(kBegin, kText.find_first_of(";]", kBegin) - kBegin);
}

/// As many as there are from 0 on without a gap.
template <class Enum, std::size_t kFound = 0>
[[nodiscard]] consteval std::size_t enumerator_count() {
    if constexpr (compilers_text<static_cast<Enum>(kFound)>().front() == '(') {
        return kFound;
    } else {
        return enumerator_count<Enum, kFound + 1>();
    }
}

template <class Enum, std::size_t... kIndex>
[[nodiscard]] constexpr auto enumerator_names(std::index_sequence<kIndex...> /*all*/) {
    std::array names = {compilers_text<static_cast<Enum>(kIndex)>()...};
    for (std::string_view& name : names) {
        name.remove_prefix(name.rfind(':') + 1);
    }
    return names;
}

/// Of an enum that counts from 0, in its order.
template <class Enum>
inline constexpr auto kNamesOf =
    enumerator_names<Enum>(std::make_index_sequence<enumerator_count<Enum>()>{});

/// @throws InternalError for a value that no enumerator has
template <class Enum>
[[nodiscard]] std::string_view name_of(Enum value) {
    const auto index = static_cast<std::size_t>(value);
    require(index < kNamesOf<Enum>.size(), "an enum holds one of its enumerators");
    return kNamesOf<Enum>[index];
}

/// @return nullopt for a name that is none
template <class Enum>
[[nodiscard]] std::optional<Enum> enumerator_of(std::string_view name) {
    constexpr auto& kNames = kNamesOf<Enum>;
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    return found == kNames.end() ? std::nullopt
                                 : std::optional(static_cast<Enum>(found - kNames.begin()));
}

}  // namespace limpet
