// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/philox.hpp"

#include <Random123/philox.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace limpet {
namespace {

#if defined(__x86_64__)
/// Four 64-bit numbers; of a word of Philox the low half counts, whatever is above it.
using Words = __m256i;

[[gnu::target("avx2")]] inline Words all_of(std::uint64_t value) {
    return _mm256_set1_epi64x(static_cast<long long>(value));
}

/// @param words  of 53 bits
[[gnu::target("avx2")]] inline __m256d unit_interval(Words words) {
    // Each half becomes a number by what stands above it: 2^84 and 2^52 more than it is worth.
    const Words high = _mm256_or_si256(_mm256_srli_epi64(words, 32), all_of(0x4530000000000000ULL));
    const Words low =
        _mm256_blend_epi32(all_of(0x4330000000000000ULL), words, 0b01010101);  // of each the lower
    const __m256d number =
        _mm256_add_pd(_mm256_sub_pd(_mm256_castsi256_pd(high), _mm256_set1_pd(0x1.00000001p84)),
                      _mm256_castsi256_pd(low));
    return _mm256_mul_pd(number, _mm256_set1_pd(0x1.0p-53));
}

/// The upper 53 of 64 bits, of which two words are the halves.
[[gnu::target("avx2")]] inline __m256d uniforms_of(Words high, Words low) {
    const Words both = _mm256_blend_epi32(low, _mm256_slli_epi64(high, 32), 0b10101010);
    return unit_interval(_mm256_srli_epi64(both, 11));
}

/// As draw_uniforms_anywhere(), four blocks side by side: compilers do not find the machine's
/// multiplication of 32 by 32 bits for it. Source of the rounds: as Philox'.
[[gnu::target("avx2")]] void draw_avx2(std::uint64_t seed, std::uint64_t counter, std::uint32_t run,
                                       std::uint32_t stream, double (&uniforms)[kDrawn]) {
    constexpr int kRounds = 10;
    const Words multiplier0 = all_of(PHILOX_M4x32_0);
    const Words multiplier1 = all_of(PHILOX_M4x32_1);
    for (std::size_t from = 0; from < kDrawn / 2; from += 4) {
        const Words at = _mm256_add_epi64(all_of(counter + from), _mm256_set_epi64x(3, 2, 1, 0));
        Words word0 = at;
        Words word1 = _mm256_srli_epi64(at, 32);
        Words word2 = all_of(run);
        Words word3 = all_of(stream);
        auto key0 = static_cast<std::uint32_t>(seed);
        auto key1 = static_cast<std::uint32_t>(seed >> 32U);
        for (int round = 0; round < kRounds; ++round) {
            const Words product0 = _mm256_mul_epu32(word0, multiplier0);
            const Words product1 = _mm256_mul_epu32(word2, multiplier1);
            word0 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(product1, 32), word1),
                                     all_of(key0));
            word2 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(product0, 32), word3),
                                     all_of(key1));
            word1 = product1;
            word3 = product0;
            key0 += PHILOX_W32_0;
            key1 += PHILOX_W32_1;
        }
        const __m256d first = uniforms_of(word0, word1);
        const __m256d second = uniforms_of(word2, word3);
        const __m256d low = _mm256_unpacklo_pd(first, second);
        const __m256d high = _mm256_unpackhi_pd(first, second);
        _mm256_storeu_pd(uniforms + 2 * from, _mm256_permute2f128_pd(low, high, 0x20));
        _mm256_storeu_pd(uniforms + 2 * from + 4, _mm256_permute2f128_pd(low, high, 0x31));
    }
}
#endif

}  // namespace

void draw_uniforms_anywhere(std::uint64_t seed, std::uint64_t counter, std::uint32_t run,
                            std::uint32_t stream, double (&uniforms)[kDrawn]) {
    const r123::Philox4x32::key_type key = {
        {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)}};
    for (std::size_t i = 0; i < kDrawn / 2; ++i) {
        const std::uint64_t at = counter + i;
        const r123::Philox4x32::ctr_type block = r123::Philox4x32{}(
            {{static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at >> 32U), run, stream}},
            key);
        for (std::size_t k = 0; k < 2; ++k) {
            const std::uint64_t bits =
                (static_cast<std::uint64_t>(block.v[2 * k]) << 32U) | block.v[2 * k + 1];
            uniforms[2 * i + k] =
                static_cast<double>(static_cast<std::int64_t>(bits >> 11U)) * 0x1.0p-53;
        }
    }
}

void draw_uniforms(std::uint64_t seed, std::uint64_t counter, std::uint32_t run,
                   std::uint32_t stream, double (&uniforms)[kDrawn]) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") != 0) {
        draw_avx2(seed, counter, run, stream, uniforms);
        return;
    }
#endif
    draw_uniforms_anywhere(seed, counter, run, stream, uniforms);
}

}  // namespace limpet
