// SPDX-License-Identifier: Apache-2.0
#include "limpet/record/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/mcap/format.hpp"
#include "limpet/record/units.hpp"

namespace limpet::record {
namespace {

double seconds_after(std::uint64_t origin_ns, std::uint64_t time_ns) {
    return time_ns >= origin_ns ? 1e-9 * static_cast<double>(time_ns - origin_ns)
                                : -1e-9 * static_cast<double>(origin_ns - time_ns);
}

constexpr std::size_t kMaxFields = 10'000;

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

    std::int64_t time_ns() {
        constexpr std::int64_t kSecond_ns = 1'000'000'000;
        const std::int64_t whole = get<std::int32_t>();
        return whole * kSecond_ns + get<std::uint32_t>();
    }

    std::int64_t whole(Whole kind) {
        return kind == Whole::nanoseconds ? time_ns() : get<std::int64_t>();
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
            case Primitive::float32: return static_cast<double>(get<float>());
            case Primitive::float64: return get<double>();
            case Primitive::int64:
            case Primitive::uint64:
            case Primitive::time:
            case Primitive::string: break;
        }
        throw InternalError("neither a string nor a whole number is read as a double");
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

namespace {

Whole whole_kind(Primitive primitive) {
    return primitive == Primitive::int64    ? Whole::int64
           : primitive == Primitive::uint64 ? Whole::uint64
           : primitive == Primitive::time   ? Whole::nanoseconds
                                            : Whole::none;
}

/// The nearest double.
double rounded(Whole kind, std::int64_t whole) {
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    if (kind == Whole::nanoseconds) {
        const std::int64_t whole_s = whole / kSecond_ns, rest_ns = whole % kSecond_ns;
        return static_cast<double>(whole_s) + 1e-9 * static_cast<double>(rest_ns);
    }
    return kind == Whole::uint64 ? static_cast<double>(static_cast<std::uint64_t>(whole))
                                 : static_cast<double>(whole);
}

std::uint64_t cell_bytes(const Column& column) {
    return sizeof(double) + (column.kind == Whole::none ? 0 : sizeof(std::int64_t));
}

}  // namespace

TableReader::TableReader(const std::vector<MessageType>& types, Table& table, Allowance& allowance)
    : table_(table), allowance_(allowance) {
    table_.type = types.front().name;
    Types by_name;
    for (const MessageType& type : types) {
        by_name.emplace(type.name, &type);
    }
    flatten(by_name, types.front(), "", 0);
}

/// Before the field is looked at: what takes no column takes time.
void TableReader::take_field() {
    if (++fields_ > kMaxFields) {
        throw InputError(fmt::format("{}: more than {} fields", table_.type, kMaxFields));
    }
    allowance_.take_fields(1);
}

void TableReader::flatten(const Types& types, const MessageType& type, const std::string& prefix,
                          int depth) {
    if (depth > kMostLevels) {
        throw InputError(type.name + ": message within itself");
    }
    for (const Field& field : type.fields) {
        const bool primitive = field.nested_type.empty() || field.primitive == Primitive::time;
        const bool dynamic = field.shape == Field::Shape::dynamic_array;
        const auto named = types.find(field.nested_type);
        const MessageType* nested = named == types.end() ? nullptr : named->second;
        if (field.name.size() > kLongestFieldName) {
            throw InputError(fmt::format("{}: a field's name of {} characters, allowed 1..{}",
                                         type.name, field.name.size(), kLongestFieldName));
        }
        if (!primitive && dynamic) {
            throw NotTaken(fmt::format("{}: an array of messages: {} {}", type.name,
                                       field.nested_type, field.name));
        }
        if (!primitive && nested == nullptr) {
            throw InputError(
                fmt::format("{}: unknown type: {} {}", type.name, field.nested_type, field.name));
        }
        const std::size_t count = dynamic ? 1 : field.count;
        for (std::size_t i = 0; i < count; ++i) {
            take_field();
            const bool indexed = field.shape == Field::Shape::fixed_array;
            const std::string path =
                indexed ? fmt::format("{}{}[{}]", prefix, field.name, i) : prefix + field.name;
            if (primitive) {
                add_step(field, path);
            } else if (nested->fields.empty()) {
                add_blank(path);
            } else {
                flatten(types, *nested, path + ".", depth + 1);
            }
        }
    }
}

/// ROS 2 gives a message without fields one: structure_needs_at_least_one_member, a byte.
void TableReader::add_blank(const std::string& path) {
    allowance_.take_bytes(sizeof(Step) + path.size());
    Step step;
    step.primitive = Primitive::uint8;
    step.blank = true;
    step.name = path;
    steps_.push_back(std::move(step));
}

void TableReader::add_step(const Field& field, const std::string& path) {
    allowance_.take_bytes(sizeof(Step) + path.size());
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
        allowance_.take_bytes(sizeof(TextColumn) + name.size() + rows * sizeof(std::string));
        table_.texts.push_back({name, std::vector<std::string>(rows)});
        return table_.texts.size() - 1;
    }
    Column column{.name = name, .values = {}, .kind = whole_kind(primitive)};
    allowance_.take_bytes(sizeof(Column) + name.size() + rows * cell_bytes(column));
    column.values.resize(rows, kNaN);
    column.whole.resize(column.kind == Whole::none ? 0 : rows);
    row_bytes_ += cell_bytes(column);
    table_.columns.push_back(std::move(column));
    return table_.columns.size() - 1;
}

void TableReader::append(std::uint64_t time_ns, std::span<const std::uint8_t> message,
                         std::uint64_t origin_ns) {
    allowance_.take_bytes(sizeof(double) + sizeof time_ns + row_bytes_ +
                          sizeof(std::string) * table_.texts.size());
    table_.time_s.push_back(seconds_after(origin_ns, time_ns));
    table_.time_ns.push_back(time_ns);
    for (Column& column : table_.columns) {
        column.values.push_back(kNaN);
        if (column.kind != Whole::none) {
            column.whole.push_back(0);
        }
    }
    for (TextColumn& column : table_.texts) {
        column.values.emplace_back();
    }
    try {
        Cdr cdr(message);
        for (Step& step : steps_) {
            if (step.blank) {
                (void)cdr.number(step.primitive);
            } else if (step.dynamic) {
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
        std::string text = cdr.string();
        allowance_.take_bytes(text.size());
        table_.texts[column].values.back() = std::move(text);
    } else {
        read_number(cdr, primitive, table_.columns[column]);
    }
}

void TableReader::read_number(Cdr& cdr, Primitive primitive, Column& column) {
    if (column.kind == Whole::none) {
        column.values.back() = cdr.number(primitive);
        return;
    }
    column.whole.back() = cdr.whole(column.kind);
    column.values.back() = rounded(column.kind, column.whole.back());
}

void TableReader::read_array(Cdr& cdr, Step& step) {
    const auto length = cdr.get<std::uint32_t>();
    table_.columns[step.column].values.back() = length;
    for (std::size_t i = 0; i < length; ++i) {
        if (i == step.elements.size() && i < kMaxArrayColumns) {
            take_field();
            step.elements.push_back(
                add_column(step.primitive, fmt::format("{}[{}]", step.name, i)));
        }
        if (i < step.elements.size()) {
            read_value(cdr, step.primitive, step.elements[i]);
        } else if (step.primitive == Primitive::string) {
            (void)cdr.string();
        } else if (const Whole kind = whole_kind(step.primitive); kind != Whole::none) {
            (void)cdr.whole(kind);
        } else {
            (void)cdr.number(step.primitive);
        }
    }
}

std::size_t put_in_order(Table& table, double most_back_s) {
    std::size_t late = 0;
    double latest_s = -std::numeric_limits<double>::infinity();
    for (const double time_s : table.time_s) {
        if (!(time_s >= latest_s - most_back_s)) {
            return 0;
        }
        late += time_s < latest_s ? 1 : 0;
        latest_s = std::max(latest_s, time_s);
    }
    if (late == 0) {
        return 0;
    }
    std::vector<std::size_t> order(table.time_s.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&table](std::size_t a, std::size_t b) {
        return table.time_s[a] < table.time_s[b];
    });
    const auto put = [&order](auto& values) {
        auto sorted = values;
        for (std::size_t k = 0; k < values.size(); ++k) {
            sorted[k] = std::move(values[order[k]]);
        }
        values = std::move(sorted);
    };
    put(table.time_s);
    put(table.time_ns);
    for (Column& column : table.columns) {
        put(column.values);
        put(column.whole);
    }
    for (TextColumn& column : table.texts) {
        put(column.values);
    }
    return late;
}

void TableReader::drop_last_row() {
    table_.time_s.pop_back();
    table_.time_ns.pop_back();
    for (Column& column : table_.columns) {
        column.values.pop_back();
        if (column.kind != Whole::none) {
            column.whole.pop_back();
        }
    }
    for (TextColumn& column : table_.texts) {
        column.values.pop_back();
    }
}

}  // namespace limpet::record
