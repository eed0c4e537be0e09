// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "limpet/campaign/rank_link.hpp"

namespace limpet::app {

/// What ties this process to those that mpirun or srun has started with it; null: it was started
/// alone. MPI is loaded only where there are several.
/// @throws InputError when there are several that nothing ties together: each would do all the work
[[nodiscard]] std::unique_ptr<campaign::RankLink> ranks_started();

}  // namespace limpet::app
