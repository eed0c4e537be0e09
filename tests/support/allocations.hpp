// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet {

/// @return calls of operator new by this thread, since it began
[[nodiscard]] long allocations();

}  // namespace limpet
