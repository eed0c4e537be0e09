// SPDX-License-Identifier: Apache-2.0
//
// What docs/scaling.md counts with. Alone: what a run costs a processor, and what a row costs the
// file of results. As two ranks: what its message costs.
//   build/release/bench/scaling_bench [ROWS]
//   mpirun -n 2 build/release/bench/scaling_bench

#include <dlfcn.h>
#include <fmt/core.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

#include "limpet/campaign/results.hpp"
#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "limpet/ranks/rank_link.hpp"

namespace limpet {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kRows = 200'000;
constexpr std::uint32_t kFlights = 48;
constexpr int kMessages = 200'000;

double seconds_of(const auto& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double processor_s() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

campaign::Campaign campaign_of(const fs::path& folder, std::uint32_t runs) {
    const auto path = folder / "bench.yaml";
    std::ofstream(path) << "scenario: perch_concrete\nruns: " << runs
                        << "\nparameters:\n"
                           "  guidance.dock_speed_m_s: {uniform: [1.0, 1.2]}\n"
                           "  simulation.start_offset_m: {uniform: [-0.1, 0.1]}\n";
    return campaign::load_campaign(path.string());
}

fs::path made(const fs::path& folder) {
    fs::create_directories(folder);
    return folder;
}

void count_flights(const fs::path& folder) {
    campaign::Results results =
        begin_results(campaign_of(folder, kFlights), made(folder / "flights"), false);
    const double before_s = processor_s();
    (void)run_campaign(results, 1);
    fmt::print("perch_concrete, one thread   {:10.1f} flights a processor second\n",
               kFlights / (processor_s() - before_s));
}

/// The rows of a shard, all alike but for their number.
fs::path filled(const fs::path& folder, const campaign::Campaign& campaign,
                const campaign::Shard& shard, double& took_s) {
    campaign::Results results = begin_results(campaign, made(folder), false, shard);
    campaign::RunRow row = campaign::fly_run(campaign, 0);
    took_s += seconds_of([&] {
        for (row.run = shard.begin(campaign.runs); row.run < shard.end(campaign.runs); ++row.run) {
            results.add({row});
        }
        results.finish();
    });
    return folder / campaign::Results::kFileName;
}

void count_rows(const fs::path& folder, std::uint32_t rows) {
    const campaign::Campaign campaign = campaign_of(folder, rows);
    double fill_s = 0.0;
    const fs::path one = filled(folder / "one", campaign, {.part = 1, .parts = 2}, fill_s);
    const fs::path two = filled(folder / "two", campaign, {.part = 2, .parts = 2}, fill_s);
    fmt::print("rows written one by one      {:10.0f} a second\n", rows / fill_s);
    const fs::path whole = folder / "whole.sqlite";
    const double merge_s = seconds_of([&] { (void)campaign::merge_results({one, two}, whole); });
    fmt::print("rows merged                  {:10.0f} a second\n", rows / merge_s);
    fmt::print("a row in results.sqlite      {:10.1f} bytes\n",
               static_cast<double>(fs::file_size(whole)) / rows);
    const double open_s =
        seconds_of([&] { campaign::Results results(whole, campaign::Access::read); });
    fmt::print("rows checked when opened     {:10.0f} a second\n", rows / open_s);
    campaign::Results results(whole, campaign::Access::read);
    const double list_s = seconds_of([&] { (void)results.finished_runs(); });
    fmt::print("rows listed to resume        {:10.0f} a second, {} bytes of memory each\n",
               rows / list_s, sizeof(std::uint32_t));
}

/// @param bytes  of a message, about those of a row
void count_messages(ranks::RankLink& link, std::size_t bytes) {
    if (link.rank() == 1) {
        const std::string message(bytes, 'x');
        for (int i = 0; i < kMessages; ++i) {
            link.send(0, message);
            (void)link.receive();  // lets go of what has arrived
        }
        while (!link.receive()) {  // until they are all there
        }
    } else if (link.rank() == 0) {
        const double took_s = seconds_of([&] {
            for (int got = 0; got < kMessages;) {
                got += link.receive() ? 1 : 0;
            }
        });
        link.send(1, "thanks");
        fmt::print("messages of {:4} bytes       {:10.0f} a second into one rank\n", bytes,
                   kMessages / took_s);
    }
}

void measure(int argc, char** argv) {
    if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr) {
        void* module = dlopen(LIMPET_MPI_MODULE, RTLD_NOW | RTLD_GLOBAL);
        void* open = module != nullptr ? dlsym(module, ranks::kOpenRankLink) : nullptr;
        if (open == nullptr) {
            throw InputError(dlerror());
        }
        const std::unique_ptr<ranks::RankLink> link(reinterpret_cast<ranks::OpenRankLink*>(open)());
        count_messages(*link, 64);
        count_messages(*link, 512);
        link->leave();
        return;
    }
    const draw::gnuplot::TemporaryFolder folder;
    count_flights(folder.path());
    count_rows(folder.path(), argc > 1 ? static_cast<std::uint32_t>(std::stoul(argv[1])) : kRows);
}

}  // namespace
}  // namespace limpet

int main(int argc, char** argv) {
    try {
        limpet::measure(argc, argv);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "scaling_bench: {}\n", error.what());
        return 70;
    }
}
