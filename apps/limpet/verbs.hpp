// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace limpet::app {

/// What the program hands back to the shell.
enum class ExitCode {
    ok = 0,
    other_outcome = 1,  ///< --expect named another one; companion: control handed back
    bad_input = 2,      ///< also a damaged recording
    our_fault = 70,
    interrupted = 130,  ///< by Ctrl-C, as a shell has it
};

/// Each adds one verb with its options; its callback does the work.
void add_fly(CLI::App& app, ExitCode& code);
void add_sim_io(CLI::App& app, ExitCode& code);
void add_companion(CLI::App& app, ExitCode& code);
void add_check(CLI::App& app);
void add_list(CLI::App& app);
void add_params(CLI::App& app);
void add_px4_params(CLI::App& app);
void add_plot(CLI::App& app);
void add_film(CLI::App& app);
void add_csv(CLI::App& app);
void add_compare(CLI::App& app, ExitCode& code);
void add_export(CLI::App& app);
void add_campaign(CLI::App& app, ExitCode& code);
void add_replay(CLI::App& app);
void add_reproduce(CLI::App& app, ExitCode& code);
void add_summary(CLI::App& app);
void add_rotor(CLI::App& app);
void add_identify(CLI::App& app);
void add_stand_in(CLI::App& app);

}  // namespace limpet::app
