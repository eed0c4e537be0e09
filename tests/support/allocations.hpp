// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet {

/// @return calls of operator new since the test program began
[[nodiscard]] long allocations();

}  // namespace limpet
