// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "limpet/statements/claims.hpp"
#include "limpet/statements/registers.hpp"
#include "limpet/statements/study.hpp"
#include "limpet/statements/turned.hpp"

/// The parts of the paper, each in a file of its own.
namespace limpet::paper {

using statements::counted;
using statements::do_again;
using statements::Evidence;
using statements::filled;
using statements::hanging;
using statements::judge;
using statements::kBases;
using statements::kMovedColumns;
using statements::kSettledColumns;
using statements::kSummaryCounts;
using statements::kTurnedBy;
using statements::load_page_text;
using statements::load_readme_claims;
using statements::load_statements;
using statements::moved_rows;
using statements::number_or;
using statements::override_of;
using statements::page_text_file;
using statements::PageText;
using statements::PaperStatement;
using statements::readme_claims_file;
using statements::ReadmeClaim;
using statements::settled_row;
using statements::statements_file;
using statements::Study;
using statements::StudyPart;
using statements::TableRows;
using statements::Turn;
using statements::TurnedEvidence;
using statements::TurnedExperiment;
using statements::turns_named;
using statements::turns_of;

// Each brings its tables, figures and evidence.
[[nodiscard]] StudyPart rotors_part();       ///< Table I
[[nodiscard]] StudyPart suction_part();      ///< Table II, Fig. 2
[[nodiscard]] StudyPart trials_part();       ///< Fig. 3
[[nodiscard]] StudyPart flights_part();      ///< Figs. 9 to 15
[[nodiscard]] StudyPart recorded_part();     ///< Figs. 4, 5
[[nodiscard]] StudyPart oscillation_part();  ///< the open question
[[nodiscard]] StudyPart causes_part();       ///< of it, with probabilities
[[nodiscard]] StudyPart beyond_part();       ///< valve, energy, break-off loads
[[nodiscard]] StudyPart assumptions_part();  ///< what README.md's claims hang on
/// In the paper's order.
[[nodiscard]] const std::vector<StudyPart>& parts();

/// A flight, or flights, of parts that are not at hand here, flown elsewhere and kept:
/// data/paper/recorded/NAME.json, by data/paper/record or tests/px4/real.
/// @throws InputError when it is none
[[nodiscard]] nlohmann::json read_recorded(const std::string& name);

}  // namespace limpet::paper
