// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/record/schema.hpp"

namespace limpet::record {

struct Column {
    std::string name;  ///< "pose.position.x", "rotor_speed_rad_s[0]"
    std::vector<double> values;
};

struct TextColumn {
    std::string name;
    std::vector<std::string> values;
};

/// The messages of one topic, a row each; every column is as long as time_s.
struct Table {
    std::string topic;
    std::string type;            ///< "limpet_msgs/msg/CupState"
    std::vector<double> time_s;  ///< when it was recorded
    std::vector<Column> columns;
    std::vector<TextColumn> texts;

    /// @return nullptr if there is none of that name
    [[nodiscard]] const Column* find(std::string_view column) const {
        return find_by(columns, &Column::name, column);
    }
    [[nodiscard]] const TextColumn* find_text(std::string_view column) const {
        return find_by(texts, &TextColumn::name, column);
    }
};

/// An allowance is used up: the recording as a whole is not read.
struct TooMuch : InputError {
    using InputError::InputError;
};

/// What the tables of one recording may take, all together; every reader takes its share.
class TableAllowance {
public:
    /// @param bytes  of the tables, in memory
    explicit TableAllowance(std::uint64_t bytes = 256'000'000)
        : bytes_{"MB of tables", bytes, 1'000'000} {}

    /// All of these throw TooMuch, "more than ALLOWED WHAT".
    void take_bytes(std::uint64_t count) { bytes_.take(count); }
    /// Columns, and messages within messages.
    void take_fields(std::uint64_t count) { fields_.take(count); }
    /// Of a topic's message definitions.
    void take_definition(std::uint64_t bytes) { definitions_.take(bytes); }

private:
    struct Share {
        const char* what;
        std::uint64_t most;
        std::uint64_t unit = 1;
        std::uint64_t taken = 0;
        void take(std::uint64_t count);
    };
    Share bytes_;
    Share fields_ = {"fields in its messages", 100'000};
    Share definitions_ = {"bytes of message definitions", 4'000'000};
};

/// Elements of a dynamic array that become columns; what is behind them is read and dropped.
inline constexpr std::size_t kMaxArrayColumns = 64;

/// Fills a table from CDR messages by their schema alone.
///
/// A nested message is flattened with dots, a fixed array with brackets. A dynamic array `a` gives
/// `a.length` and `a[0]`, `a[1]`..., NaN or empty where it was shorter. Times become seconds,
/// booleans 0 and 1, 64-bit integers the nearest double. Names of `limpet_msgs` get their units'
/// capitals back (units.hpp).
class TableReader {
public:
    /// @param types  as parse_ros2msg gives them: the message first
    /// @param table  outlives the reader; its columns are made here
    /// @param allowance  of the recording; outlives the reader
    /// @throws InputError for a schema that cannot be flattened: an unknown type, a type within
    ///         itself, a dynamic array of messages, more than 10,000 fields
    /// @throws TooMuch
    TableReader(const std::vector<MessageType>& types, Table& table, TableAllowance& allowance);

    /// Adds a row, or nothing.
    /// @param cdr  little-endian CDR with its encapsulation header
    /// @throws mcap::Malformed if it is not what the schema says
    /// @throws TooMuch
    void append(double time_s, std::span<const std::uint8_t> cdr);

private:
    /// Reads one value or one dynamic array.
    struct Step {
        Primitive primitive = Primitive::float64;
        bool dynamic = false;
        std::size_t column = 0;             ///< of the value, or of the array's length
        std::string name;                   ///< of a dynamic array
        std::vector<std::size_t> elements;  ///< columns of a dynamic array
    };
    class Cdr;

    using Types = std::map<std::string_view, const MessageType*>;

    void flatten(const Types& types, const MessageType& type, const std::string& prefix, int depth);
    void take_field();
    void add_step(const Field& field, const std::string& path);
    std::size_t add_column(Primitive primitive, const std::string& path);
    void read_value(Cdr& cdr, Primitive primitive, std::size_t column);
    void read_array(Cdr& cdr, Step& step);
    void drop_last_row();

    Table& table_;
    TableAllowance& allowance_;
    std::size_t fields_ = 0;  ///< and messages within messages
    std::vector<Step> steps_;
};

}  // namespace limpet::record
