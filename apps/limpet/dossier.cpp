// SPDX-License-Identifier: Apache-2.0
#include "limpet/dossier/dossier.hpp"

#include <fmt/core.h>

#include <string>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

struct DossierChoices {
    std::string file;
    std::string out = "out/dossier";
    bool quick = false;
    int jobs = default_jobs();
};

ExitCode make_dossier(const DossierChoices& options) {
    Terminal terminal(Terminal::Voice::normal);
    const dossier::DossierWatch watch{.on_work =
                                          [&terminal](const std::string& what) {
                                              if (terminal.live()) {
                                                  terminal.progress(what + " ...");
                                              } else {
                                                  terminal.line(what);
                                              }
                                          },
                                      .stop = stop_on_signals()};
    draw::gnuplot::must_be_installed();
    const OutFolder folder(options.out);
    try {
        const auto files = write_dossier(
            {.folder = folder.path(),
             .file = options.file,
             .quick = options.quick,
             .jobs = options.jobs,
             .command = fmt::format("limpet dossier{}{} --out {} --jobs {}",
                                    options.file.empty() ? "" : " --file " + options.file,
                                    options.quick ? " --quick" : "", options.out, options.jobs)},
            watch);
        terminal.written(files);
    } catch (const Interrupted&) {
        throw Interrupted("stopped; no page was written");
    }
    return ExitCode::ok;
}

OptionList options_of(DossierChoices& options) {
    return {
        {"--file YAML", &options.file, "the questions (default: paper/dossier.yaml of the data)"},
        {"--out DIR", &options.out, "folder (default: out/dossier)"},
        {"--quick", &options.quick, "fewer flights, the same questions"},
        jobs_option(options.jobs)};
}

}  // namespace

Verb dossier_verb() {
    return verb<DossierChoices>(
        "dossier", "Write a credibility report: errors, inputs, evidence and bounds", options_of,
        make_dossier,
        "In the shape of NASA-STD-7009 and ASME V&V 40, from campaigns and tests that it flies "
        "itself: over\nseeds, with finer steps, on another engine, over uncertain inputs, and "
        "the paper's statements\nthat are its evidence. Writes index.html (opens offline), "
        "results.json\nand the runs behind each number.\n");
}

}  // namespace limpet::app
