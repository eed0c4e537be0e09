// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <png.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "limpet/draw/stage.hpp"

namespace limpet::test {

/// Reads a PNG from the first byte to the last checksum; an empty image when it is none.
inline draw::Image read_png(const std::filesystem::path& path) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&png, path.c_str()) == 0) {
        return {};
    }
    png.format = PNG_FORMAT_RGB;
    draw::Image image{static_cast<int>(png.width), static_cast<int>(png.height), {}};
    image.rgb.resize(PNG_IMAGE_SIZE(png));
    if (png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr) == 0) {
        return {};
    }
    return image;
}

inline std::size_t distinct_colours(const draw::Image& image) {
    std::set<std::uint32_t> colours;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
        colours.insert(image.rgb[i] << 16u | image.rgb[i + 1] << 8u | image.rgb[i + 2]);
    }
    return colours.size();
}

/// Share of pixels that differ by more than `threshold` in some channel.
inline double difference(const draw::Image& a, const draw::Image& b, int threshold = 12) {
    std::size_t differ = 0;
    for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
        for (std::size_t c = i; c < i + 3; ++c) {
            if (std::abs(a.rgb[c] - b.rgb[c]) > threshold) {
                ++differ;
                break;
            }
        }
    }
    return 3.0 * static_cast<double>(differ) / static_cast<double>(a.rgb.size());
}

/// An environment variable's value for the length of a test.
class Environment {
public:
    Environment(const char* name, const std::string& value) : name_(name) {
        const char* old = std::getenv(name);
        had_ = old != nullptr;
        old_ = had_ ? old : "";
        setenv(name, value.c_str(), 1);
    }
    ~Environment() {
        if (had_) {
            setenv(name_, old_.c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    bool had_ = false;
    std::string old_;
};

}  // namespace limpet::test
