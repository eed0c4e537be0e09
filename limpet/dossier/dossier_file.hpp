// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace limpet::dossier {

/// An input that is not known well.
struct UncertainInput {
    std::string key;
    std::string spread;  ///< as a campaign's file has it: "{uniform: [350, 650]}"
    std::string source;
};

/// A number that somebody decides by.
struct Quantity {
    std::string name;
    std::string figure;
    std::string scenario;
    std::string unit;
    std::string use;
    std::string influence;              ///< of the simulation on the decision
    std::string consequence;            ///< of a wrong one
    bool safe_above = false;            ///< larger is safer: the bound is a least value
    std::vector<std::string> evidence;  ///< ids of the paper's statements
};

/// A file like data/paper/dossier.yaml, whose head says what its keys are.
struct DossierFile {
    std::string title;
    std::string question;
    std::map<std::string, std::vector<UncertainInput>> inputs;  ///< by scenario
    std::vector<Quantity> quantities;
};

/// @throws InputError one line: file:line, key, value, what is allowed
[[nodiscard]] DossierFile load_dossier(const std::filesystem::path& file);

}  // namespace limpet::dossier
