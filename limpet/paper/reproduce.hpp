// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/report/page.hpp"

namespace limpet::paper {

struct ReproduceOptions {
    std::filesystem::path folder;
    std::string only = {};  ///< name of a part; empty: all
    bool quick = false;     ///< fewer missions, coarser maps
    int jobs = 1;           ///< threads
    std::string command;    ///< as typed, for the page
};

/// How it is watched. Empty members watch nothing.
struct ReproduceWatch {
    /// @param part  from 1
    std::function<void(std::size_t part, std::size_t of, const std::string& title)> on_part;
    std::function<void(const std::string& what)> on_work;
    const std::atomic<bool>* stop =
        nullptr;  ///< set: it ends with Interrupted before the next step
};

struct Reproduction {
    report::Page page = {};
    std::vector<std::filesystem::path> files = {};  ///< index.html, results.json
    Evidence counts = {};                           ///< of the statements: kSummaryCounts
    std::vector<std::string> hanging = {};          ///< "`KEY` 20 % less: 3 statements", most first
    std::vector<std::string> notes = {};            ///< what no claim says, a line each
};

/// Names of the parts that `only` takes, with their titles.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> part_titles();

/// What evidence all parts together will have.
[[nodiscard]] std::vector<std::string> measured_names();

/// Flies the paper's experiments, measures them, judges its statements and writes
/// FOLDER/index.html, results.json, figures/, flights/ and campaigns/. With `only`, the statements
/// that this part bears on.
/// @throws InputError for a part that is none, a statement that is not right, an unwritable folder,
/// a missing gnuplot
Reproduction reproduce(const ReproduceOptions& options, const ReproduceWatch& watch = {});

}  // namespace limpet::paper
