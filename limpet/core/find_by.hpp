// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace limpet {

/// @param member  what is compared
/// @return the first whose member is `wanted`, nullptr if there is none
template <class All, class Member, class Wanted>
[[nodiscard]] auto* find_by(All& all, Member member, const Wanted& wanted) {
    const auto found = std::ranges::find(all, wanted, member);
    return found == std::end(all) ? nullptr : &*found;
}

/// @return the first that is called so, nullptr if there is none
template <class All>
[[nodiscard]] auto* find_named(All& all, std::string_view wanted) {
    const auto found =
        std::ranges::find_if(all, [=](const auto& one) { return one.name == wanted; });
    return found == std::end(all) ? nullptr : &*found;
}

/// What all are called, in their order.
/// @param member  that says it
template <class All, class Member>
[[nodiscard]] std::vector<std::string> names_of(const All& all, Member member) {
    std::vector<std::string> names;
    for (const auto& one : all) {
        names.emplace_back(std::invoke(member, one));
    }
    return names;
}
template <class All>
[[nodiscard]] std::vector<std::string> names_of(const All& all) {
    return names_of(all, [](const auto& one) { return one.name; });
}

/// @return "one, two", or "none"
[[nodiscard]] inline std::string listed(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) {
        list += (list.empty() ? "" : ", ") + name;
    }
    return names.empty() ? "none" : list;
}

}  // namespace limpet
