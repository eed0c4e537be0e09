// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/lanes.hpp"
#include "limpet/core/within_step.hpp"
#include "limpet/vehicle/airframe.hpp"

namespace limpet::vehicle {

/// Force of a joint's spring, damper and stops, mean over a step; > 0 towards larger positions. A
/// stop is a bumper, not a magnet: it only pushes back into the travel.
/// @param position  0 at the slider's outer stop or with the joint centred [m, rad]
/// @param mobility  change of the rate over the step by a unit of force; 0: the force as it stands
template <class T>
[[nodiscard]] StepForce<T> joint_force(const JointLawOf<T>& law, const T& position, const T& rate,
                                       const T& mobility, const T& step_s) {
    StepForce<T> force = within_step<T>(law.stiffness * (law.rest - position), law.stiffness,
                                        law.damping, rate, mobility, step_s);
    const auto above = position > law.upper;
    const auto below = position < law.lower;
    if (!any(above || below)) {
        return force;
    }
    const T beyond =
        select(above, position - law.upper, select(below, position - law.lower, T(0.0)));
    const StepForce<T> stop = within_step<T>(-law.stop_stiffness * beyond, law.stop_stiffness,
                                             law.stop_damping, rate, mobility, step_s);
    const auto pushes = stop.now * beyond < T(0.0);
    force.now += select(pushes, stop.now, T(0.0));
    force.gain += select(pushes, stop.gain, T(0.0));
    return force;
}

}  // namespace limpet::vehicle
