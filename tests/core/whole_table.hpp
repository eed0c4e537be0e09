// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "limpet/core/parameters.hpp"

namespace limpet::test {

/// Every field of a plain struct has one row: beside their values there is but padding.
/// @param rows  bound to `values`
template <class Struct>
void expect_whole(const Struct& values, const std::vector<BoundParameter>& rows,
                  const std::string& name) {
    std::map<std::size_t, std::size_t> size_at;
    for (const BoundParameter& row : rows) {
        const std::size_t size = row.value.is_switch()  ? sizeof(bool)
                                 : row.value.is_count() ? sizeof(int)
                                                        : sizeof(double);
        const auto at = static_cast<const std::byte*>(row.value.address()) -
                        reinterpret_cast<const std::byte*>(&values);
        EXPECT_TRUE(size_at.emplace(at, size).second)
            << name << "." << row.name << " shares its value with another row";
    }
    const auto aligned = [](std::size_t end, std::size_t size) {
        return (end + size - 1) / size * size;
    };
    std::size_t end = 0;
    for (const auto& [at, size] : size_at) {
        EXPECT_EQ(at, aligned(end, size)) << name << ": no row for what lies at " << end;
        end = at + size;
    }
    EXPECT_EQ(sizeof(Struct), aligned(end, alignof(Struct))) << name;
}

template <class Struct>
void expect_whole(const ParameterTable<Struct>& table, const std::string& name) {
    Struct values;
    expect_whole(values, bind(table, values), name);
}

}  // namespace limpet::test
