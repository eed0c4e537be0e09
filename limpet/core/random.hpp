// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "limpet/core/frames.hpp"
#include "limpet/core/philox.hpp"

namespace limpet {

/// Who draws. A stream of its own for each consumer: adding a draw in one place leaves every other
/// place's numbers as they were. Numbers are part of the recordings' meaning: append, never
/// reorder. 10..29 are the sensors'; a new one may name its own there (limpet/sensors/sensor.hpp).
enum class Stream : std::uint32_t {
    seal = 1,
    pump = 2,
    imu = 10,
    barometer = 11,
    magnetometer = 12,
    gps = 13,
    motion_capture = 14,
    lidar_left = 15,
    lidar_right = 16,
    force = 17,
    pressure = 18,
    battery = 19,
    wind = 30,
    wall_air = 31,
    scenario = 40,
    test = 99,
};

/// Where the standard normal distribution has a probability below it.
/// @param probability  0 < p < 1
/// @return z with Phi(z) = p, relative error below 1e-15
/// Source: Wichura, "Algorithm AS 241: the percentage points of the normal distribution", Applied
/// Statistics 37 (1988), PPND16.
[[nodiscard]] double normal_quantile(double probability);
/// @return probability of a standard normal below x
[[nodiscard]] double normal_probability(double x);

/// One of the noises that make a blend.
struct NoiseTerm {
    std::uint64_t seed = 0;
    double weight = 1.0;
    friend bool operator==(const NoiseTerm&, const NoiseTerm&) = default;
};
/// A noise between others: each standard normal is the weighted sum of those that the seeds would
/// draw in its place, over the root of the sum of the squared weights; every other draw is that of
/// such a normal's probability. A little weight of another seed is a noise a little next to the old
/// one, and standard normal all the same.
using NoiseBlend = std::vector<NoiseTerm>;

/// Counter-based random numbers (Philox 4x32-10): a draw is a pure function of (seed, run, stream,
/// counter), so results do not depend on thread count or order, and a copied stream continues
/// alike. Source: Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC11.
class RandomStream {
public:
    RandomStream() = default;
    /// @param blend  in the seed's place; empty: the seed alone. Weights of which one is not 0
    RandomStream(std::uint64_t seed, std::uint32_t run, Stream stream,
                 const NoiseBlend& blend = {});

    /// @return uniform on [0, 1), 53 bits
    [[nodiscard]] double uniform() { return ahead_.uniforms[next()]; }
    /// @return standard normal, of one uniform number (normal_quantile)
    [[nodiscard]] double normal() {
        const std::size_t at = next();
        if (!ahead_.normal) {
            find_normals();
        }
        return ahead_.normals[at];
    }
    /// @return three independent standard normals
    [[nodiscard]] Vector3 normal3();
    /// @param median  of the result, > 0
    /// @param sigma   standard deviation of its logarithm, >= 0
    [[nodiscard]] double lognormal(double median, double sigma);

    /// What follows from the rest and is not visited: numbers are made several at once, ahead of
    /// need, in the machine's vectors.
    struct Ahead {
        static constexpr std::size_t kCount = kDrawn;
        bool there = false;
        bool normal = false;     ///< normals too
        std::uint64_t from = 0;  ///< numbers before these
        double uniforms[kCount] = {};
        double normals[kCount] = {};
    };

    template <class Self, class Each>
    static void visit_members(Self& self, Each&& each) {
        each(self.seed_, self.run_, self.stream_, self.drawn_, self.blend_);
        if constexpr (!std::is_const_v<Self>) {
            self.ahead_.there = false;  // it may be another stream now
        }
    }

private:
    /// @return where the next number is, among those of ahead_
    [[nodiscard]] std::size_t next() {
        if (!ahead_.there || drawn_ - ahead_.from >= Ahead::kCount) {
            look_ahead();
        }
        return (drawn_++ - ahead_.from) ^ 1U;  // a block's second comes first
    }
    void look_ahead();
    void find_normals();

    std::uint64_t seed_ = 0;
    std::uint32_t run_ = 0;
    std::uint32_t stream_ = 0;
    std::uint64_t drawn_ = 0;  ///< so many numbers
    NoiseBlend blend_;         ///< squared weights add up to 1; empty: seed_ alone

    Ahead ahead_;
};

}  // namespace limpet
