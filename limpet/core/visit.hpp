// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "limpet/core/frames.hpp"
#include "limpet/core/members.hpp"

// The one walk over a state. visit_leaves() goes through plain structs member by member, in the
// order of their declaration, down to the numbers, enums and bools: what is made of it (bytes, a
// digest, a linearisation: limpet/simulation/snapshot.hpp) names no member and forgets none. A
// struct needs nothing for it. A class with private data, or a ring whose places wander, says
//
//   template <class Self, class Each>
//   static void visit_members(Self& self, Each&& each) { each(self.first_, self.second_); }
//
// A pointer or a view in a state does not compile: it would mean nothing in another process.
namespace limpet {

/// Whether T is of a template: an optional, a variant, a vector.
template <class T, template <class...> class Of>
inline constexpr bool kIsA = false;
template <class... T, template <class...> class Of>
inline constexpr bool kIsA<Of<T...>, Of> = true;

/// Makes a variant hold its alternative number `index`; one that does so already keeps its value.
template <class... T>
void hold(std::variant<T...>& value, std::size_t index) {
    if (index != value.index()) {
        std::size_t at = 0;
        ((at++ == index ? void(value.template emplace<T>()) : void()), ...);
    }
}

/// Calls leaf(number) for every number, enum and bool in `value`, const or not as that is. Before
/// what may or may not be there a leaf says whether it is (optional), which (variant), how many
/// (vector); when the leaf writes another answer there, `value` becomes so.
template <class T, class Leaf>
void visit_leaves(T& value, Leaf&& leaf) {
    using Plain = std::remove_const_t<T>;
    constexpr bool kWrites = !std::is_const_v<T>;
    const auto each = [&leaf](auto&... members) { (visit_leaves(members, leaf), ...); };
    if constexpr (std::is_arithmetic_v<Plain> || std::is_enum_v<Plain> ||
                  requires { typename Plain::Mask; }) {  // lanes (lanes.hpp) are a number
        leaf(value);
    } else if constexpr (requires { Plain::visit_members(value, each); }) {
        Plain::visit_members(value, each);
    } else if constexpr (requires { value.coeffs(); }) {  // a quaternion
        auto* const xyzw = value.coeffs().data();
        each(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    } else if constexpr (requires { Plain::SizeAtCompileTime; }) {  // Eigen's vectors and matrices
        for (auto* number = value.data(); number != value.data() + value.size(); ++number) {
            leaf(*number);
        }
    } else if constexpr (kIsA<Plain, std::optional>) {
        bool there = value.has_value();
        leaf(there);
        if constexpr (kWrites) {
            if (there != value.has_value()) {
                value = there ? Plain(std::in_place) : std::nullopt;
            }
        }
        if (value) {
            visit_leaves(*value, leaf);
        }
    } else if constexpr (kIsA<Plain, std::variant>) {
        std::size_t which = value.index();
        leaf(which);
        if constexpr (kWrites) {
            hold(value, which);
        }
        std::visit(each, value);
    } else if constexpr (kIsA<Plain, std::vector> || requires { std::begin(value); }) {
        if constexpr (kIsA<Plain, std::vector>) {
            std::size_t count = value.size();
            leaf(count);
            if constexpr (kWrites) {
                value.resize(count);
            }
        }
        for (auto& element : value) {
            visit_leaves(element, leaf);
        }
    } else {
        with_members(value, each);
    }
}

/// A leaf that takes the numbers into 64 bits; any changed bit changes them.
struct Digest {
    std::uint64_t hash = 0;

    template <class T>
    void operator()(const T& number) {
        constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;  // 2^64 / golden ratio
        std::uint64_t bits = 0;                                // std::bit_cast came with GCC 11
        static_assert(sizeof number <= sizeof bits);
        std::memcpy(&bits, &number, sizeof number);
        hash = (std::rotl(hash, 23) ^ bits) * kOdd;
    }
};

}  // namespace limpet
