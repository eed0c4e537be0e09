// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/truth.hpp"

namespace limpet {

/// Takes one more number into a digest of 64 bits; any changed bit changes the digest.
inline void digest(std::uint64_t& hash, double value) {
    constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;  // 2^64 / golden ratio
    std::uint64_t bits = 0;                                // std::bit_cast came with GCC 11
    static_assert(sizeof bits == sizeof value);
    std::memcpy(&bits, &value, sizeof bits);
    hash = (std::rotl(hash, 23) ^ bits) * kOdd;
}

inline void digest(std::uint64_t& hash, const Vector3& v) {
    digest(hash, v.x());
    digest(hash, v.y());
    digest(hash, v.z());
}

inline void digest(std::uint64_t& hash, const Quaternion& q) {
    digest(hash, q.w());
    digest(hash, Vector3(q.vec()));
}

/// How often a flight is digested: a difference between two runs does not heal within 10 ms.
inline constexpr int kDigestRate_Hz = 100;

/// A point of the trajectory: what is true and what the autopilot believes. Everything else that a
/// flight does shows up in these within a few ticks.
inline void digest(std::uint64_t& hash, const Truth& truth, const Estimate& estimate) {
    digest(hash, truth.base.p_WF_m);
    digest(hash, truth.base.q_WF);
    digest(hash, truth.base.v_WF_W_m_s);
    digest(hash, truth.base.w_WF_F_rad_s);
    digest(hash, truth.slider.position_m);
    digest(hash, truth.cup_status.pressure_Pa);
    digest(hash, truth.cup.p_WF_m);
    for (const double speed : truth.rotor_speed_rad_s) {
        digest(hash, speed);
    }
    digest(hash, estimate.p_WB_m);
    digest(hash, estimate.q_WB);
}

}  // namespace limpet
