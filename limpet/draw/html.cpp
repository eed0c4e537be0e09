// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/html.hpp"

#include <fmt/format.h>
#include <nettle/base64.h>

#include <cctype>
#include <cstdint>
#include <cstdio>
#include <regex>

#include "limpet/core/errors.hpp"

namespace limpet::draw::html {
namespace {

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value = value << 8u | static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            case '\'': out += "&#39;"; break;
            default: out += static_cast<unsigned char>(c) < 0x20 && c != '\n' ? ' ' : c;
        }
    }
    return out;
}

std::string marked_up(std::string_view text) {
    static const std::regex bold(R"(\*\*([^]*?)\*\*)"), code("`([^]*?)`");
    const std::string strong = std::regex_replace(escaped(text), bold, "<strong>$1</strong>");
    return std::regex_replace(strong, code, "<code>$1</code>");
}

std::string link(std::string_view relative_path) {
    std::string out;
    for (const char c : relative_path) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = byte < 0x80 && (std::isalnum(byte) != 0 || c == '/' || c == '.' ||
                                           c == '_' || c == '-' || c == '~');
        out += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return out.empty() || out[0] != '/' ? out : "." + out;
}

std::string base64(std::string_view bytes) {
    std::string out(BASE64_ENCODE_RAW_LENGTH(bytes.size()), '\0');
    base64_encode_raw(out.data(), bytes.size(),
                      reinterpret_cast<const std::uint8_t*>(bytes.data()));
    return out;
}

Embedded embedded(std::string bytes) {
    if (bytes.size() > 24 && bytes.compare(0, 8, "\x89PNG\r\n\x1a\n") == 0) {
        return {"data:image/png;base64," + base64(bytes), static_cast<int>(big_endian(bytes, 16)),
                static_cast<int>(big_endian(bytes, 20))};
    }
    Embedded image;
    const std::size_t box = bytes.find("viewBox=\"0 0 ");
    require(bytes.find("<svg") != bytes.npos && box != bytes.npos &&
                std::sscanf(bytes.c_str() + box, "viewBox=\"0 0 %d %d\"", &image.width_px,
                            &image.height_px) == 2,
            "a picture is a PNG or an SVG by gnuplot");
    // Phones lack DejaVu Sans; Verdana has its widths.
    const std::string lone = "font-family=\"DejaVu Sans\"";
    const std::string with_twins = "font-family=\"DejaVu Sans,Verdana,sans-serif\"";
    for (std::size_t at = bytes.find(lone); at != bytes.npos;
         at = bytes.find(lone, at + with_twins.size())) {
        bytes.replace(at, lone.size(), with_twins);
    }
    image.uri = "data:image/svg+xml;base64," + base64(bytes);
    return image;
}

}  // namespace limpet::draw::html
