// SPDX-License-Identifier: Apache-2.0
//
// What a whole perch_concrete flight costs: the bare physics, the loop around it, the recording of
// it, and the loop on MuJoCo. Runs them interleaved and prints medians and their ratios;
// instructions, station by station, are bench/instructions'.
//   build/release/bench/flight_bench
//   build/release/bench/flight_bench --benchmark_repetitions=21

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "limpet/plant/lane_group.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/step.hpp"
#include "tape.hpp"

namespace limpet {
namespace {

const std::shared_ptr<const simulation::FlightModel>& model() {
    static const auto shared = simulation::build_model(scenario::load_scenario("perch_concrete"));
    return shared;
}
const std::shared_ptr<const simulation::FlightModel>& on_mujoco_model() {
    static const auto shared = simulation::build_model(
        scenario::load_scenario("perch_concrete", {.overrides = {"simulation.engine=mujoco"}}));
    return shared;
}

struct Tape {
    plant::PlantState start;
    plant::PlantState end;
    std::vector<PlantStep> steps;
    double simulated_s = 0.0;
};

const Tape& tape() {
    static const Tape shared = [] {
        const auto made = model()->plant->make();
        plant::Plant& plant = *made;
        simulation::FlightState state = start(*model(), plant);
        Tape recorded;
        recorded.start = plant.save();
        TapePlant writer(plant);
        simulation::TickReport report;
        while (!state.ending && !state.guidance.ending) {
            step(*model(), state, writer, report);
        }
        recorded.steps = writer.steps();
        recorded.end = plant.save();
        recorded.simulated_s = seconds(state.tick);
        return recorded;
    }();
    return shared;
}

void report(benchmark::State& state, double simulated_s) {
    state.counters["x_real_time"] = benchmark::Counter(
        simulated_s * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void bare_physics(benchmark::State& state) {
    const auto made = model()->plant->make();
    plant::Plant& plant = *made;
    for (auto _ : state) {
        plant.restore(tape().start);
        for (const PlantStep& step : tape().steps) {
            step.play(plant);
        }
    }
    if (plant.save().values != tape().end.values) {
        state.SkipWithError("the replayed physics is not that of the flight");
    }
    report(state, tape().simulated_s);
}

void whole_loop(benchmark::State& state) {
    for (auto _ : state) {
        benchmark::DoNotOptimize(fly(model()).state_hash);
    }
    report(state, tape().simulated_s);
}

/// As a campaign flies: its runs side by side.
constexpr std::uint32_t kSideBySide = 32;
void in_lanes(benchmark::State& state) {
    for (auto _ : state) {
        std::uint32_t next = 0;
        plant::fly_side_by_side([&next] {
            while (next < kSideBySide) {
                benchmark::DoNotOptimize(fly(model(), {}, {}, next++).state_hash);
            }
        });
    }
    report(state, tape().simulated_s * kSideBySide);
}

void on_mujoco(benchmark::State& state) {
    for (auto _ : state) {
        benchmark::DoNotOptimize(fly(on_mujoco_model()).state_hash);
    }
    report(state, tape().simulated_s);
}

void with_recording(benchmark::State& state) {
    const auto path = std::filesystem::temp_directory_path() / "limpet_flight_bench.mcap";
    for (auto _ : state) {
        benchmark::DoNotOptimize(fly(model(), path).state_hash);
    }
    std::filesystem::remove(path);
    report(state, tape().simulated_s);
}

/// Keeps the medians for the ratios at the end.
class Medians : public benchmark::ConsoleReporter {
public:
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.aggregate_name == "median") {
                median_[run.run_name.function_name] = run.GetAdjustedRealTime();
            }
        }
        ConsoleReporter::ReportRuns(runs);
    }
    void print_ratios() {
        const double bare = median_["bare_physics"];
        const double loop = median_["whole_loop"];
        if (bare <= 0.0 || loop <= 0.0) {
            return;
        }
        fmt::print("\nperch_concrete, {:.1f} s, medians:\n", tape().simulated_s);
        fmt::print("  whole loop / bare physics        {:.3f}\n", loop / bare);
        fmt::print("  flights a second, / on MuJoCo    {:.2f}    (goal: at least 5)\n",
                   median_["on_mujoco"] / loop);
        fmt::print("  flights a second                 {:.1f}\n", 1e3 / loop);
        const double lane = median_["in_lanes"] / kSideBySide;
        fmt::print("  side by side ({}), / on MuJoCo   {:.2f}\n", plant::widest_lanes().name,
                   median_["on_mujoco"] / lane);
        fmt::print("  side by side, flights a second   {:.1f}\n", 1e3 / lane);
        fmt::print("  with recording / whole loop      {:.3f}\n", median_["with_recording"] / loop);
        fmt::print("  whole loop, times real time      {:.0f}     (goal: at least 100)\n",
                   tape().simulated_s / (loop * 1e-3));
    }

private:
    std::map<std::string, double> median_;
};

}  // namespace
}  // namespace limpet

int main(int argc, char** argv) {
    std::vector<char*> arguments(argv, argv + argc);
    std::string repetitions = "--benchmark_repetitions=11";
    std::string interleaved = "--benchmark_enable_random_interleaving=true";
    std::string aggregates = "--benchmark_report_aggregates_only=true";
    std::string shortest = "--benchmark_min_time=0.3";
    for (std::string* preset : {&repetitions, &interleaved, &aggregates, &shortest}) {
        arguments.insert(arguments.begin() + 1, preset->data());  // later ones win
    }
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) {
        return 2;
    }
    const auto add = [](const char* name, void (*function)(benchmark::State&)) {
        benchmark::RegisterBenchmark(name, function)->Unit(benchmark::kMillisecond);
    };
    add("bare_physics", limpet::bare_physics);
    add("whole_loop", limpet::whole_loop);
    add("in_lanes", limpet::in_lanes);
    add("on_mujoco", limpet::on_mujoco);
    add("with_recording", limpet::with_recording);
    limpet::Medians reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    reporter.print_ratios();
    benchmark::Shutdown();
    return 0;
}
