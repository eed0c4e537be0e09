// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/database.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cmath>
#include <limits>

#include "limpet/core/errors.hpp"

namespace limpet {
namespace {

constexpr int kPatience_ms = 10'000;  ///< for somebody else's transaction

[[noreturn]] void fail_as(int code, const char* message, const std::string& name) {
    switch (code & 0xff) {
        case SQLITE_NOTADB: throw InputError(name + ": is not a database of results");
        case SQLITE_CORRUPT: throw InputError(name + ": is damaged or cut short");
        case SQLITE_CANTOPEN: throw InputError(name + ": cannot be opened");
        case SQLITE_BUSY:
        case SQLITE_LOCKED: throw InputError(name + ": is in use by another program");
        case SQLITE_READONLY:
        case SQLITE_PERM:
        case SQLITE_FULL:
        case SQLITE_IOERR: throw InputError(fmt::format("{}: {}", name, message));
        default: throw InternalError(fmt::format("{}: SQLite: {} ({})", name, message, code));
    }
}

int flags_of(Database::Access access) {
    switch (access) {
        case Database::Access::read: return SQLITE_OPEN_READONLY;
        case Database::Access::write: return SQLITE_OPEN_READWRITE;
        case Database::Access::create: return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    }
    throw InternalError("access out of range");
}

}  // namespace

Statement::Statement(sqlite3& database, const std::string& sql, const std::string& name)
    : database_(database), name_(name) {
    sqlite3_stmt* statement = nullptr;
    check(sqlite3_prepare_v2(&database_, sql.c_str(), -1, &statement, nullptr));
    statement_.reset(statement);
}

void Statement::Delete::operator()(sqlite3_stmt* statement) const {
    sqlite3_finalize(statement);
}

void Statement::check(int code) {
    if (code != SQLITE_OK) {
        fail_as(code, sqlite3_errmsg(&database_), name_);
    }
}

void Statement::bind(int parameter, double value) {
    check(sqlite3_bind_double(statement_.get(), parameter + 1, value));
}

void Statement::bind(int parameter, std::int64_t value) {
    check(sqlite3_bind_int64(statement_.get(), parameter + 1, value));
}

void Statement::bind(int parameter, std::string_view value) {
    check(sqlite3_bind_text(statement_.get(), parameter + 1, value.data(),
                            static_cast<int>(value.size()), SQLITE_TRANSIENT));
}

bool Statement::step() {
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) {
        return true;
    }
    sqlite3_reset(statement_.get());
    check(code == SQLITE_DONE ? SQLITE_OK : code);
    return false;
}

double Statement::number(int column) const {
    return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL
               ? std::numeric_limits<double>::quiet_NaN()
               : sqlite3_column_double(statement_.get(), column);
}

std::int64_t Statement::integer(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
}

std::string Statement::text(int column) const {
    const auto* bytes = sqlite3_column_text(statement_.get(), column);
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
    return bytes == nullptr ? std::string()
                            : std::string(reinterpret_cast<const char*>(bytes), size);
}

Database::Database(const std::filesystem::path& path, Access access) : name_(path.string()) {
    std::error_code ignored;
    if (access != Access::create && !std::filesystem::exists(path, ignored)) {
        throw InputError(name_ + ": there is no such file");
    }
    if (std::filesystem::is_directory(path, ignored)) {
        throw InputError(name_ + ": is a directory, not a database of results");
    }
    sqlite3* database = nullptr;
    const int code = sqlite3_open_v2(path.c_str(), &database, flags_of(access), nullptr);
    database_.reset(database);
    if (code != SQLITE_OK) {
        fail_as(code, sqlite3_errmsg(database), name_);
    }
    sqlite3_busy_timeout(database, kPatience_ms);
}

void Database::Close::operator()(sqlite3* database) const {
    sqlite3_close(database);
}

void Database::execute(const std::string& sql) {
    const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) {
        fail_as(code, sqlite3_errmsg(database_.get()), name_);
    }
}

Statement Database::prepare(const std::string& sql) {
    return {*database_, sql, name_};
}

std::int64_t Database::integer(const std::string& sql) {
    Statement statement = prepare(sql);
    return statement.step() ? statement.integer(0) : 0;
}

std::string Database::text(const std::string& sql) {
    Statement statement = prepare(sql);
    return statement.step() ? statement.text(0) : std::string();
}

Transaction::~Transaction() {
    if (open_) {
        try {
            database_.execute("ROLLBACK");
        } catch (const std::exception&) {
            // What brought us here is already on its way; an open transaction ends with its file.
        }
    }
}

void Transaction::finish() {
    database_.execute("COMMIT");
    open_ = false;
}

std::string sql_name(std::string_view name) {
    std::string text = "\"";
    for (const char c : name) {
        text += c;
        if (c == '"') {
            text += c;
        }
    }
    return text + "\"";
}

}  // namespace limpet
