// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/campaign.hpp"

#include <fmt/format.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <atomic>
#include <future>

#include "air.hpp"
#include "limpet/campaign/workers.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/folder_lock.hpp"
#include "limpet/statistics/shares.hpp"
#include "module.hpp"

namespace limpet::python {
namespace {

/// Some twenty times a second: how it goes, Ctrl-C, the interpreter's end.
constexpr auto kLookAgain = std::chrono::milliseconds(50);

using OnProgress = std::function<void(std::uint32_t finished, std::uint32_t runs)>;

/// When a campaign ends early, by Ctrl-C or an exception of the callback: waits for the flights in
/// progress, without the GIL. At the interpreter's end they are dropped.
struct LandsFirst {
    ~LandsFirst() {
        if (!flown.valid()) {
            return;
        }
        stop = true;
        break_off = interpreter_ends();
        try {
            const py::gil_scoped_release land;
            while (flown.wait_for(kLookAgain) != std::future_status::ready) {
                break_off = interpreter_ends();
            }
        } catch (...) {  // another exception is on its way
        }
    }
    std::atomic<bool>& stop;
    std::atomic<bool>& break_off;
    std::future<void>& flown;
};

/// What a campaign's file counts as success.
std::vector<std::string> success_of(const std::string& yaml) {
    std::vector<std::string> names;
    for (const Outcome outcome : campaign::parse_campaign(yaml, "campaign", "").campaign.success) {
        names.emplace_back(to_string(outcome));
    }
    return names;
}

/// Share of successes, and its 95 % interval from the first to the last.
std::array<double, 3> share(std::uint32_t successes, std::uint32_t runs) {
    if (successes > runs) {
        throw InputError(fmt::format("{} successes of {} runs", successes, runs));
    }
    const statistics::Proportion proportion{.successes = successes, .runs = runs};
    const statistics::Interval interval = proportion.interval();
    return {proportion.probability(), interval.low, interval.high};
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        throw InputError(fmt::format("campaign(): out = {}: cannot make this folder: {}",
                                     folder.string(), error.message()));
    }
}

bool bears_out_named(const std::string& truth, const std::string& outcome) {
    const auto end = true_end_from(truth);
    const auto reported = outcome_from(outcome);
    return end && reported && bears_out(*end, *reported);
}

/// Flies the runs that are missing, on other threads, while this one waits for Ctrl-C.
/// @return the file of results
std::filesystem::path run_campaign(const std::string& wanted, const std::filesystem::path& folder,
                                   int jobs, bool resume, const OnProgress& on_progress) {
    constexpr int kMostJobs = 1024;  // as the program's
    const InTheAir in_the_air;
    if (jobs < 1 || jobs > kMostJobs) {
        throw InputError(
            fmt::format("campaign(): jobs = {} is out of range, allowed 1..{}", jobs, kMostJobs));
    }
    std::atomic<bool> stop = false, break_off = false;
    std::atomic<std::uint32_t> finished = 0, runs = 0;
    auto flown = std::async(std::launch::async, [&] {
        const campaign::Campaign asked = campaign::load_campaign(wanted, {}, {.stop = &stop});
        make_folder(folder);
        const FolderLock lock(folder);
        campaign::Results results = campaign::begin_results(asked, folder, resume);
        finished = results.finished();
        runs = asked.runs;
        const auto count = [&](const campaign::Progress& p) { finished = p.finished; };
        campaign::run_campaign(results, jobs,
                               {.on_progress = count, .stop = &stop, .break_off = &break_off});
    });
    const LandsFirst lands{stop, break_off, flown};
    const auto wait = [&] {
        const py::gil_scoped_release fly_freely;
        return flown.wait_for(kLookAgain) == std::future_status::ready;
    };
    while (!wait()) {
        if (on_progress && runs > 0) {
            on_progress(finished, runs);
        }
        if (interpreter_ends()) {
            throw InterpreterEnds();
        }
        if (PyErr_CheckSignals() != 0) {
            throw py::error_already_set();
        }
    }
    flown.get();
    if (on_progress) {
        on_progress(finished, runs);
    }
    return folder / campaign::Results::kFileName;
}

}  // namespace

void add_campaign(py::module_& module) {
    module.def("_run_campaign", &run_campaign, py::arg("wanted"), py::arg("folder"),
               py::arg("jobs"), py::arg("resume"), py::arg("on_progress"));
    module.def("_success_of", &success_of, py::arg("yaml"));
    module.def("_share", &share, py::arg("successes"), py::arg("runs"));
    module.def("_bears_out", &bears_out_named, py::arg("true_end"), py::arg("outcome"));
}

}  // namespace limpet::python
