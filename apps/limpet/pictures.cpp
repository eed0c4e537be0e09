// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/csv.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/report/figures.hpp"
#include "limpet/report/filmstrip.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

struct PictureOptions {
    std::string recording;
    std::string out;
};

using Draw =
    std::function<draw::Pictures(const record::Recording&, const std::filesystem::path& folder)>;

/// Reads, says what is missing, draws what is there, prints what was written.
void draw(const PictureOptions& options, const Draw& work) {
    const record::Recording recording = record::read_recording(options.recording);
    const std::filesystem::path beside = std::filesystem::path(options.recording).parent_path();
    const std::filesystem::path folder =
        options.out.empty() ? (beside.empty() ? std::filesystem::path(".") : beside)
                            : make_folder(options.out);
    const std::string damage =
        recording.damage.empty() ? "" : options.recording + ": " + recording.damage;
    draw::Pictures pictures;
    try {
        pictures = work(recording, folder);
    } catch (const InputError&) {
        if (damage.empty()) {
            throw;
        }
        throw InputError(damage);  // too little is whole to be used
    }
    for (const auto& file : pictures.files) {
        fmt::print("{}\n", file.string());
    }
    for (const std::string& missing : pictures.missing) {
        fmt::print(stderr, "limpet: {}\n", missing);
    }
    if (!damage.empty()) {
        throw InputError(damage);
    }
}

Verb picture_verb(const std::string& name, const std::string& about, Draw work) {
    auto options = std::make_shared<PictureOptions>();
    return {.name = name,
            .about = about,
            .options = {{"recording",
                         &options->recording,
                         "an .mcap file, also one that was cut short",
                         "RECORDING",
                         {.required = true}},
                        {"--out", &options->out, "folder (default: that of the recording)", "DIR"}},
            .footer =
                "Prints the files that it wrote. A damaged recording is used as far as it is "
                "whole;\n"
                "what is missing is said on standard error and the exit code is 2.\n",
            .run = [options, work = std::move(work)](const Given&) {
                draw(*options, work);
                return ExitCode::ok;
            }};
}

}  // namespace

Verb plot_verb() {
    return picture_verb(
        "plot", "Draw pressure, pitch, force, thrust and distance against time",
        [](const record::Recording& recording, const std::filesystem::path& folder) {
            return report::plot(recording, folder);
        });
}

Verb film_verb() {
    return picture_verb(
        "film", "Draw the manoeuvre as a filmstrip, rendered off-screen",
        [](const record::Recording& recording, const std::filesystem::path& folder) {
            return report::film(recording, folder);
        });
}

Verb csv_verb() {
    return picture_verb(
        "csv", "Write a recording as CSV, a file a topic, and the files attached to it",
        [](const record::Recording& recording, const std::filesystem::path& folder) {
            draw::Pictures written{.files = write_csv(recording, folder / "csv"), .missing = {}};
            for (const mcap::Attachment& attachment : recording.attachments) {
                const auto path = folder / "csv" / attachment.name;
                write_file(path, attachment.text);
                written.files.push_back(path);
            }
            return written;
        });
}

}  // namespace limpet::app
