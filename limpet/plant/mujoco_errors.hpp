// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet::plant {

/// Makes MuJoCo throw InternalError where it would print, write MUJOCO_LOG.TXT and end the process.
/// Its warnings stay silent: they are counted in mjData::warning, which the plant reads after every
/// step. Process-wide, as MuJoCo's hooks are; safe to call from any thread, any number of times.
void guard_mujoco();

}  // namespace limpet::plant
