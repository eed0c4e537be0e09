// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/process.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/spawn.hpp"

namespace limpet::px4 {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAirframes = "airframes";
constexpr const char* kScripts = "init.d-posix";

void write(const fs::path& path, const std::string& text) {
    std::ofstream file(path);
    file << text;
    if (!file.flush()) {
        throw InputError(path.string() + ": cannot be written");
    }
}

/// A folder with the same in it, but for one name.
void mirror(const fs::path& from, const fs::path& to, const std::string& but) {
    fs::create_directory(to);
    for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
        if (entry.path().filename() != but) {
            fs::create_symlink(entry.path(), to / entry.path().filename());
        }
    }
}

/// PX4's start-up files with the airframe among them.
void lay_out(const fs::path& build, const fs::path& folder, const Px4Airframe& airframe) {
    const fs::path etc = build / "etc";
    const fs::path airframes = folder / "etc" / kScripts / kAirframes;
    mirror(etc, folder / "etc", kScripts);
    mirror(etc / kScripts, folder / "etc" / kScripts, kAirframes);
    mirror(etc / kScripts / kAirframes, airframes, px4_airframe_file_name(airframe));
    write(airframes / px4_airframe_file_name(airframe),
          px4_airframe_script(airframe, px4_settings(airframe)));
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
    std::string name = (fs::temp_directory_path() / "limpet_px4_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
        throw InputError(fmt::format("{}: cannot be made: {}", name, std::strerror(errno)));
    }
    path = name;
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
        lay_out(build, folder, airframe);
        command_ = fmt::format(
            "PX4_LIMPET_STANDALONE=1 PX4_SYS_AUTOSTART={} exec {} -d -i {} -w {}", airframe.id,
            quoted(program.string()), instance.number, quoted(folder.string()));
    } else {
        write(folder / (airframe.name + ".params"),
              px4_params_text(airframe, px4_settings(airframe)));
        command_ = replaced(replaced(start, "{instance}", std::to_string(instance.number)),
                            "{folder}", quoted(folder.string()));
    }
    child_ = run(command_, folder / "log.txt");
}

Px4Process::~Px4Process() {
    if (child_ != 0) {
        // Its clock stands still once our sensors stop: it would not get through an orderly end.
        kill(-child_, SIGKILL);
        wait_for(child_);
    }
}

void Px4Process::require_running() {
    if (child_ != 0 && waitpid(child_, nullptr, WNOHANG) == child_) {
        kill(-child_, SIGKILL);
        child_ = 0;
    }
    if (child_ == 0) {
        const std::string last = last_line(folder_.path / "log.txt");
        throw InputError(fmt::format("{}: ended by itself{}", command_,
                                     last.empty() ? "" : ", its last line: " + last));
    }
}

}  // namespace limpet::px4
