// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/pictures.hpp"

#include <fmt/format.h>

#include <system_error>

#include "limpet/core/errors.hpp"

namespace limpet::draw {
namespace {

namespace fs = std::filesystem;

void check(const std::error_code& problem, const fs::path& path) {
    if (problem) {
        throw InputError(fmt::format("cannot write {}: {}", path.string(), problem.message()));
    }
}

fs::path publish_one(const fs::path& file, const fs::path& folder) {
    const fs::path target = folder / file.filename();
    // The copy may cross file systems and take its time; the rename does neither.
    const fs::path part = folder / fmt::format(".{}.part", file.filename().string());
    std::error_code problem;
    fs::copy_file(file, part, fs::copy_options::overwrite_existing, problem);
    if (!problem) {
        fs::rename(part, target, problem);
    }
    if (problem) {
        std::error_code ignored;
        fs::remove(part, ignored);
    }
    check(problem, target);
    return target;
}

}  // namespace

std::vector<fs::path> publish(const std::vector<fs::path>& files, const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    check(problem, folder);
    std::vector<fs::path> published;
    for (const fs::path& file : files) {
        published.push_back(publish_one(file, folder));
    }
    return published;
}

}  // namespace limpet::draw
