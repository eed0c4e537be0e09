// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/mesh_address.hpp"

#include <charconv>
#include <pugixml.hpp>
#include <string_view>

#include "limpet/core/file_kind.hpp"
#include "limpet/core/read_file.hpp"

namespace limpet::models {

namespace fs = std::filesystem;

namespace {

bool is_package(const fs::path& folder, const std::string& name) {
    if (folder.filename() == name) {
        return true;
    }
    const fs::path manifest = folder / "package.xml";
    if (!is_file(manifest)) {
        return false;
    }
    pugi::xml_document document;
    const std::string text = read_file(manifest, {"package.xml", 1});
    return document.load_buffer(text.data(), text.size()) &&
           document.child("package").child("name").text().get() == name;
}

std::vector<fs::path> places_of(std::string uri, const fs::path& own) {
    for (const std::string_view scheme : {"package://", "model://"}) {
        if (uri.rfind(scheme, 0) != 0) {
            continue;
        }
        const std::size_t name = uri.find_first_not_of('/', scheme.size());  // some write three
        const fs::path within = name == uri.npos ? "" : uri.substr(name);
        const std::string package = within.empty() ? "" : within.begin()->string();
        const fs::path rest = within.lexically_relative(package);
        std::vector<fs::path> places;
        for (fs::path above = own; above.has_relative_path(); above = above.parent_path()) {
            if (is_package(above, package)) {
                places.push_back(above / rest);
            }
            places.push_back(above / within);  // a package next to one of these
        }
        places.push_back(own.parent_path() / rest);
        return places;
    }
    if (constexpr std::string_view kFile = "file://"; uri.rfind(kFile, 0) == 0) {
        uri.erase(0, kFile.size());
    }
    return {own / uri};
}

/// Without the %20 and so on of an address.
std::string decoded(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned byte = 0;
        const char* const digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2 && byte != 0) {
            text += static_cast<char>(byte);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

}  // namespace

std::vector<fs::path> mesh_places(const std::string& uri, const fs::path& folder) {
    std::vector<fs::path> places = places_of(uri, folder);
    if (const std::string plain = decoded(uri); plain != uri) {
        const std::vector<fs::path> more = places_of(plain, folder);
        places.insert(places.end(), more.begin(), more.end());
    }
    return places;
}

}  // namespace limpet::models
