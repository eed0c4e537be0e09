// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace limpet::models {

/// How a wall looks in pictures; the physics do not know it.
enum class Finish {
    concrete,
    blocks,
    gel_coat,
    steel
};

/// By words in the surface's name; concrete when there is none.
[[nodiscard]] Finish finish_of(std::string_view surface);

/// How a wall looks under light: a colour that a grey texture shades.
struct FinishLook {
    std::string_view name;      ///< of the texture
    double rgb[3];              ///< 0..1
    double gloss = 0.0;         ///< 0..1
    double tile_width_m = 1.0;  ///< of the wall that the texture covers; it repeats
    double tile_height_m = 1.0;
};
[[nodiscard]] const FinishLook& look(Finish finish);

inline constexpr int kTexture_px = 512;

/// A square of kTexture_px by kTexture_px, from top to bottom, 0 black to 255 white, that fits its
/// own edges. Always the same.
[[nodiscard]] std::vector<std::uint8_t> finish_texture(Finish finish);

/// The same as the bytes of a Truevision TGA file, 8 bit grey.
[[nodiscard]] std::string finish_tga(Finish finish);

}  // namespace limpet::models
