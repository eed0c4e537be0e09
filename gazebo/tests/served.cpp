// SPDX-License-Identifier: Apache-2.0
#include "served.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "press_bench.hpp"

namespace limpet::gazebo11 {

Ended serve(const std::string& library, const std::string& inside, const std::string& more_models,
            const std::string& limit_s) {
    const TemporaryWorld world(
        bench_world("0 0 0", more_models,
                    "<plugin name='it' filename='" + library + "'>" + inside + "</plugin>"));
    ::setenv("GAZEBO_MASTER_URI", ("http://127.0.0.1:" + std::to_string(free_port())).c_str(), 1);
    ::setenv("GAZEBO_MODEL_DATABASE_URI", "", 1);
    ::setenv("GAZEBO_PLUGIN_PATH", LIMPET_PLUGIN_DIR, 1);
    ::setenv("ALSOFT_DRIVERS", "null", 1);
    const std::string command =
        "timeout -s KILL " + limit_s + " gzserver " + world.path() + " 2>&1";
    Ended ended;
    FILE* const pipe = ::popen(command.c_str(), "r");
    std::array<char, 4096> part{};
    while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe)) {
        ended.text.append(part.data(), size);
    }
    const int status = ::pclose(pipe);
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return ended;
}

void PrintTo(const Refused& refused, std::ostream* out) {
    *out << refused.name;
}

}  // namespace limpet::gazebo11
