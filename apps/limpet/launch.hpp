// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/ranks/rank_link.hpp"

namespace limpet::app {

/// What ties this process to those that mpirun or srun has started with it; null: it was started
/// alone. MPI is loaded only where there are several. To be asked once. It lasts until the process
/// ends: who breaks off without leaving it has said why before it takes the others along.
/// @throws InputError when there are several that nothing ties together: each would do all the work
[[nodiscard]] ranks::RankLink* ranks_started();

/// For what flies in one process alone: where there are several, they part.
/// @return whether this one has nothing to say
/// @throws InputError `why`, in the first of several
[[nodiscard]] bool sent_home(const std::string& why);

}  // namespace limpet::app
