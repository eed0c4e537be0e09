// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

#include "limpet/core/errors.hpp"
#include "limpet/draw/html.hpp"
#include "limpet/mcap/reader.hpp"
#include "limpet/record/scene.hpp"

// The page, as adapters/web/ has made it, stands in the program.
asm(R"(
    .pushsection .rodata
    .global limpet_view_page
    .global limpet_view_page_end
limpet_view_page:
    .incbin ")" LIMPET_VIEW_PAGE R"("
limpet_view_page_end:
    .byte 0
    .popsection
)");
extern "C" const char limpet_view_page[];
extern "C" const char limpet_view_page_end[];

namespace limpet::report {
namespace {

std::string_view bare_page() {
    return {limpet_view_page, static_cast<std::size_t>(limpet_view_page_end - limpet_view_page)};
}

/// Recordings of one name are named by their folder: every flight's recording is flight.mcap.
std::string title_of(const std::filesystem::path& recording) {
    const std::string folder = recording.parent_path().filename().string();
    return recording.stem() == "flight" && !folder.empty() ? folder : recording.stem().string();
}

std::string bytes_of(const std::filesystem::path& recording) {
    std::ifstream file(recording, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// @throws InputError when the page could not show it
void require_scene(const std::filesystem::path& recording) {
    const mcap::Contents contents = mcap::read(recording, {});
    if (!std::any_of(contents.channels.begin(), contents.channels.end(), [](const auto& channel) {
            return channel.second.topic == record::kDescriptionTopic;
        })) {
        throw InputError(fmt::format(
            "{}: there is no {} in it: recorded before scenes were, or by a companion, which sees "
            "none; `limpet fly` records one",
            recording.string(), record::kDescriptionTopic));
    }
}

}  // namespace

bool has_view_page() {
    return !bare_page().empty();
}

std::string_view view_page() {
    if (!has_view_page()) {
        throw InputError(
            "this program was built without the page: install nodejs and npm and build it again");
    }
    return bare_page();
}

std::string view_html(const std::vector<std::filesystem::path>& recordings) {
    constexpr std::string_view kPlace = "<!--RECORDINGS-->";
    const std::string_view page = view_page();
    const std::size_t place = page.find(kPlace);
    require(place != std::string_view::npos, "a page with a place for recordings");
    std::string html(page.substr(0, place));
    for (const std::filesystem::path& recording : recordings) {
        require_scene(recording);
        html += fmt::format(
            "<script type=\"application/octet-stream\" data-recording=\"{}\">{}</script>\n",
            draw::html::escaped(title_of(recording)), draw::html::base64(bytes_of(recording)));
    }
    html += page.substr(place + kPlace.size());
    return html;
}

}  // namespace limpet::report
