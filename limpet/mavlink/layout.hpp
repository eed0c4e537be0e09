// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "limpet/mavlink/checksum.hpp"

/// From a message's list of fields to its place on the wire, when compiling.
///
/// A message is a plain struct with kId, kName and fields(): its fields in the order of MAVLink's
/// XML, extensions last. On the wire, larger elements come first and equal ones keep that order;
/// extensions follow unsorted. CRC_EXTRA is a checksum of the name and of the sorted fields' types
/// and names, without extensions: two ends that disagree on a message refuse each other's.
/// Source: MAVLink serialization guide, "Field Reordering" and "CRC_EXTRA Calculation"
namespace limpet::mavlink {

template <class Message, class Value>
struct Field {
    std::string_view name;
    Value Message::*member;
    bool is_extension;
};

template <class Message, class Value>
[[nodiscard]] constexpr Field<Message, Value> field(std::string_view name, Value Message::*member) {
    return {name, member, false};
}

template <class Message, class Value>
[[nodiscard]] constexpr Field<Message, Value> extension(std::string_view name,
                                                        Value Message::*member) {
    return {name, member, true};
}

/// How MAVLink calls a C++ type.
template <class Element>
[[nodiscard]] constexpr std::string_view wire_type_name() {
    static_assert(std::is_arithmetic_v<Element>);
    if constexpr (std::is_same_v<Element, char>) {
        return "char";
    } else if constexpr (std::is_same_v<Element, float>) {
        return "float";
    } else if constexpr (std::is_same_v<Element, double>) {
        return "double";
    } else {
        constexpr std::array<std::string_view, 4> kSigned = {"int8_t", "int16_t", "int32_t",
                                                             "int64_t"};
        constexpr std::array<std::string_view, 4> kUnsigned = {"uint8_t", "uint16_t", "uint32_t",
                                                               "uint64_t"};
        constexpr std::size_t kPower = sizeof(Element) == 8 ? 3 : sizeof(Element) / 2;
        return std::is_signed_v<Element> ? kSigned[kPower] : kUnsigned[kPower];
    }
}

template <class Value>
struct WireType {
    using Element = Value;
    static constexpr std::size_t kCount = 1;
    static constexpr bool kIsArray = false;
};

template <class T, std::size_t n>
struct WireType<std::array<T, n>> {
    using Element = T;
    static constexpr std::size_t kCount = n;
    static constexpr bool kIsArray = true;
};

/// What the layout needs to know of a field.
struct FieldShape {
    std::string_view name;
    std::string_view type_name;
    std::size_t element_bytes = 0;
    std::size_t count = 0;
    bool is_array = false;
    bool is_extension = false;
};

template <class Message, class Value>
[[nodiscard]] constexpr FieldShape shape_of(const Field<Message, Value>& listed) {
    using Type = WireType<Value>;
    return {listed.name,
            wire_type_name<typename Type::Element>(),
            sizeof(typename Type::Element),
            Type::kCount,
            Type::kIsArray,
            listed.is_extension};
}

template <std::size_t n>
struct Layout {
    std::array<FieldShape, n> shapes = {};     ///< as listed
    std::array<std::size_t, n> order = {};     ///< on the wire: indices into the list
    std::array<std::size_t, n> offset = {};    ///< in the payload [bytes], as listed
    std::size_t payload_bytes = 0;             ///< with extensions
    std::size_t bytes_without_extensions = 0;  ///< what MAVLink 1 knows
    std::uint8_t crc_extra = 0;
};

/// @return true when `a`, listed later, goes ahead of `b` on the wire
[[nodiscard]] constexpr bool goes_ahead(const FieldShape& a, const FieldShape& b) {
    return !a.is_extension && (b.is_extension || a.element_bytes > b.element_bytes);
}

/// Insertion sort: stable, and std::stable_sort is not constexpr in C++20.
template <std::size_t n>
constexpr void sort_fields(Layout<n>& layout) {
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t at = i;
        for (; at > 0 && goes_ahead(layout.shapes[i], layout.shapes[layout.order[at - 1]]); --at) {
            layout.order[at] = layout.order[at - 1];
        }
        layout.order[at] = i;
    }
}

template <std::size_t n>
[[nodiscard]] constexpr std::uint8_t crc_extra_of(std::string_view name, const Layout<n>& layout) {
    std::uint16_t crc = checksum(checksum(kChecksumSeed, name), std::string_view(" "));
    for (const std::size_t i : layout.order) {
        const FieldShape& shape = layout.shapes[i];
        if (shape.is_extension) {
            continue;
        }
        crc = checksum(checksum(crc, shape.type_name), std::string_view(" "));
        crc = checksum(checksum(crc, shape.name), std::string_view(" "));
        if (shape.is_array) {
            crc = checksum(crc, static_cast<std::uint8_t>(shape.count));
        }
    }
    return static_cast<std::uint8_t>((crc & 0xFFU) ^ (crc >> 8U));
}

template <class Message>
[[nodiscard]] constexpr auto make_layout() {
    constexpr auto kFields = Message::fields();
    Layout<std::tuple_size_v<decltype(kFields)>> layout;
    layout.shapes =
        std::apply([](const auto&... each) { return std::array{shape_of(each)...}; }, kFields);
    sort_fields(layout);
    for (const std::size_t i : layout.order) {
        const FieldShape& shape = layout.shapes[i];
        layout.offset[i] = layout.payload_bytes;
        layout.payload_bytes += shape.element_bytes * shape.count;
        if (!shape.is_extension) {
            layout.bytes_without_extensions = layout.payload_bytes;
        }
    }
    layout.crc_extra = crc_extra_of(Message::kName, layout);
    return layout;
}

template <class Message>
inline constexpr auto kLayout = make_layout<Message>();

/// Calls visit(name, value) for each field, as listed.
template <class Message, class Visit>
constexpr void for_each_field(Message& message, Visit&& visit) {
    std::apply([&](const auto&... each) { (visit(each.name, message.*each.member), ...); },
               std::remove_const_t<Message>::fields());
}

}  // namespace limpet::mavlink
