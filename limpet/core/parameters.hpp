// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "limpet/core/type_list.hpp"

namespace limpet {

/// Where the value of a row lives: a number, a count or a switch. Everybody reads and writes it as
/// a number, a switch as 0 and 1.
class ParameterValue {
public:
    template <class Value>
    ParameterValue(Value* place) : place_(place) {}

    [[nodiscard]] double get() const {
        return std::visit([](auto* place) { return static_cast<double>(*place); }, place_);
    }
    /// @param value  in the row's range; whole for a count, 0 or 1 for a switch
    void set(double value) const {
        std::visit(
            [&](auto* place) { *place = static_cast<std::decay_t<decltype(*place)>>(value); },
            place_);
    }
    [[nodiscard]] bool is_count() const { return std::holds_alternative<int*>(place_); }
    [[nodiscard]] bool is_switch() const { return std::holds_alternative<bool*>(place_); }
    [[nodiscard]] bool is_whole() const { return is_count() || is_switch(); }
    [[nodiscard]] const void* address() const {
        return std::visit([](auto* place) -> const void* { return place; }, place_);
    }

private:
    std::variant<double*, int*, bool*> place_;
};

/// One row of a module's parameter table: everything that the loader checks and that
/// `limpet params` prints. The default is not in the row: it is the struct's in-class default.
template <class Struct>
struct Parameter {
    /// A member; a function where it lies deeper: in a part, in a vector.
    using Field =
        std::variant<double Struct::*, int Struct::*, bool Struct::*, double& (*)(Struct&)>;

    std::string_view name;         ///< YAML key, carries its unit: `stiffness_N_m`
    std::string_view unit;         ///< "N/m"; "-" for pure numbers
    double minimum;                ///< allowed, inclusive
    double maximum;                ///< allowed, inclusive
    Field field;                   ///< where it lives
    std::string_view description;  ///< what it does, one line
    std::string_view source;       ///< paper section, data sheet, or "assumed: why"

    [[nodiscard]] ParameterValue of(Struct& values) const {
        return std::visit([&](auto place) { return ParameterValue(&std::invoke(place, values)); },
                          field);
    }
    [[nodiscard]] double get(const Struct& values) const {
        return of(const_cast<Struct&>(values)).get();  // reads only
    }
};

template <class Struct>
using ParameterTable = std::vector<Parameter<Struct>>;

/// A row together with the value it describes.
struct BoundParameter {
    std::string_view name;
    std::string_view unit;
    double minimum = 0.0;
    double maximum = 0.0;
    ParameterValue value;
    std::string_view description;
    std::string_view source;

    /// In the row's range, and whole where it must be.
    [[nodiscard]] bool allows(double number) const {
        return number >= minimum && number <= maximum &&
               (!value.is_whole() || std::trunc(number) == number);
    }
};

[[nodiscard]] inline std::vector<BoundParameter> joined(std::vector<BoundParameter> first,
                                                        const std::vector<BoundParameter>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

/// @param values  the table's struct, or one that is made of it; must outlive what is returned
template <class Struct, class Values>
[[nodiscard]] std::vector<BoundParameter> bind(const ParameterTable<Struct>& table,
                                               Values& values) {
    std::vector<BoundParameter> rows;
    rows.reserve(table.size());
    for (const Parameter<Struct>& row : table) {
        rows.push_back({row.name, row.unit, row.minimum, row.maximum, row.of(values),
                        row.description, row.source});
    }
    return rows;
}

/// Rows of all types of a registry, in its order.
/// @param values  must outlive what is returned
template <class... Types>
[[nodiscard]] std::vector<BoundParameter> bind_all(TypeList<Types...> /*list*/,
                                                   ParametersOf<TypeList<Types...>>& values) {
    std::vector<BoundParameter> rows;
    ((rows = joined(std::move(rows),
                    bind(Types::table(), static_cast<typename Types::Parameters&>(values)))),
     ...);
    return rows;
}

}  // namespace limpet
