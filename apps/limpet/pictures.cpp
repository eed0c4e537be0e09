// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/work.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "limpet/record/csv.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/report/figures.hpp"
#include "limpet/report/filmstrip.hpp"
#include "limpet/ulog/ulog.hpp"
#include "output.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

struct PictureOptions {
    std::string recording;
    std::string out;
    std::string video;
};

using Draw = std::function<draw::Pictures(const record::Recording&,
                                          const std::filesystem::path& folder, const Work& work)>;

/// Reads a recording, draws what is whole, prints the files written, reports what is missing.
void draw(const PictureOptions& options, const Draw& draw_it) {
    Terminal terminal(Terminal::Voice::machine);  // standard output lists the files
    const Work work{.tell = [&terminal](const std::string& what) { terminal.slow_progress(what); },
                    .stop = stop_on_signals()};
    const record::Recording recording = record::read_recording(options.recording);
    work.say();
    const std::filesystem::path folder = folder_or_next_to(options.out, options.recording);
    const std::string damage =
        recording.damage.empty() ? "" : options.recording + ": " + recording.damage;
    draw::Pictures pictures;
    try {
        pictures = draw_it(recording, folder, work);
    } catch (const InputError&) {
        if (damage.empty()) {
            throw;
        }
        throw InputError(damage);  // too little is whole to be used
    }
    terminal.progress("");
    print_files(pictures.files);
    for (const std::string& missing : pictures.missing) {
        complain(missing);
    }
    if (!damage.empty()) {
        throw InputError(damage);
    }
}

OptionList options_of(PictureOptions& options) {
    return {
        {"recording RECORDING", &options.recording, "an .mcap file, also one that was cut short"},
        {"--out DIR", &options.out, "folder (default: that of the recording)"}};
}

constexpr const char* kFooter =
    "Prints the files that it wrote. A damaged recording is used as far as it is whole;\n"
    "missing parts are reported on standard error and the exit code is 2.\n";

Verb picture_verb(const char* name, const char* about, const Draw& work) {
    return verb<PictureOptions>(
        name, about, options_of, [work](const PictureOptions& options) { draw(options, work); },
        kFooter);
}

/// The recording as tables, with what is attached to it.
draw::Pictures write_tables(const record::Recording& recording, const std::filesystem::path& folder,
                            const Work& work) {
    require_plain_names(recording);
    const draw::gnuplot::TemporaryFolder scratch;  // all of them or none
    std::vector<std::filesystem::path> files = write_csv(recording, scratch.path() / "csv", work);
    const auto attached = write_attachments(recording, scratch.path() / "csv");
    files.insert(files.end(), attached.begin(), attached.end());
    work.say();
    std::vector<std::string> remarks = record::renamed_topics(recording);
    remarks.insert(remarks.end(), recording.remarks.begin(), recording.remarks.end());
    return {.files = draw::publish(files, folder / "csv"), .missing = std::move(remarks)};
}

/// Next to the recording, or in a folder, under its name.
draw::Pictures write_px4_log(const record::Recording& recording,
                             const std::filesystem::path& folder, const Work&) {
    const std::filesystem::path file = folder / (recording.path.stem().string() + ".ulg");
    ulog::write_ulog(recording, file);
    return {.files = {file}, .missing = {}};
}

OptionList film_options_of(PictureOptions& options) {
    OptionList list = options_of(options);
    list.push_back({"--video KIND", &options.video,
                    "a video next to each strip, by the same cameras", one_of({"mp4", "webm"})});
    return list;
}

}  // namespace

Verb plot_verb() {
    return picture_verb("plot", "Draw pressure, pitch, force, thrust and distance against time",
                        [](const auto& recording, const auto& folder, const Work& work) {
                            return report::plot(recording, folder, work);
                        });
}

Verb film_verb() {
    return verb<PictureOptions>(
        "film", "Draw the manoeuvre as a filmstrip, rendered off-screen, or as a video",
        film_options_of,
        [](const PictureOptions& options) {
            draw(options, [&options](const record::Recording& recording,
                                     const std::filesystem::path& folder, const Work& work) {
                return report::film(recording, folder, work, options.video);
            });
        },
        std::string(kFooter) +
            "A video is made by ffmpeg (apt-get install ffmpeg), 25 frames a second.\n");
}

Verb csv_verb() {
    return picture_verb("csv",
                        "Write a recording as CSV, a file a topic, and the files attached to it",
                        write_tables);
}

Verb ulog_verb() {
    return picture_verb("ulog", "Write a recording as a PX4 log, for Flight Review and PlotJuggler",
                        write_px4_log);
}

}  // namespace limpet::app
