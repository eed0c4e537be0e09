// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/process.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/spawn.hpp"

namespace limpet::px4 {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAirframes = "airframes";
constexpr const char* kScripts = "init.d-posix";
constexpr const char* kConsole = "log.txt";
constexpr std::string_view kFolder = "limpet_px4_run_";

void write(const fs::path& path, const std::string& text) {
    std::ofstream file(path);
    file << text;
    if (!file.flush()) {
        throw InputError(path.string() + ": cannot be written");
    }
}

/// A folder with the same in it.
/// @param but  a name that is left out; all that begin so where it ends in an underscore
void mirror(const fs::path& from, const fs::path& to, std::string_view but) {
    fs::create_directory(to);
    for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
        const std::string name = entry.path().filename().string();
        if (!(but.ends_with('_') ? name.starts_with(but) : name == but)) {
            fs::create_symlink(entry.path(), to / entry.path().filename());
        }
    }
}

/// PX4's start-up files with the airframe among them.
void lay_out(const fs::path& build, const fs::path& folder, const Px4Airframe& airframe,
             const std::vector<Px4Setting>& settings) {
    const fs::path etc = build / "etc";
    const fs::path airframes = folder / "etc" / kScripts / kAirframes;
    mirror(etc, folder / "etc", kScripts);
    mirror(etc / kScripts, folder / "etc" / kScripts, kAirframes);
    // PX4 takes the last of a number, whatever comes after it.
    mirror(etc / kScripts / kAirframes, airframes, fmt::format("{}_", airframe.id));
    write(airframes / px4_airframe_file_name(airframe), px4_airframe_script(airframe, settings));
}

std::string quoted(const std::string& text) {
    std::string safe = "'";
    for (const char letter : text) {
        safe += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    }
    return safe + "'";
}

std::string replaced(std::string text, const std::string& mark, const std::string& by) {
    for (std::size_t at = text.find(mark); at != std::string::npos;
         at = text.find(mark, at + by.size())) {
        text.replace(at, mark.size(), by);
    }
    return text;
}

std::string last_line(const fs::path& log) {
    std::ifstream file(log);
    std::string last;
    for (std::string line; std::getline(file, line);) {
        last = line.empty() ? last : line;
    }
    return last;
}

/// Folders whose process was killed: nobody holds their lock. One that has just been made has none
/// either, for a moment: a minute old it is nobody's.
void sweep() {
    constexpr auto kYoung = std::chrono::minutes(1);
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(fs::temp_directory_path(), ignored)) {
        const fs::path& folder = entry.path();
        if (!folder.filename().string().starts_with(kFolder) ||
            !fs::is_directory(folder, ignored)) {
            continue;
        }
        const auto made = fs::last_write_time(folder, ignored);
        if (ignored || fs::file_time_type::clock::now() - made < kYoung) {
            continue;
        }
        try {
            const FolderLock nobodys(folder);
            fs::remove_all(folder, ignored);
        } catch (const InputError&) {  // another's, or somebody is at work in it
        }
    }
}

/// PX4's own logs below a folder, oldest first: it names them by date and time, or counts.
std::vector<fs::path> logs_in(const fs::path& folder) {
    std::vector<fs::path> logs;
    std::error_code ignored;
    for (auto entry = fs::recursive_directory_iterator(folder / "log", ignored);
         !ignored && entry != fs::recursive_directory_iterator(); entry.increment(ignored)) {
        if (entry->path().extension() == ".ulg") {
            logs.push_back(entry->path());
        }
    }
    std::sort(logs.begin(), logs.end());
    return logs;
}

fs::path kept_log(const fs::path& folder, std::size_t i) {
    return folder / (i == 0 ? "px4.ulg" : fmt::format("px4_{}.ulg", i + 1));
}

void copy_over(const fs::path& from, const fs::path& to) {
    std::error_code error;
    if (!fs::copy_file(from, to, fs::copy_options::overwrite_existing, error)) {
        throw InputError(fmt::format("{}: cannot be written: {}", to.string(), error.message()));
    }
}

/// As sh runs it, in a group of its own: Ctrl-C is for us, which end it. The kernel ends it when
/// the thread that started it dies, however that came about.
pid_t run(const std::string& command, const fs::path& log) {
    const auto [child, problem] =
        spawn({.words = {"setpriv", "--pdeathsig", "KILL", "--", "sh", "-c", command},
               .output = log,
               .own_group = true});
    if (problem != 0) {
        throw InputError(fmt::format("setpriv, which starts PX4, cannot be started: {}",
                                     std::strerror(problem)));
    }
    return child;
}

}  // namespace

Px4Process::Folder::Folder() {
    sweep();
    std::string name = (fs::temp_directory_path() / fmt::format("{}XXXXXX", kFolder)).string();
    if (mkdtemp(name.data()) == nullptr) {
        throw InputError(fmt::format("{}: cannot be made: {}", name, std::strerror(errno)));
    }
    path = name;
    lock_.emplace(path);
}

Px4Process::Folder::~Folder() {
    std::error_code ignored;  // temporary: who cleans up has the rest
    fs::remove_all(path, ignored);
}

Px4Process::Px4Process(const std::string& start, const Px4Airframe& airframe,
                       const Px4Instance& instance) {
    const fs::path& folder = folder_.path;
    std::error_code ignored;
    if (fs::is_directory(start, ignored)) {
        const fs::path build = fs::absolute(start).lexically_normal();
        const fs::path program = build / "bin/px4";
        if (!fs::exists(program, ignored) ||
            !fs::is_directory(build / "etc" / kScripts / kAirframes, ignored)) {
            throw InputError(start + ": no PX4 built for simulation is there (bin/px4, etc)");
        }
        Px4Fitted fit{.settings = px4_settings(airframe), .left_out = {}};
        if (const auto known = px4_facts_of(build)) {
            fit = fitted(fit.settings, *known);
        }
        left_out_ = std::move(fit.left_out);
        lay_out(build, folder, airframe, fit.settings);
        command_ = fmt::format(
            "PX4_LIMPET_STANDALONE=1 PX4_SYS_AUTOSTART={} exec {} -d -i {} -w {}", airframe.id,
            quoted(program.string()), instance.number, quoted(folder.string()));
    } else {
        write(folder / (airframe.name + ".params"),
              px4_params_text(airframe, px4_settings(airframe)));
        command_ = replaced(replaced(start, "{instance}", std::to_string(instance.number)),
                            "{folder}", quoted(folder.string()));
    }
    child_ = run(command_, folder / kConsole);
}

Px4Process::~Px4Process() {
    end();
}

void Px4Process::end() {
    if (child_ != 0) {
        // Its clock stands still once our sensors stop: it would not get through an orderly end.
        kill(-child_, SIGKILL);
        wait_for(child_);
        child_ = 0;
    }
}

std::vector<fs::path> Px4Process::keep(const fs::path& folder) {
    end();
    std::error_code ignored;
    for (std::size_t i = 0; fs::remove(kept_log(folder, i), ignored); ++i) {
    }
    std::vector<fs::path> kept = {folder / "px4.log"};
    copy_over(folder_.path / kConsole, kept.front());
    for (const fs::path& log : logs_in(folder_.path)) {
        kept.push_back(kept_log(folder, kept.size() - 1));
        copy_over(log, kept.back());
    }
    return kept;
}

void Px4Process::require_running() {
    if (child_ != 0 && waitpid(child_, nullptr, WNOHANG) == child_) {
        kill(-child_, SIGKILL);
        child_ = 0;
    }
    if (child_ == 0) {
        const std::string last = last_line(folder_.path / kConsole);
        throw InputError(fmt::format("{}: ended by itself{}", command_,
                                     last.empty() ? "" : ", its last line: " + last));
    }
}

}  // namespace limpet::px4
