// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet::campaign {

enum class Access {
    read = SQLITE_OPEN_READONLY,
    write = SQLITE_OPEN_READWRITE,                        ///< of a file that is there
    create = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE,  ///< a new one in its place
};

/// @throws InputError that names the file: there is none, it is a directory, cannot be opened
[[nodiscard]] SQLite::Database open_database(const std::filesystem::path& path, Access access);

/// @throws InputError for what is wrong with the file (damaged, locked, full disk), InternalError
///         for what is wrong with our SQL
[[noreturn]] void fail_as(const SQLite::Exception& error, const std::string& file);

/// @throws InputError "FILE: why"
template <class... Values>
[[noreturn]] void refuse(const SQLite::Database& database, fmt::format_string<Values...> why,
                         Values&&... values) {
    throw InputError(database.getFilename() + ": " +
                     fmt::format(why, std::forward<Values>(values)...));
}

/// Queries a database; its errors are those of fail_as().
template <class Work>
auto asking(const SQLite::Database& database, const Work& work) {
    try {
        return work();
    } catch (const SQLite::Exception& error) {
        fail_as(error, database.getFilename());
    }
}

/// @return the path as SQLite takes it, which would read "file:..." as an address
[[nodiscard]] std::string sqlite_path(const std::filesystem::path& path);

/// @return the name as SQL takes it, whatever it holds: "guidance.dock_speed_m_s"
[[nodiscard]] std::string sql_name(std::string_view name);

}  // namespace limpet::campaign
