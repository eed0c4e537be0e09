// SPDX-License-Identifier: Apache-2.0
#include "launch.hpp"

#include <dlfcn.h>
#include <fmt/core.h>

#include <cstdlib>
#include <memory>
#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet::app {
namespace {

constexpr const char* kModule = "limpet_mpi.so";

/// The variable in which each launcher passes the number of processes. Open MPI's first: its mpirun
/// may itself run under one of the others, which then count mpirun's daemons.
constexpr std::pair<const char*, const char*> kLaunchers[] = {
    {"OMPI_COMM_WORLD_SIZE", "mpirun"},
    {"PMI_SIZE", "mpiexec"},
    {"SLURM_STEP_NUM_TASKS", "srun"},
};

struct Launch {
    int ranks = 1;
    const char* by = "";
};

Launch launch() {
    for (const auto& [variable, by] : kLaunchers) {
        if (const char* count = std::getenv(variable)) {
            return {.ranks = std::atoi(count), .by = by};
        }
    }
    return {};
}

/// The module outlives all that comes of it: it stays loaded.
ranks::OpenRankLink* module_of_mpi(const Launch& launch) {
    void* module = dlopen(kModule, RTLD_NOW | RTLD_GLOBAL);
    void* open = module != nullptr ? dlsym(module, ranks::kOpenRankLink) : nullptr;
    if (open == nullptr) {
        throw InputError(fmt::format(
            "{} started {} of these, but MPI is not there to tie them together ({}): install Open "
            "MPI and build anew, or fly a --shard each",
            launch.by, launch.ranks, dlerror()));
    }
    return reinterpret_cast<ranks::OpenRankLink*>(open);
}

}  // namespace

ranks::RankLink* ranks_started() {
    const Launch started = launch();
    if (started.ranks < 2) {
        return nullptr;
    }
    static const std::unique_ptr<ranks::RankLink> link(module_of_mpi(started)());
    if (link->ranks() < 2) {
        link->leave();
        throw InputError(fmt::format(
            "{} started {} of these, but Open MPI knows of one: use Open MPI's mpirun, srun "
            "--mpi=pmix, or fly a --shard each",
            started.by, started.ranks));
    }
    return link.get();
}

bool left_to_rank_0(const std::string& why) {
    ranks::RankLink* link = ranks_started();
    if (link == nullptr) {
        return false;
    }
    link->leave();
    if (link->rank() == 0) {
        throw InputError(why);
    }
    return true;
}

}  // namespace limpet::app
