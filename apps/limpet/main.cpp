// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

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

/// Allocates nothing.
ExitCode out_of_memory() noexcept {
    constexpr std::string_view kLine =
        "limpet: out of memory, or of threads: fewer jobs (--jobs), a smaller file, or a larger "
        "limit (ulimit -v, -u)\n";
    (void)!write(STDERR_FILENO, kLine.data(), kLine.size());
    return ExitCode::bad_input;
}

bool is_shortage(const std::error_code& code) {
    return code == std::errc::resource_unavailable_try_again ||
           code == std::errc::not_enough_memory;
}

/// Without memory the program may end where nothing can be caught.
[[noreturn]] void end_in_a_line() noexcept {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) {
            std::rethrow_exception(thrown);
        }
    } catch (const std::bad_alloc&) {
        _exit(static_cast<int>(out_of_memory()));
    } catch (...) {  // a fault of ours: its place is worth more than a line
    }
    std::abort();
}

}  // namespace

int main(int argc, char** argv) {
    fill_closed_streams();
    std::set_terminate(end_in_a_line);
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
    } catch (const std::filesystem::filesystem_error& error) {  // a link to itself, a full disk
        return fail(ExitCode::bad_input, error.path1().string() + ": " + error.code().message());
    } catch (const std::bad_alloc&) {
        return static_cast<int>(out_of_memory());
    } catch (const std::exception& error) {
        const auto* const of_system = dynamic_cast<const std::system_error*>(&error);
        if (of_system != nullptr && is_shortage(of_system->code())) {
            return static_cast<int>(out_of_memory());
        }
        if (std::ferror(stdout) != 0) {
            return fail(ExitCode::bad_input, kNoOutput);
        }
        return fail(ExitCode::our_fault, std::string("a fault of ours: ") + error.what());
    }
}
