// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limpet/assumptions/assumptions.hpp"
#include "limpet/dossier/dossier.hpp"
#include "limpet/report/page.hpp"
#include "limpet/study/study.hpp"

namespace limpet::dossier {

/// An input that is not known well.
struct UncertainInput {
    std::string key;
    std::string spread;  ///< as a campaign's file has it: "{uniform: [350, 650]}"
    std::string source;
};

/// A number that a decision rests on.
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

/// A file like data/paper/dossier.yaml, whose head describes its keys.
struct DossierFile {
    std::string title;
    std::string question;
    std::map<std::string, std::vector<UncertainInput>> inputs;  ///< by scenario
    std::vector<Quantity> quantities;
};

/// @throws InputError one line: file:line, key, value, what is allowed
[[nodiscard]] DossierFile load_dossier(const std::filesystem::path& file);

/// A mean with its 95 % interval, and where it was flown.
struct Measured {
    double value = 0.0;
    double half_width = 0.0;
    double deviation = 0.0;     ///< of single flights
    std::uint32_t flights = 0;  ///< that have it, of those flown
    std::uint32_t flown = 0;
    std::string from;  ///< path relative to the page
};

/// The least value, or the most, that a share of flights keeps with a confidence, whatever their
/// distribution: an order statistic.
/// @param sorted  independent flights, ascending
/// @return nullopt where there are too few: 59 for 95 % of the flights with 95 % confidence
/// Source: Wilks, Annals of Mathematical Statistics 12 (1941) 91.
[[nodiscard]] std::optional<double> tolerance_bound(const std::vector<double>& sorted, bool least,
                                                    double share, double confidence);

/// What has been flown for one quantity.
struct QuantityFound {
    Measured nominal;                ///< over seeds, all else as set
    Measured step;                   ///< finer steps less the nominal, seed by seed
    std::optional<Measured> engine;  ///< another engine less the nominal; none is built in
    std::string other_engine;
    study::StudyFound inputs;
    std::string inputs_from;
    /// Every assumed value of the scenario turned: the quantities of a scenario share it.
    std::shared_ptr<const assumptions::Register> assumed;
    std::string assumed_from;
    /// Of the inputs' and seeds' spread, moved by the numerical error to the unsafe side.
    std::optional<double> bound;
    double numerical = 0.0;  ///< that error: step and engine at the far ends of their intervals
    std::vector<std::pair<report::Claim, std::string>> evidence;  ///< with its page
};

/// The share of flights that the bound holds for, and how sure that is.
inline constexpr double kShareHeld = 0.95;
inline constexpr double kHeldConfidence = 0.95;

/// Flies all that a file needs, below the folder.
[[nodiscard]] std::map<std::string, QuantityFound> fly_dossier(const DossierFile& file,
                                                               const DossierOptions& options,
                                                               const DossierWatch& watch);

}  // namespace limpet::dossier
