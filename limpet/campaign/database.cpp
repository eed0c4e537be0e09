// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/database.hpp"

#include <fmt/format.h>

#include <regex>

#include "limpet/core/file_kind.hpp"

namespace limpet::campaign {
namespace {

constexpr int kPatience_ms = 10'000;  ///< for another program's transaction

}  // namespace

void fail_as(const SQLite::Exception& error, const std::string& file) {
    switch (error.getErrorCode() & 0xff) {
        case SQLITE_NOTADB: throw InputError(file + ": is not a database of results");
        case SQLITE_CORRUPT: throw InputError(file + ": is damaged or cut short");
        case SQLITE_CANTOPEN: throw InputError(file + ": cannot be opened");
        case SQLITE_BUSY:
        case SQLITE_LOCKED: throw InputError(file + ": is in use by another program");
        case SQLITE_READONLY:
        case SQLITE_PERM:
        case SQLITE_FULL:
        case SQLITE_IOERR: throw InputError(fmt::format("{}: {}", file, error.what()));
        default:
            throw InternalError(
                fmt::format("{}: SQLite: {} ({})", file, error.what(), error.getErrorCode()));
    }
}

SQLite::Database open_database(const std::filesystem::path& path, Access access) {
    if (access != Access::create && !is_there(path)) {
        throw InputError(path.string() + ": there is no such file");
    }
    if (is_folder(path)) {
        throw InputError(path.string() + ": is a directory, not a database of results");
    }
    try {
        return SQLite::Database(sqlite_path(path), static_cast<int>(access), kPatience_ms);
    } catch (const SQLite::Exception& error) {
        fail_as(error, path.string());
    }
}

std::string sqlite_path(const std::filesystem::path& path) {
    const bool as_uri = path.string().starts_with("file:");
    return (as_uri ? "." / path : path).string();
}

std::string sql_name(std::string_view name) {
    return fmt::format("\"{}\"", std::regex_replace(std::string(name), std::regex("\""), "\"\""));
}

}  // namespace limpet::campaign
