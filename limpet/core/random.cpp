// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/random.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/lanes.hpp"
#include "limpet/core/machines.hpp"
#include "limpet/core/philox.hpp"

namespace limpet {
namespace {

/// Ratio of two polynomials of degree 7, coefficients from the constant up; the lower one's is 1.
template <class T>
[[gnu::always_inline]] inline T ratio(const double (&over)[8], const double (&under)[7],
                                      const T& x) {
    T numerator = over[7];
    T denominator = under[6];
    for (int i = 6; i > 0; --i) {
        numerator = numerator * x + over[i];
        denominator = denominator * x + under[i - 1];
    }
    return (numerator * x + over[0]) / (denominator * x + 1.0);
}

constexpr double kCentreOver[8] = {3.3871328727963666080e0,  1.3314166789178437745e+2,
                                   1.9715909503065514427e+3, 1.3731693765509461125e+4,
                                   4.5921953931549871457e+4, 6.7265770927008700853e+4,
                                   3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr double kCentreUnder[7] = {4.2313330701600911252e+1, 6.8718700749205790830e+2,
                                    5.3941960214247511077e+3, 2.1213794301586595867e+4,
                                    3.9307895800092710610e+4, 2.8729085735721942674e+4,
                                    5.2264952788528545610e+3};
constexpr double kFlankOver[8] = {1.42343711074968357734e0,  4.63033784615654529590e0,
                                  5.76949722146069140550e0,  3.64784832476320460504e0,
                                  1.27045825245236838258e0,  2.41780725177450611770e-1,
                                  2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr double kFlankUnder[7] = {2.05319162663775882187e0,  1.67638483018380384940e0,
                                   6.89767334985100004550e-1, 1.48103976427480074590e-1,
                                   1.51986665636164571966e-2, 5.47593808499534494600e-4,
                                   1.05075007164441684324e-9};
constexpr double kTailOver[8] = {6.65790464350110377720e0,  5.46378491116411436990e0,
                                 1.78482653991729133580e0,  2.96560571828504891230e-1,
                                 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                 2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr double kTailUnder[7] = {5.99832206555887937690e-1, 1.36929880922735805310e-1,
                                  1.48753612908506148525e-2, 7.86869131145613259100e-4,
                                  1.84631831751005468180e-5, 1.42151175831644588870e-7,
                                  2.04426310338993978564e-15};

constexpr double kHalfStep = 0x1.0p-54;           ///< of the grid of uniform()
constexpr double kLastUniform = 1.0 - 0x1.0p-52;  ///< half a step above it is still below 1
constexpr double kCentre = 0.425;                 ///< nearer to the median: most

/// The quantile near the median.
/// @param q  probability less a half
template <class T>
[[gnu::always_inline]] inline T centre_quantile(const T& q) {
    return q * ratio<T>(kCentreOver, kCentreUnder, 0.180625 - q * q);
}

/// How far out a probability beyond kCentre lies, on either side.
double way_out(double probability) {
    return std::sqrt(-std::log(probability < 0.5 ? probability : 1.0 - probability));
}

/// The quantile that far out.
template <class T>
[[gnu::always_inline]] inline T outer_quantile(const T& way) {
    const T flank = ratio<T>(kFlankOver, kFlankUnder, way - 1.6);
    const auto far = way > T(5.0);
    return any(far) ? select(far, ratio<T>(kTailOver, kTailUnder, way - 5.0), flank) : flank;
}

/// normal_quantile() of several uniforms, half a step off their grid: neither 0 nor 1 can come out,
/// and the draws are even about the median. First as if all were near it, then the others, a
/// seventh, together.
LIMPET_FOR_MACHINES [[gnu::flatten]] void normals_of(const double (&uniforms)[kDrawn],
                                                     double (&normals)[kDrawn]) {
    constexpr int kWidth = 8;
    constexpr std::size_t kTogether = 4;
    std::size_t outside[kDrawn + kTogether];
    std::size_t count = 0;
    for (std::size_t at = 0; at < kDrawn; at += kWidth) {
        Lanes<kWidth> q;
        for (int i = 0; i < kWidth; ++i) {
            q.set(i, (uniforms[at + static_cast<std::size_t>(i)] + kHalfStep) - 0.5);
        }
        const Lanes<kWidth> z = centre_quantile(q);
        for (int i = 0; i < kWidth; ++i) {
            const std::size_t k = at + static_cast<std::size_t>(i);
            normals[k] = z[i];
            outside[count] = k;
            count += std::abs(q[i]) <= kCentre ? 0 : 1;
        }
    }
    if (count == 0) {
        return;
    }
    // The last ones again until four are full: no branch that depends on how many they are.
    std::fill_n(outside + count, kTogether, outside[count - 1]);
    for (std::size_t from = 0; from < count; from += kTogether) {
        Lanes<kTogether> way;
        for (std::size_t i = 0; i < kTogether; ++i) {
            way.set(static_cast<int>(i), way_out(uniforms[outside[from + i]] + kHalfStep));
        }
        const Lanes<kTogether> z = outer_quantile(way);
        for (std::size_t i = 0; i < kTogether; ++i) {
            const std::size_t k = outside[from + i];
            normals[k] = uniforms[k] < 0.5 ? -z[static_cast<int>(i)] : z[static_cast<int>(i)];
        }
    }
}

}  // namespace

double normal_quantile(double probability) {
    const double q = probability - 0.5;
    if (std::abs(q) <= kCentre) {
        return centre_quantile(q);
    }
    const double z = outer_quantile(way_out(probability));
    return q < 0.0 ? -z : z;
}

double normal_probability(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

RandomStream::RandomStream(std::uint64_t seed, std::uint32_t run, Stream stream,
                           const NoiseBlend& blend)
    : seed_(seed), run_(run), stream_(static_cast<std::uint32_t>(stream)) {
    if (blend.size() == 1 && blend.front().weight > 0.0) {
        seed_ = blend.front().seed;
        return;
    }
    double squares = 0.0;
    for (const NoiseTerm& term : blend) {
        squares += term.weight * term.weight;
    }
    blend_ = blend;
    for (NoiseTerm& term : blend_) {
        term.weight /= std::sqrt(squares);
    }
}

void RandomStream::look_ahead() {
    ahead_.from = drawn_ & ~std::uint64_t{1};
    ahead_.there = true;
    ahead_.normal = false;
    const std::uint64_t counter = ahead_.from / 2;
    if (blend_.empty()) {
        draw_uniforms(seed_, counter, run_, stream_, ahead_.uniforms);
        return;
    }
    double sums[Ahead::kCount] = {};
    for (const NoiseTerm& term : blend_) {
        draw_uniforms(term.seed, counter, run_, stream_, ahead_.uniforms);
        find_normals();
        for (std::size_t i = 0; i < Ahead::kCount; ++i) {
            sums[i] += term.weight * ahead_.normals[i];
        }
    }
    for (std::size_t i = 0; i < Ahead::kCount; ++i) {
        ahead_.uniforms[i] = std::min(normal_probability(sums[i]), kLastUniform);
    }
    ahead_.normal = false;
}

void RandomStream::find_normals() {
    normals_of(ahead_.uniforms, ahead_.normals);
    ahead_.normal = true;
}

Vector3 RandomStream::normal3() {
    const std::uint64_t at = drawn_ - ahead_.from;
    if (ahead_.there && ahead_.normal && at + 3 <= Ahead::kCount) {
        drawn_ += 3;
        const auto& normals = ahead_.normals;
        return {normals[at ^ 1U], normals[(at + 1) ^ 1U], normals[(at + 2) ^ 1U]};
    }
    const double x = normal();
    const double y = normal();
    const double z = normal();
    return {x, y, z};
}

double RandomStream::lognormal(double median, double sigma) {
    return median * std::exp(sigma * normal());
}

}  // namespace limpet
