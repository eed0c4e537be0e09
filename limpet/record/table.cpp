// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/mcap/format.hpp"
#include "limpet/record/units.hpp"

namespace limpet::record {
namespace {

constexpr std::size_t kMaxSteps = 10'000;
constexpr int kMaxDepth = 16;

}  // namespace

/// Plain CDR (XCDR1): every value aligned to its own size, counted from behind the encapsulation.
class TableReader::Cdr {
public:
    explicit Cdr(std::span<const std::uint8_t> message) {
        constexpr std::size_t kEncapsulation_bytes = 4;
        constexpr std::uint8_t kLittleEndian = 0x01;
        if (message.size() < kEncapsulation_bytes || message[0] != 0 ||
            message[1] != kLittleEndian) {
            throw mcap::Malformed("message that is not little-endian CDR");
        }
        body_ = message.subspan(kEncapsulation_bytes);
    }

    template <class Value>
    Value get() {
        at_ = (at_ + sizeof(Value) - 1) / sizeof(Value) * sizeof(Value);
        Value value;
        std::memcpy(&value, take(sizeof(Value)).data(), sizeof(Value));
        return value;
    }

    std::string string() {
        const auto size = get<std::uint32_t>();  // counts the closing zero
        const auto bytes = take(size);
        return std::string(reinterpret_cast<const char*>(bytes.data()), size > 0 ? size - 1 : 0);
    }

    double time_s() {
        const auto whole = get<std::int32_t>();
        return static_cast<double>(whole) + 1e-9 * static_cast<double>(get<std::uint32_t>());
    }

    double number(Primitive primitive) {
        switch (primitive) {
            case Primitive::boolean: return get<std::uint8_t>() != 0 ? 1.0 : 0.0;
            case Primitive::int8: return get<std::int8_t>();
            case Primitive::uint8: return get<std::uint8_t>();
            case Primitive::int16: return get<std::int16_t>();
            case Primitive::uint16: return get<std::uint16_t>();
            case Primitive::int32: return get<std::int32_t>();
            case Primitive::uint32: return get<std::uint32_t>();
            case Primitive::int64: return static_cast<double>(get<std::int64_t>());
            case Primitive::uint64: return static_cast<double>(get<std::uint64_t>());
            case Primitive::float32: return static_cast<double>(get<float>());
            case Primitive::float64: return get<double>();
            case Primitive::time: return time_s();
            case Primitive::string: break;
        }
        throw InternalError("a string is no number");
    }

private:
    std::span<const std::uint8_t> take(std::size_t count) {
        if (at_ > body_.size() || count > body_.size() - at_) {
            throw mcap::Malformed("message that is shorter than its schema");
        }
        at_ += count;
        return body_.subspan(at_ - count, count);
    }

    std::span<const std::uint8_t> body_;
    std::size_t at_ = 0;
};

TableReader::TableReader(const std::vector<MessageType>& types, Table& table) : table_(table) {
    table_.type = types.front().name;
    flatten(types, types.front(), "", 0);
}

void TableReader::flatten(const std::vector<MessageType>& types, const MessageType& type,
                          const std::string& prefix, int depth) {
    if (depth > kMaxDepth) {
        throw InputError(type.name + ": message within itself");
    }
    for (const Field& field : type.fields) {
        const bool primitive = field.nested_type.empty() || field.primitive == Primitive::time;
        const bool dynamic = field.shape == Field::Shape::dynamic_array;
        const MessageType* nested = find_by(types, &MessageType::name, field.nested_type);
        if (!primitive && (nested == nullptr || dynamic)) {
            throw InputError(type.name + ": " +
                             (dynamic ? "dynamic array of messages: " : "unknown type: ") +
                             field.nested_type + " " + field.name);
        }
        const std::size_t count = dynamic ? 1 : field.count;
        for (std::size_t i = 0; i < count; ++i) {
            const bool indexed = field.shape == Field::Shape::fixed_array;
            const std::string path =
                indexed ? fmt::format("{}{}[{}]", prefix, field.name, i) : prefix + field.name;
            if (primitive) {
                add_step(field, path);
            } else {
                flatten(types, *nested, path + ".", depth + 1);
            }
        }
    }
}

void TableReader::add_step(const Field& field, const std::string& path) {
    if (steps_.size() >= kMaxSteps) {
        throw InputError(table_.type + ": more than 10000 fields");
    }
    Step step;
    step.primitive = field.primitive;
    step.dynamic = field.shape == Field::Shape::dynamic_array;
    step.name = path;
    step.column = step.dynamic ? add_column(Primitive::uint32, path + ".length")
                               : add_column(field.primitive, path);
    steps_.push_back(std::move(step));
}

/// A column that comes late is filled up to the row that is being read.
std::size_t TableReader::add_column(Primitive primitive, const std::string& path) {
    const std::string name = column_name(table_.type, path);
    const std::size_t rows = table_.time_s.size();
    if (primitive == Primitive::string) {
        table_.texts.push_back({name, std::vector<std::string>(rows)});
        return table_.texts.size() - 1;
    }
    table_.columns.push_back({name, std::vector<double>(rows, kNaN)});
    return table_.columns.size() - 1;
}

void TableReader::append(double time_s, std::span<const std::uint8_t> message) {
    table_.time_s.push_back(time_s);
    for (Column& column : table_.columns) {
        column.values.push_back(kNaN);
    }
    for (TextColumn& column : table_.texts) {
        column.values.emplace_back();
    }
    try {
        Cdr cdr(message);
        for (Step& step : steps_) {
            if (step.dynamic) {
                read_array(cdr, step);
            } else {
                read_value(cdr, step.primitive, step.column);
            }
        }
    } catch (const mcap::Malformed&) {
        drop_last_row();
        throw;
    }
}

void TableReader::read_value(Cdr& cdr, Primitive primitive, std::size_t column) {
    if (primitive == Primitive::string) {
        table_.texts[column].values.back() = cdr.string();
    } else {
        table_.columns[column].values.back() = cdr.number(primitive);
    }
}

void TableReader::read_array(Cdr& cdr, Step& step) {
    const auto length = cdr.get<std::uint32_t>();
    table_.columns[step.column].values.back() = length;
    for (std::size_t i = 0; i < length; ++i) {
        if (i == step.elements.size() && i < kMaxArrayColumns) {
            step.elements.push_back(
                add_column(step.primitive, fmt::format("{}[{}]", step.name, i)));
        }
        if (i < step.elements.size()) {
            read_value(cdr, step.primitive, step.elements[i]);
        } else if (step.primitive == Primitive::string) {
            (void)cdr.string();
        } else {
            (void)cdr.number(step.primitive);
        }
    }
}

void TableReader::drop_last_row() {
    table_.time_s.pop_back();
    for (Column& column : table_.columns) {
        column.values.pop_back();
    }
    for (TextColumn& column : table_.texts) {
        column.values.pop_back();
    }
}

}  // namespace limpet::record
