// SPDX-License-Identifier: Apache-2.0
#include "limpet/paper/reproduce.hpp"

#include <fmt/core.h>

#include <chrono>
#include <string>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

using Clock = std::chrono::steady_clock;

struct ReproduceOptions {
    std::string out = "out/reproduce";
    std::string only;
    bool quick = false;
    int jobs = default_jobs();
};

std::string command_of(const ReproduceOptions& options) {
    return fmt::format("limpet reproduce --out {} --jobs {}{}{}", options.out, options.jobs,
                       options.quick ? " --quick" : "",
                       options.only.empty() ? "" : " --only " + options.only);
}

void fly_parts(const ReproduceOptions& options) {
    const Clock::time_point begin = Clock::now();
    Terminal terminal(Terminal::Voice::normal);
    std::string part;
    const paper::ReproduceWatch watch{
        .on_part =
            [&](std::size_t k, std::size_t of, const std::string& title) {
                const double past_s = std::chrono::duration<double>(Clock::now() - begin).count();
                part = fmt::format("{}/{}  {}", k, of, title);
                terminal.line(fmt::format("{:5.0f} s  {}", past_s, part));
            },
        .on_work =
            [&](const std::string& what) {
                if (terminal.live()) {
                    terminal.progress(part + ": " + what + " ...");
                } else {
                    terminal.line("            " + what);
                }
            },
        .stop = stop_on_signals()};
    draw::gnuplot::must_be_installed();
    const paper::Reproduction result = reproduce({.folder = make_folder(options.out),
                                                  .only = options.only,
                                                  .quick = options.quick,
                                                  .jobs = options.jobs,
                                                  .command = command_of(options)},
                                                 watch);
    terminal.line("");
    for (const report::Claim& claim : result.page.claims) {
        if (claim.verdict == report::Verdict::differs) {
            terminal.line(fmt::format("differs    {} ({}): {} {}", claim.statement, claim.section,
                                      report::to_text(claim.simulated), claim.unit));
        }
    }
    for (const std::string& one : result.hanging) {
        terminal.line("hangs on", one);
    }
    for (const std::string& note : result.notes) {
        terminal.line("note", note);
    }
    const auto count = [&](const char* name) {
        return result.counts.get(std::string("statements.") + name);
    };
    terminal.line("measured", fmt::format("{} claims reproduced, {} differ", count("measured"),
                                          count("measured_differs")));
    terminal.line("hang on", fmt::format("assumptions: {} claims, whatever their basis",
                                         count("hang_on_assumptions")));
    terminal.line("else", fmt::format("as set {}, recovered {}, fitted {}, by construction {}; {} "
                                      "of those differ; {} not modelled",
                                      count("as_set"), count("recovered"), count("fitted"),
                                      count("by_construction"), count("others_differ"),
                                      count("not_modelled")));
    terminal.written(result.files);
}

ExitCode reproduce_paper(const ReproduceOptions& options) {
    try {
        fly_parts(options);
    } catch (const Interrupted&) {
        throw Interrupted("stopped; no page was written");
    }
    return ExitCode::ok;
}

OptionList options_of(ReproduceOptions& options) {
    std::vector<std::string> names;
    for (const auto& [name, title] : paper::part_titles()) {
        names.push_back(name);
    }
    return {{"--out DIR", &options.out, "folder (default: out/reproduce)"},
            {"--only NAME", &options.only, "one part, named below", one_of(names)},
            {"--quick", &options.quick, "fewer missions, coarser maps; two or three minutes"},
            jobs_option(options.jobs)};
}

}  // namespace

Verb reproduce_verb() {
    std::string footer = "Parts:\n";
    for (const auto& [name, title] : paper::part_titles()) {
        footer += fmt::format("  {:<12} {}\n", name, title);
    }
    return verb<ReproduceOptions>(
        "reproduce", "Fly the paper's experiments; its tables, figures, claims on one page",
        options_of, reproduce_paper,
        footer +
            "\nWrites index.html (opens offline), results.json, figures/, and the recordings\n"
            "and campaigns behind them.\n");
}

}  // namespace limpet::app
