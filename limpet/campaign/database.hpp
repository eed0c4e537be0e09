// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace limpet {

/// A prepared statement of SQLite. Columns and parameters count from 0.
class Statement {
public:
    Statement(sqlite3& database, const std::string& sql, const std::string& name);

    void bind(int parameter, double value);  ///< NaN becomes NULL
    void bind(int parameter, std::int64_t value);
    void bind(int parameter, std::string_view value);
    /// @return false after the last row; the statement is then ready for its next use
    bool step();

    [[nodiscard]] double number(int column) const;  ///< NaN for NULL
    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] std::string text(int column) const;

private:
    struct Delete {
        void operator()(sqlite3_stmt* statement) const;
    };
    void check(int code);

    sqlite3& database_;
    std::string name_;
    std::unique_ptr<sqlite3_stmt, Delete> statement_;
};

/// One file of SQLite. What is wrong with the file (none, damaged, locked, full disk) is an
/// InputError that names it; what is wrong with our SQL an InternalError.
class Database {
public:
    enum class Access {
        read,
        write,   ///< of a file that is there
        create,  ///< a new one in its place
    };
    Database(const std::filesystem::path& path, Access access);

    void execute(const std::string& sql);
    [[nodiscard]] Statement prepare(const std::string& sql);
    /// First number of the first row.
    [[nodiscard]] std::int64_t integer(const std::string& sql);
    [[nodiscard]] std::string text(const std::string& sql);
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    struct Close {
        void operator()(sqlite3* database) const;
    };
    std::string name_;  ///< its path, for messages
    std::unique_ptr<sqlite3, Close> database_;
};

/// Commits when finish() is called, else takes everything back.
class Transaction {
public:
    explicit Transaction(Database& database) : database_(database) { database_.execute("BEGIN"); }
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;

    void finish();

private:
    Database& database_;
    bool open_ = true;
};

/// @return the name as SQL takes it, whatever it holds: "guidance.dock_speed_m_s"
[[nodiscard]] std::string sql_name(std::string_view name);

}  // namespace limpet
