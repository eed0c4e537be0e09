// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/finish.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace limpet::models {

namespace {

/// 0..1, the same for the same three numbers.
double hash(int x, int y, int layer) {
    auto h = static_cast<std::uint32_t>(x) * 0x8da6b343U +
             static_cast<std::uint32_t>(y) * 0xd8163841U +
             static_cast<std::uint32_t>(layer) * 0xcb1ab31fU;
    h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
    h = (h ^ (h >> 12U)) * 0x297a2d39U;
    return static_cast<double>(h ^ (h >> 15U)) / 4294967295.0;
}

/// Smooth noise 0..1 that repeats after the whole texture.
/// @param cells_x, cells_y  how many lumps across it; divide kTexture_px
double noise(int x_px, int y_px, int cells_x, int cells_y, int layer) {
    const double u = static_cast<double>(x_px) * cells_x / kTexture_px;
    const double v = static_cast<double>(y_px) * cells_y / kTexture_px;
    const int i = static_cast<int>(u);
    const int j = static_cast<int>(v);
    const auto eased = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double s = eased(u - i);
    const double t = eased(v - j);
    const auto at = [&](int di, int dj) {
        return hash((i + di) % cells_x, (j + dj) % cells_y, layer);
    };
    return (1.0 - t) * ((1.0 - s) * at(0, 0) + s * at(1, 0)) +
           t * ((1.0 - s) * at(0, 1) + s * at(1, 1));
}

/// Pixels to the next multiple of a spacing.
int to_line(int px, int spacing_px) {
    const int past = px % spacing_px;
    return std::min(past, spacing_px - past);
}

/// Clouds, grain, pores; joints and tie holes of the formwork.
double concrete(int x, int y) {
    double grey = 0.80 + 0.10 * noise(x, y, 4, 4, 0) + 0.05 * noise(x, y, 16, 16, 1) +
                  0.05 * noise(x, y, 128, 128, 2);
    if (noise(x, y, 128, 128, 3) > 0.94) {
        grey -= 0.18;
    }
    if (to_line(x, kTexture_px) < 2 || to_line(y, kTexture_px) < 2) {
        grey -= 0.20;
    }
    const int dx = to_line(x + kTexture_px / 4, kTexture_px / 2);
    const int dy = to_line(y + kTexture_px / 4, kTexture_px / 2);
    return dx * dx + dy * dy < 30 ? grey - 0.30 : grey;
}

/// Running bond, four blocks of 0.39 m wide, eight of 0.19 m high; every block has its own shade.
double blocks(int x, int y) {
    constexpr int kWidth_px = kTexture_px / 4;
    constexpr int kHeight_px = kTexture_px / 8;
    const int row = y / kHeight_px;
    const int along = (x + (row % 2) * kWidth_px / 2) % kTexture_px;
    if (to_line(along, kWidth_px) < 2 || to_line(y, kHeight_px) < 2) {
        return 0.60 + 0.08 * noise(x, y, 128, 128, 4);
    }
    const double shade = hash(along / kWidth_px, row, 5);
    return 0.80 + 0.08 * shade + 0.12 * noise(x, y, 128, 128, 6) * noise(x, y, 256, 256, 7);
}

/// Brushed along, with a plate's edge.
double steel(int x, int y) {
    const double grey = 0.80 + 0.10 * noise(x, y, 8, 512, 8) + 0.06 * noise(x, y, 2, 128, 9) +
                        0.04 * noise(x, y, 4, 4, 10);
    return to_line(x, kTexture_px) < 2 || to_line(y, kTexture_px) < 2 ? grey - 0.30 : grey;
}

double gel_coat(int x, int y) {
    return 0.96 + 0.04 * noise(x, y, 2, 2, 11);
}

double grey_of(Finish finish, int x, int y) {
    switch (finish) {
        case Finish::concrete: return concrete(x, y);
        case Finish::blocks: return blocks(x, y);
        case Finish::gel_coat: return gel_coat(x, y);
        case Finish::steel: return steel(x, y);
    }
    return 1.0;
}

}  // namespace

Finish finish_of(std::string_view surface) {
    const auto has = [surface](std::string_view word) {
        return surface.find(word) != std::string_view::npos;
    };
    if (has("block") || has("brick")) {
        return Finish::blocks;
    }
    if (has("blade") || has("glass") || has("paint")) {
        return Finish::gel_coat;
    }
    if (has("metal") || has("steel") || has("alumin")) {
        return Finish::steel;
    }
    return Finish::concrete;
}

const FinishLook& look(Finish finish) {
    static constexpr FinishLook looks[] = {
        {"concrete", {0.80, 0.79, 0.76}, 0.02, 1.25, 1.25},
        {"blocks", {0.78, 0.74, 0.68}, 0.02, 1.56, 1.52},
        {"gel_coat", {0.86, 0.88, 0.90}, 0.12, 2.0, 2.0},
        {"steel", {0.62, 0.66, 0.71}, 0.15, 1.0, 1.0},
    };
    return looks[static_cast<std::size_t>(finish)];
}

std::vector<std::uint8_t> finish_texture(Finish finish) {
    std::vector<std::uint8_t> grey;
    grey.reserve(static_cast<std::size_t>(kTexture_px) * kTexture_px);
    for (int y = 0; y < kTexture_px; ++y) {
        for (int x = 0; x < kTexture_px; ++x) {
            const double value = std::clamp(grey_of(finish, x, y), 0.0, 1.0);
            grey.push_back(static_cast<std::uint8_t>(std::lround(255.0 * value)));
        }
    }
    return grey;
}

std::string finish_tga(Finish finish) {
    constexpr char kLow = static_cast<char>(kTexture_px & 0xff);
    constexpr char kHigh = static_cast<char>(kTexture_px >> 8);
    // No palette, uncompressed grey (3), origin 0 0, 8 bit a pixel, first row on top (0x20).
    std::string file = {0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, kLow, kHigh, kLow, kHigh, 8, 0x20};
    const auto grey = finish_texture(finish);
    file.append(grey.begin(), grey.end());
    return file;
}

}  // namespace limpet::models
