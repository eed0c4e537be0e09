// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet {

/// A registry: types that offer the same, in order.
template <class... Types>
struct TypeList {};

/// Stands for a type where a value is wanted.
template <class T>
struct Type {
    using type = T;
};

/// Calls `visit(Type<T>{})` for each type, in the list's order.
template <class... Types, class Visit>
constexpr void for_each_type(TypeList<Types...> /*list*/, Visit&& visit) {
    (visit(Type<Types>{}), ...);
}

/// Parameters of all types of a registry side by side, so that a scenario holds them whichever it
/// uses. No two may have a name in common.
template <class List>
struct ParametersOf;
template <class... Types>
struct ParametersOf<TypeList<Types...>> : Types::Parameters... {};

}  // namespace limpet
