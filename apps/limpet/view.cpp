// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/view.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recording.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

struct ViewOptions {
    std::vector<std::string> recordings;
    std::string out;
    bool open = false;
};

void view(const ViewOptions& options) {
    const std::vector<std::filesystem::path> recordings(options.recordings.begin(),
                                                        options.recordings.end());
    const std::string html = report::view_html(recordings);
    const std::filesystem::path page =
        folder_or_next_to(options.out, options.recordings.front()) / "view.html";
    write_file(page, html);
    print_files({page});
    if (options.open) {
        open_in_browser(page);
    }
    for (const std::filesystem::path& recording : recordings) {
        if (const std::string damage = record::read_recording(recording).damage; !damage.empty()) {
            throw InputError(recording.string() + ": " + damage);
        }
    }
}

OptionList options_of(ViewOptions& options) {
    constexpr int kMost = 20;  // a page that a browser still opens
    return {{"recording RECORDING", &options.recordings,
             "flight.mcap of a flight; further ones fly with it, translucent", values(1, kMost)},
            {"--out DIR", &options.out, "folder (default: that of the first recording)"},
            {"--open", &options.open, "open the page in a browser"}};
}

}  // namespace

Verb view_verb() {
    return verb<ViewOptions>(
        "view", "Show flights in a browser, in three dimensions, with charts", options_of, view,
        "Writes view.html, one file that needs no network and can be sent: time line, events,\n"
        "charts with one cursor, cameras. It also opens recordings that are dropped on it.\nWhat "
        "is "
        "missing of a damaged recording is reported on standard error, and the exit code is 2.\n");
}

}  // namespace limpet::app
