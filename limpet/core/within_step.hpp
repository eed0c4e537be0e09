// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet {

/// A force that gives way within the step in which it acts: mean over the step = now - gain dv,
/// where dv is by how much the rate changes over the step.
template <class T>
struct StepForce {
    T now{};
    T gain{};
};

/// Mean force over a step of a spring k and a damper c in parallel on something light.
///
/// Bodies are stepped as v+ = v + dv, x+ = x + h v+, so rates belong to the middle of the steps.
/// There the trapezoidal rule is k (x + h dv / 4) and c (v + dv / 2): of second order, and stable
/// for any k and c. What is so stiff, or so damped, that it is over within a step would ring on for
/// ever; it goes over into the implicit Euler rule k (x + h v+), c v+, and comes to rest. In
/// between the damper's weight is a rational of c's exact one, 1/(1 - exp(-z)) - 1/z with z = h c /
/// m. docs/decisions/0020.
///
/// @param spring_N     of the spring as it stands, against x
/// @param k            its slope, >= 0 [N/m]
/// @param c            >= 0 [N s/m]
/// @param rate         v [m/s]
/// @param mobility     change of v over a step by a unit of force: h / m; 0: the force as it stands
///                     [m/s/N]
/// @param step_s       h
template <class T>
[[nodiscard]] StepForce<T> within_step(const T& spring_N, const T& k, const T& c, const T& rate,
                                       const T& mobility, const T& step_s) {
    const T stiff = k * step_s * mobility;  // (omega h)^2
    const T lag = stiff / (4.0 + stiff);    // 0 trapezoidal, 1 implicit Euler
    const T resistance = c + lag * step_s * k;
    const T damped = resistance * mobility;  // z
    const T weight = 0.5 + damped / (12.0 + 2.0 * damped);
    return {spring_N - resistance * rate, weight * resistance + (1.0 - lag) * 0.25 * step_s * k};
}

}  // namespace limpet
