// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/gnuplot.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "limpet/core/errors.hpp"
#include "limpet/core/spawn.hpp"

namespace limpet::draw::gnuplot {
namespace {

constexpr const char* kScript = "script.gp";
constexpr const char* kLog = "gnuplot.log";

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::error_code problem;
    std::string name = (std::filesystem::temp_directory_path(problem) / "limpet.XXXXXX").string();
    if (problem || mkdtemp(name.data()) == nullptr) {
        throw InputError(fmt::format("cannot make a temporary folder {}: {}", name,
                                     problem ? problem.message() : std::strerror(errno)));
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string literal(std::string_view text) {
    constexpr std::string_view kPlain = " .,:;_+-=/()[]#&%~";
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20) {
            out += ' ';
        } else if (byte >= 0x80 || std::isalnum(byte) != 0 || kPlain.find(c) != kPlain.npos) {
            out += c;
        } else {
            out += fmt::format("\\{:03o}", byte);
        }
    }
    return out + "\"";
}

void run(const std::filesystem::path& folder, const std::string& script) {
    std::ofstream file(folder / kScript, std::ios::binary);
    file << script;
    file.close();
    if (!file) {
        throw InputError(fmt::format("cannot write {}", (folder / kScript).string()));
    }
    // -d: the user's own start-up files shall not colour the figures.
    const auto [child, problem] =
        spawn({.words = {"gnuplot", "-d", kScript}, .folder = folder, .output = folder / kLog});
    if (problem == ENOENT || problem == EACCES) {
        throw NotInstalled("gnuplot is not installed (apt-get install gnuplot-nox)");
    }
    if (problem != 0) {
        throw InputError(fmt::format("gnuplot cannot be started: {}", std::strerror(problem)));
    }
    const int status = wait_for(child);
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM)) {
        throw Interrupted("interrupted while a figure was drawn");  // Ctrl-C reaches both
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw InternalError(
            fmt::format("gnuplot failed (status {}): {}", status, read_text(folder / kLog)));
    }
}

void must_be_installed() {
    const TemporaryFolder folder;
    run(folder.path(), "");
}

}  // namespace limpet::draw::gnuplot
