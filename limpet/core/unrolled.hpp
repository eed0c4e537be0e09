// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>
#include <utility>

namespace limpet {

template <class Each, int... kAt>
[[gnu::always_inline]] constexpr void unrolled(std::integer_sequence<int, kAt...> /*at*/,
                                               Each&& each) {
    (each(std::integral_constant<int, kAt>{}), ...);
}
/// Calls each(0), each(1), ... with constants, so that all that depends on them is worked out by
/// the compiler and the loop is gone: small matrices are half of a flight's instructions. Write
/// `[&](auto i) [[gnu::always_inline]] { ... i.value ... }`.
template <int kEnd, class Each>
[[gnu::always_inline]] constexpr void unrolled(Each&& each) {
    unrolled(std::make_integer_sequence<int, kEnd>{}, each);
}

}  // namespace limpet
