// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Pieces of HTML.
namespace limpet::draw::html {

/// Text as text, also within quotes.
[[nodiscard]] std::string escaped(std::string_view text);

/// Escaped, with **bold** and `code`; marks without a partner stay as they are.
[[nodiscard]] std::string marked_up(std::string_view text);

/// A path relative to the page as the value of an href; whatever it holds it names a file.
[[nodiscard]] std::string link(std::string_view relative_path);

[[nodiscard]] std::string base64(std::string_view bytes);

/// An image as it stands in a page.
struct Embedded {
    std::string uri;  ///< "data:image/png;base64,..."
    int width_px = 0;
    int height_px = 0;
};
/// @param bytes  of a PNG or of an SVG made by gnuplot
/// @throws InternalError for anything else
[[nodiscard]] Embedded embedded(std::string bytes);

}  // namespace limpet::draw::html
