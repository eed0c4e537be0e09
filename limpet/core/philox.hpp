// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Philox 4x32-10 (Salmon et al., SC11) as random.hpp takes it: a block of a counter is two
/// numbers.
namespace limpet {

/// Numbers that are made at once, of eight counters.
inline constexpr std::size_t kDrawn = 16;

/// @param counter   the first of those that follow each other
/// @param uniforms  on [0, 1), 53 bits, a block's first number first
void draw_uniforms(std::uint64_t seed, std::uint64_t counter, std::uint32_t run,
                   std::uint32_t stream, double (&uniforms)[kDrawn]);
/// The same numbers as any machine makes them.
void draw_uniforms_anywhere(std::uint64_t seed, std::uint64_t counter, std::uint32_t run,
                            std::uint32_t stream, double (&uniforms)[kDrawn]);

}  // namespace limpet
