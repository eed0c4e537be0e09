// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/random.hpp"

#include <Random123/philox.h>

#include <cmath>

namespace limpet {

RandomStream::RandomStream(std::uint64_t seed, std::uint32_t run, Stream stream)
    : seed_(seed), run_(run), stream_(static_cast<std::uint32_t>(stream)) {}

void RandomStream::refill() {
    const r123::Philox4x32::ctr_type counter = {{static_cast<std::uint32_t>(counter_),
                                                 static_cast<std::uint32_t>(counter_ >> 32U), run_,
                                                 stream_}};
    const r123::Philox4x32::key_type key = {
        {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32U)}};
    const auto block = r123::Philox4x32{}(counter, key);
    for (unsigned i = 0; i < 2; ++i) {
        const std::uint64_t bits =
            (static_cast<std::uint64_t>(block[2 * i]) << 32U) | block[2 * i + 1];
        uniforms_[i] = static_cast<double>(bits >> 11U) * 0x1.0p-53;
    }
    uniforms_left_ = 2;
    ++counter_;
}

double RandomStream::uniform() {
    if (uniforms_left_ == 0) {
        refill();
    }
    return uniforms_[--uniforms_left_];
}

double RandomStream::normal() {
    if (has_normal_ != 0U) {
        has_normal_ = 0U;
        return normal_;
    }
    const double radius = std::sqrt(-2.0 * std::log1p(-uniform()));
    const double angle_rad = 2.0 * kPi * uniform();
    normal_ = radius * std::sin(angle_rad);
    has_normal_ = 1U;
    return radius * std::cos(angle_rad);
}

Vector3 RandomStream::normal3() {
    const double x = normal();
    const double y = normal();
    const double z = normal();
    return {x, y, z};
}

double RandomStream::lognormal(double median, double sigma) {
    return median * std::exp(sigma * normal());
}

}  // namespace limpet
