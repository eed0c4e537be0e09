// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet {

/// @return calls of operator new by this thread, since it began
[[nodiscard]] long allocations();

/// @return bytes that this thread has allocated by operator new since it began, freed or not
[[nodiscard]] unsigned long allocated_bytes();

}  // namespace limpet
