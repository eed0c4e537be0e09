// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"
#include "terminal.hpp"

namespace {

using limpet::app::ExitCode;

// Lines of 78 columns at most, which a terminal of 80 does not fold.
constexpr const char* kAbout =
    "Limpet simulates perching on walls with a suction cup: a quadrotor flies up to\n"
    "a wall, presses its cup on it, lands on it, rests with its motors off, takes\n"
    "off and comes back.";

constexpr const char* kFooter =
    "Start here:\n"
    "  limpet fly perch_concrete       one flight, recording and figures in out/\n"
    "  limpet list scenarios           what there is to fly\n"
    "  limpet fly perch_metal --set suction.valve_fitted=true\n"
    "  limpet params guidance          every number that --set can turn\n"
    "  limpet campaign impact_speed    many flights; then limpet summary, replay\n"
    "  limpet help VERB                what a verb takes; help --man and\n"
    "                                  help --completion bash: all of it\n\n"
    "Exit codes: 0 done, 1 another outcome than --expect or control handed back,\n"
    "2 bad input, 70 a fault of ours, 130 interrupted.\n";

constexpr const char* kNoOutput = "standard output cannot be written";

int fail(ExitCode code, const std::string& message) {
    limpet::app::complain(message);
    return static_cast<int>(code);
}

/// A file that is opened must not become standard error, or a recording holds our messages. What is
/// written to a standard output that was closed fails, as it should.
void fill_closed_streams() {
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        if (fcntl(stream, F_GETFD) < 0) {
            (void)open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    fill_closed_streams();
    std::signal(SIGXFSZ, SIG_IGN);  // a full disk is an error to report, not a death
    try {
        const ExitCode code =
            limpet::app::run({.name = "limpet",
                              .about = kAbout,
                              .footer = kFooter,
                              .version = "limpet " + std::string(limpet::kVersion),
                              .verbs = limpet::app::all_verbs()},
                             argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            return fail(ExitCode::bad_input, kNoOutput);
        }
        return static_cast<int>(code);
    } catch (const limpet::Interrupted& error) {
        return fail(ExitCode::interrupted, error.what());
    } catch (const limpet::InputError& error) {
        return fail(ExitCode::bad_input, error.what());
    } catch (const std::filesystem::filesystem_error& error) {  // a link to itself, no room
        return fail(ExitCode::bad_input, error.path1().string() + ": " + error.code().message());
    } catch (const std::exception& error) {
        if (std::ferror(stdout) != 0) {
            return fail(ExitCode::bad_input, kNoOutput);
        }
        return fail(ExitCode::our_fault, std::string("a fault of ours: ") + error.what());
    }
}
