// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/allowance.hpp"

namespace limpet::ulog {

template <class T>
double read_as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

/// A number in a message: how it is read and where it goes.
struct Element {
    std::string name;
    std::size_t offset = 0;
    std::size_t bytes = 0;
    double (*read)(const char* bytes) = nullptr;
};

/// The numbers behind the time stamp, which every message begins with.
using Layout = std::vector<Element>;

/// Fields by the message's name, as a log defines them: "uint64_t timestamp;float[3] xyz;".
using Formats = std::map<std::string, std::string, std::less<>>;

/// Lays a message out by its definition and those of its parts.
/// @param allowance  what is gone through and made is taken from it
/// @throws InputError  a definition that makes no sense; TooMuch
[[nodiscard]] Layout layout_of_format(const Formats& formats, std::string_view type,
                                      Allowance& allowance);

}  // namespace limpet::ulog
