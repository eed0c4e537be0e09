// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/write_file.hpp"

#include <cstdio>
#include <fstream>
#include <system_error>

namespace limpet {
namespace {

namespace fs = std::filesystem;

bool write_as(const fs::path& path, std::string_view text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    return static_cast<bool>(file);
}

}  // namespace

bool write_file(const fs::path& path, std::string_view text) {
    if (path == "/dev/stdout") {  // where others have written before, and we go on
        return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
               std::fflush(stdout) == 0;
    }
    std::error_code error;
    if (fs::is_symlink(path, error) ||
        (fs::exists(path, error) && !fs::is_regular_file(path, error))) {
        return write_as(path, text);
    }
    const fs::path part = path.string() + ".part";
    error.clear();
    if (write_as(part, text)) {
        fs::rename(part, path, error);
        if (!error) {
            return true;
        }
    }
    fs::remove(part, error);
    return false;
}

}  // namespace limpet
