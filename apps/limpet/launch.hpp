// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "limpet/ranks/rank_link.hpp"

namespace limpet::app {

/// The link to the other processes that mpirun or srun has started; null: there are none. MPI is
/// loaded only where there are several. It lasts until the process ends; a process that ends
/// without leaving it ends the others too, and has reported its reason by then.
/// @throws InputError when there are several without MPI: each would do all the work
[[nodiscard]] ranks::RankLink* ranks_started();

/// For work that one process does alone: several part.
/// @return whether this is one of several, but not the first
/// @throws InputError `why`, in the first of several
[[nodiscard]] bool left_to_rank_0(const std::string& why);

}  // namespace limpet::app
