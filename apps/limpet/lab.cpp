// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/lab.hpp"

#include <fmt/core.h>

#include <chrono>
#include <string>
#include <thread>

#include "command_line.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

struct LabOptions {
    std::string scenario = "perch_concrete";
    std::string listen = "127.0.0.1";
    int port = 0;
    std::string out;
    bool open = false;
};

OptionList options_of(LabOptions& options) {
    return {{"scenario SCENARIO", &options.scenario, "name (limpet list scenarios) to begin with",
             optional()},
            {"--port PORT", &options.port, "to listen on (0: any that is free)", range(0, 65535)},
            {"--listen ADDRESS", &options.listen,
             "address of this machine to listen on (default: this machine alone)"},
            {"--out DIR", &options.out,
             "keep results of campaigns there (default: they go with the lab)"},
            {"--open", &options.open, "open the page in a browser"}};
}

ExitCode run_lab(const LabOptions& options) {
    const std::atomic<bool>* stop = stop_on_signals();
    lab::Lab lab(options.scenario, stop, options.out);
    serve::Server server({.host = options.listen,
                          .port = static_cast<std::uint16_t>(options.port),
                          .token = serve::make_token()});
    lab.serve_on(server);
    server.start();
    Terminal terminal(Terminal::Voice::normal);
    terminal.line("lab", server.address());
    terminal.line("", "whoever has this address may fly here; Ctrl-C ends it");
    if (options.open) {
        open_in_browser(server.address());
    }
    while (!*stop) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    server.stop();
    return ExitCode::ok;
}

}  // namespace

Verb lab_verb() {
    return verb<LabOptions>("lab", "Re-fly a scenario in a browser while its numbers change",
                            options_of, run_lab,
                            "A page on this machine alone: every parameter a slider with its "
                            "range, unit and source; the\n"
                            "flight follows while one is dragged, the last one stays as a ghost. "
                            "What was changed is in\n"
                            "the page's address, and can be saved as YAML or as a command. Many: a "
                            "campaign, each of its\nflights a point to look at. Learn: what a "
                            "number depends on. Live: a flight in "
                            "progress.\n");
}

}  // namespace limpet::app
