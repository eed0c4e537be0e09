// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/visit.hpp"
#include "limpet/core/wall.hpp"
#include "limpet/plant/mechanism.hpp"

// What the reduced engine knows of a vehicle, on a scalar type T: a vehicle in each lane.
namespace limpet::plant {

inline constexpr std::size_t kTips = 2;   ///< of the legs
inline constexpr std::size_t kFaces = 2;  ///< wall and ground
inline constexpr std::size_t kBodies = 3;

template <class T>
struct ReducedNumbers {
    MechanismNumbers<T> mechanism;
    std::array<Vec3<T>, kTips> tip_B_m;
    T tip_radius_m{};
    T friction{};
};

/// What a leg can stand on.
struct Face {
    bool there = false;
    WallGeometry geometry;
    double tip_stiffness_N_m = vehicle::kTipStiffness_N_m;  ///< across, with what the face yields
    double tip_damping_N_s_m = vehicle::kTipDamping_N_s_m;
};
using Faces = std::array<Face, kFaces>;

/// A leg's tip on a face: a spring and damper across it, and one along it that is slack where the
/// tip touched. It sticks; beyond Coulomb's limit it slides.
template <class T>
struct TipContact {
    T stretch_y_m{};  ///< of the spring along the face, axes of T
    T stretch_z_m{};
};

/// What pushes a body in this step, about B's origin.
template <class T>
struct PushedOn {
    Vec3<T> force_W_N = Vec3<T>::Zero();
    Vec3<T> moment_W_N_m = Vec3<T>::Zero();
};

/// All on which the future depends.
template <class T>
struct ReducedState {
    MechanismState<T> bodies;
    std::array<PushedOn<T>, kBodies> pushed;
    std::array<std::array<TipContact<T>, kFaces>, kTips> tips;
    T slider_N{};
    Vec3<T> contact_force_W_N = Vec3<T>::Zero();
};

/// How a frame of the vehicle moves, as Kinematics.
template <class T>
struct Motion {
    Vec3<T> p_WF_m = Vec3<T>::Zero();
    Eigen::Quaternion<T> q_WF = Eigen::Quaternion<T>::Identity();
    Vec3<T> v_WF_W_m_s = Vec3<T>::Zero();
    Vec3<T> w_WF_F_rad_s = Vec3<T>::Zero();
};

using limpet::in_lane;
using limpet::set_lane;

/// A lane's numbers, one after the other, and the way back.
template <class Of>
void put_lane(Of& all, int lane, std::span<const double> numbers) {
    std::size_t at = 0;
    visit_leaves(all, [&](auto& leaf) {
        require(at < numbers.size(), "as many numbers as there are");
        if constexpr (requires { leaf.set(lane, 0.0); }) {
            leaf.set(lane, numbers[at++]);
        } else {
            leaf = static_cast<std::remove_reference_t<decltype(leaf)>>(numbers[at++]);
        }
    });
    require(at == numbers.size(), "as many numbers as there are");
}
template <class Of>
[[nodiscard]] std::vector<double> lane_of(const Of& all, int lane) {
    std::vector<double> numbers;
    visit_leaves(all, [&](const auto& leaf) {
        if constexpr (requires { leaf[lane]; }) {
            numbers.push_back(leaf[lane]);
        } else {
            numbers.push_back(static_cast<double>(leaf));
        }
    });
    return numbers;
}
/// One of a vector's lanes, and the way back.
template <class T>
[[nodiscard]] Vector3 in_lane(const Vec3<T>& v, int lane) {
    return {v.x()[lane], v.y()[lane], v.z()[lane]};
}
template <class T>
void set_lane(Vec3<T>& v, int lane, const Vector3& value) {
    for (int i = 0; i < 3; ++i) {
        v[i].set(lane, value[i]);
    }
}

}  // namespace limpet::plant
