// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "limpet/core/enum_names.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/core/signals/kinematics.hpp"
#include "limpet/core/signals/wrench.hpp"
#include "limpet/vehicle/airframe.hpp"

/// What holds the vehicle in an experiment that is no flight. A mount is a force law on the base;
/// the plant knows nothing of it.
///
///   pendulum   four parallel ropes of one length, level with the centre of mass: the vehicle
///              swings like a point mass and keeps its attitude (paper III.B: a 5 m pendulum)
///   press_rig  a clamp that holds the base by springs in all six directions and can be moved
namespace limpet::vehicle {

enum class Mount {
    free,       ///< it flies
    pendulum,   ///< it hangs and swings against the wall
    press_rig,  ///< it is pressed on the wall
};
[[nodiscard]] inline std::string_view to_string(Mount mount) {
    return name_of(mount);
}

/// Rows of `pendulum:`.
struct PendulumParameters {
    double impact_speed_m_s = 1.1;  ///< at the lowest point, where the lip meets the wall
    double rope_length_m = 5.0;
    double rope_stretch_m = 1e-3;  ///< under the vehicle's weight
    double rope_damping = 0.3;     ///< of critical, along the ropes
    double yaw_deg = 0.0;          ///< nose right of the wall's normal
    double pitch_deg = 0.0;        ///< nose up
    double hold_s = 0.5;           ///< for so long the cup must hold, or be off for the end
};
[[nodiscard]] const ParameterTable<PendulumParameters>& pendulum_table();

/// Rows of `press_rig:`.
struct PressRigParameters {
    double press_N = 80.0;             ///< through the slider; then the clamp stops
    double approach_speed_m_s = 0.05;  ///< of the clamp
    double start_gap_m = 0.02;         ///< lip to wall
    double stiffness_N_m = 2e4;        ///< of the clamp
    double turn_stiffness_N_m_rad = 500.0;
    double damping = 1.0;  ///< of critical, in all directions
    double seal_s = 3.0;   ///< pump on, from the press on
    double leak_s = 3.0;   ///< pump off, after it
};
[[nodiscard]] const ParameterTable<PressRigParameters>& press_rig_table();

/// Centre of the lip in B with the slider out and the joint centred.
[[nodiscard]] Vector3 lip_p_B_m(const AirframeNumbers& airframe);

/// How far the ropes are pulled back from the lowest point.
/// @param speed_m_s  at the lowest point
/// @param length_m   of the ropes under load
/// @return angle with v^2 = 2 g L (1 - cos(angle)) [rad] @throws InternalError when there is none
[[nodiscard]] double swing_angle_rad(double speed_m_s, double length_m);

inline constexpr std::size_t kRopes = 4;

/// Unilateral spring-dampers, each from a point of the base straight up to one that is fixed.
struct Pendulum {
    std::array<Vector3, kRopes> hook_B_m{};
    std::array<Vector3, kRopes> anchor_W_m{};
    double rest_length_m = 0.0;
    double stiffness_N_m = 0.0;
    double damping_N_s_m = 0.0;
};
/// Hooks are the corners of a rectangle about the centre of mass that reaches as far forward and as
/// far sideways as the hubs: under the motors of a quad-x. Under its weight the vehicle hangs at
/// this pose.
/// @param lowest_p_WB_m  of the centre of mass
[[nodiscard]] Pendulum hang(const PendulumParameters& parameters, const Airframe& airframe,
                            const Vector3& lowest_p_WB_m, const Quaternion& q_WB);
/// @return of the ropes on the base about its origin, in W
[[nodiscard]] Wrench rope_wrench_W(const Pendulum& pendulum, const Kinematics& base);

/// A spring-damper in six directions that also carries the weight.
struct Clamp {
    double stiffness_N_m = 0.0;
    double damping_N_s_m = 0.0;
    double turn_stiffness_N_m_rad = 0.0;
    Vector3 turn_damping_N_m_s_rad = Vector3::Zero();  ///< about the axes of B
    double weight_N = 0.0;
};
[[nodiscard]] Clamp clamp(const PressRigParameters& parameters, const Airframe& airframe);
/// @param held  where the clamp is and how it moves; frame B
/// @return of the clamp on the base about its origin, in W
[[nodiscard]] Wrench clamp_wrench_W(const Clamp& clamp, const Kinematics& held,
                                    const Kinematics& base);

}  // namespace limpet::vehicle
