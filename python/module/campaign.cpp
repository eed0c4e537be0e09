// SPDX-License-Identifier: Apache-2.0
#include "limpet/campaign/campaign.hpp"

#include <pybind11/functional.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <future>

#include "limpet/campaign/workers.hpp"
#include "limpet/core/folder_lock.hpp"
#include "module.hpp"

namespace limpet::python {
namespace {

using OnProgress = std::function<void(std::uint32_t finished, std::uint32_t runs)>;

/// Flies the runs that are missing, on other threads, while this one listens to Ctrl-C.
/// @return the file of results
std::filesystem::path run_campaign(const std::string& wanted, const std::filesystem::path& folder,
                                   int jobs, bool resume, const OnProgress& on_progress) {
    const campaign::Campaign asked = campaign::load_campaign(wanted);
    std::filesystem::create_directories(folder);
    const FolderLock lock(folder);
    campaign::Results results = campaign::begin_results(asked, folder, resume);
    std::atomic<bool> stop = false;
    std::atomic<std::uint32_t> finished = 0;
    auto flown = std::async(std::launch::async, [&] {
        const auto count = [&](const campaign::Progress& p) { finished = p.finished; };
        campaign::run_campaign(results, jobs, {.on_progress = count, .stop = &stop});
    });
    const auto wait = [&] {
        const py::gil_scoped_release fly_freely;
        return flown.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
    };
    while (!wait()) {
        if (on_progress && !stop) {
            on_progress(finished, asked.runs);
        }
        if (PyErr_CheckSignals() != 0) {
            const py::error_already_set interrupted;
            stop = true;
            const py::gil_scoped_release land;
            flown.wait();
            throw interrupted;
        }
    }
    flown.get();
    return folder / campaign::Results::kFileName;
}

}  // namespace

void add_campaign(py::module_& module) {
    module.def("_run_campaign", &run_campaign, py::arg("wanted"), py::arg("folder"),
               py::arg("jobs"), py::arg("resume"), py::arg("on_progress"));
}

}  // namespace limpet::python
