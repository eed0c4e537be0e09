// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/allowance.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/record/schema.hpp"

namespace limpet::record {

/// What a column's `whole` numbers are, which doubles round.
enum class Whole {
    none,
    int64,
    uint64,       ///< as its bits
    nanoseconds,  ///< of values in seconds
};

struct Column {
    std::string name;  ///< "pose.position.x", "rotor_speed_rad_s[0]"
    std::vector<double> values;
    Whole kind = Whole::none;
    std::vector<std::int64_t> whole = {};  ///< next to each value, with all its digits
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
    std::vector<std::uint64_t> time_ns = {};  ///< the same with all its digits, where it is known

    /// @return nullptr if there is none of that name
    [[nodiscard]] const Column* find(std::string_view column) const {
        return find_by(columns, &Column::name, column);
    }
    [[nodiscard]] const TextColumn* find_text(std::string_view column) const {
        return find_by(texts, &TextColumn::name, column);
    }
};

/// Puts rows by their time, those of one time as they stood.
/// @param most_back_s  where one stands further behind a later one, all stay: that is another order
/// @return how many stood behind later ones and have been moved
std::size_t put_in_order(Table& table, double most_back_s);

/// Elements of a dynamic array that become columns; what is behind them is read and dropped.
inline constexpr std::size_t kMaxArrayColumns = 64;

/// Fills a table from CDR messages by their schema alone.
///
/// A nested message is flattened with dots, a fixed array with brackets. A dynamic array `a` gives
/// `a.length` and `a[0]`, `a[1]`..., NaN or empty where it was shorter. Times become seconds,
/// booleans 0 and 1, 64-bit integers the nearest double; of the last and of times all digits are
/// kept next to them. A nested message without fields is a byte, as ROS 2 writes it. Names of
/// `limpet_msgs` get their units' capitals back (units.hpp).
class TableReader {
public:
    /// @param types  as parse_ros2msg gives them: the message first
    /// @param table  outlives the reader; its columns are made here
    /// @param allowance  of the recording; outlives the reader
    /// @throws NotTaken for a dynamic array of messages
    /// @throws InputError for a schema that cannot be flattened: an unknown type, a type within
    ///         itself, more than 10,000 fields
    /// @throws TooMuch
    TableReader(const std::vector<MessageType>& types, Table& table, Allowance& allowance);

    /// Adds a row, or nothing.
    /// @param origin_ns  from which the row's time_s counts
    /// @param cdr  little-endian CDR with its encapsulation header
    /// @throws mcap::Malformed if it is not what the schema says
    /// @throws TooMuch
    void append(std::uint64_t time_ns, std::span<const std::uint8_t> cdr,
                std::uint64_t origin_ns = 0);

private:
    /// Reads one value or one dynamic array, or passes over a message without fields.
    struct Step {
        Primitive primitive = Primitive::float64;
        bool dynamic = false;
        bool blank = false;
        std::size_t column = 0;             ///< of the value, or of the array's length
        std::string name;                   ///< of a dynamic array
        std::vector<std::size_t> elements;  ///< columns of a dynamic array
    };
    class Cdr;

    using Types = std::map<std::string_view, const MessageType*>;

    void flatten(const Types& types, const MessageType& type, const std::string& prefix, int depth);
    void take_field();
    void add_step(const Field& field, const std::string& path);
    void add_blank(const std::string& path);
    std::size_t add_column(Primitive primitive, const std::string& path);
    void read_value(Cdr& cdr, Primitive primitive, std::size_t column);
    void read_number(Cdr& cdr, Primitive primitive, Column& column);
    void read_array(Cdr& cdr, Step& step);
    void drop_last_row();

    Table& table_;
    Allowance& allowance_;
    std::size_t fields_ = 0;       ///< and messages within messages
    std::uint64_t row_bytes_ = 0;  ///< of the numbers in a row
    std::vector<Step> steps_;
};

}  // namespace limpet::record
