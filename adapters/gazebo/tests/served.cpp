// SPDX-License-Identifier: Apache-2.0
#include "served.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "press_bench.hpp"

namespace limpet::gazebo11 {

Ended serve(const std::string& library, const std::string& inside, const std::string& limit_s,
            const std::string& engine) {
    const TemporaryWorld world(bench_world(
        "0 0 0", box_model("ball", "3 0 0 0 0 0", "0.1 0.1 0.1", false),
        "<plugin name='it' filename='" + library + "'>" + inside + "</plugin>", engine));
    set_environment();
    ::setenv("GAZEBO_PLUGIN_PATH", LIMPET_PLUGIN_DIR, 1);
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

Refused cup(const std::string& name, const std::string& inside, const std::string& line) {
    return {name, kCup, "<link>hull</link>" + inside,
            "model body: LimpetSuctionCupPlugin: " + line};
}

Refused vehicle(const std::string& name, const std::string& inside, const std::string& line,
                const char* library) {
    return {name, library, "<scenario>hover</scenario>" + inside,
            std::string("model body: ") + library + ": " + line};
}

}  // namespace limpet::gazebo11
