// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "limpet/core/signals/readings.hpp"

namespace limpet {

/// Holds the velocity of poses against what an IMU feels. A drift is no acceleration, but its
/// beginning is one that nobody feels: over 0.3 s the poses' velocity has changed by as much as it
/// drifts, less the integral of the specific force. Attitudes are the poses'; a bias of the
/// accelerometer and a tilt are as good as out of it in so short a time.
///
/// Nothing is known for 0.3 s after the poses begin, and after a gap of 0.15 s in them or of 0.05 s
/// in the IMU's samples. Allocates nothing.
class DriftWatch {
public:
    /// @param imu  as they come, up to 1 kHz; the same sample may come again
    void feel(const Sample<ImuReading>& imu);
    /// @param pose  newer than the last, not earlier than 0.3 s ago by the IMU's clock
    /// @return the poses' change of velocity that was not felt [m/s], W
    [[nodiscard]] std::optional<Vector3> unfelt(const Sample<PoseReading>& pose);
    /// Poses and what was felt before them are no part of what comes.
    void forget();

private:
    struct Felt {
        double time_s = 0.0;
        Vector3 specific_force_B_m_s2 = Vector3::Zero();
    };
    /// Position of a pose, less that which follows from the IMU alone: a line, but for drifts.
    struct Rest {
        double time_s = 0.0;
        Vector3 p_W_m = Vector3::Zero();
    };

    void integrate(const Sample<PoseReading>& pose);
    [[nodiscard]] std::optional<Vector3> rest_at(double time_s) const;

    static constexpr std::size_t kMostFelt = 512;
    static constexpr std::size_t kMostRests = 256;
    std::array<Felt, kMostFelt> felt_ = {};  ///< yet to be integrated, a ring
    std::size_t first_felt_ = 0, felt_count_ = 0;
    std::array<Rest, kMostRests> rests_ = {};  ///< a ring
    std::size_t first_rest_ = 0, rest_count_ = 0;
    Sample<PoseReading> last_;
    double last_felt_s_ = -1.0;   ///< that came
    double integrated_s_ = -1.0;  ///< < 0: nothing yet
    Vector3 a_W_m_s2_ = Vector3::Zero();
    Vector3 v_W_m_s_ = Vector3::Zero();
    Vector3 p_W_m_ = Vector3::Zero();
};

}  // namespace limpet
