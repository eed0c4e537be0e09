// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace limpet::dossier {

struct DossierOptions {
    std::filesystem::path folder;
    std::filesystem::path file;  ///< empty: paper/dossier.yaml of the data
    bool quick = false;          ///< fewer flights
    int jobs = 1;
    std::string command = {};  ///< for the page
};

/// Empty members do nothing.
struct DossierWatch {
    std::function<void(const std::string& what)> on_work = {};
    const std::atomic<bool>* stop = nullptr;
};

/// Flies what the file needs and writes index.html and results.json into the folder, with the runs
/// that they link to: campaigns of seeds, steps and engines, a study of the inputs, and the paper's
/// flights that are its evidence.
/// @return the files
/// @throws InputError for a file that is not so, Interrupted when stopped
std::vector<std::filesystem::path> write_dossier(const DossierOptions& options,
                                                 const DossierWatch& watch = {});

}  // namespace limpet::dossier
