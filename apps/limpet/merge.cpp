// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <string>

#include "command_line.hpp"
#include "limpet/campaign/results.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

struct MergeOptions {
    std::vector<std::string> parts;
    std::string out;
};

OptionList options_of(MergeOptions& options) {
    return {{"parts DIR", &options.parts, "folders of shards, or their results.sqlite",
             values(1, 100000)},
            {"--out DIR", &options.out, "folder of the one file", required()}};
}

void merge(const MergeOptions& options) {
    std::vector<fs::path> parts;
    for (const std::string& part : options.parts) {
        parts.push_back(campaign::Results::file_of(part));
    }
    const OutFolder folder(options.out);
    const fs::path target = folder.path() / campaign::Results::kFileName;
    const std::uint32_t rows = campaign::merge_results(parts, target);
    fmt::print("{} runs of {} files\n{}\n", rows, parts.size(), target.string());
}

}  // namespace

Verb merge_verb() {
    return verb<MergeOptions>(
        "merge", "Make one file of results of a campaign's shards", options_of, merge,
        "The rows are those of the campaign flown in one go. Shards that overlap, are missing or "
        "unfinished,\nor are of another campaign, seed or version are refused, and nothing is "
        "written.\n");
}

}  // namespace limpet::app
