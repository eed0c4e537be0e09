// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet::gazebo11 {

/// From now on ODE's complaints of its contact solver are counted instead of printed, a line a
/// step: with friction the direct solver now and then takes what it has found until then. All else
/// that ODE says goes on to stderr.
void count_solver_complaints();

/// @return how many there were since the last call
[[nodiscard]] long long take_solver_complaints();

}  // namespace limpet::gazebo11
