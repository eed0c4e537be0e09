// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "limpet/scenario/scenario.hpp"
#include "limpet/statements/study.hpp"

/// Experiments done again with an assumed value turned: which verdicts hang on it.
namespace limpet::statements {

/// By which share of itself a value is turned, as Fig. 3's trials are moved.
inline constexpr double kTurnedBy = 0.2;

/// A value whose source is "assumed", turned by itself.
struct Turn {
    std::string key;
    bool more = false;  ///< else less
    friend bool operator==(const Turn&, const Turn&) = default;
};
/// "`vehicle.slider.damping_N_s_m` 20 % less"
[[nodiscard]] std::string to_text(const Turn& turn);

/// Every assumed value of any of the scenarios, both ways.
[[nodiscard]] std::vector<Turn> turns_of(const std::vector<scenario::Scenario>& scenarios);

/// Those of the keys that statements of such evidence are said to rest on.
[[nodiscard]] std::vector<Turn> turns_named(const Study& study,
                                            const std::vector<std::string>& evidence);

/// "KEY=VALUE" that turns it in a scenario.
/// @return nothing where the scenario has no such value, the paper gives it, or it stands at the
/// end
///         of its range
[[nodiscard]] std::optional<std::string> override_of(const Turn& turn,
                                                     const scenario::Scenario& scenario);

/// An experiment that can be done again.
struct TurnedExperiment {
    std::string name;                   ///< of its file
    std::vector<std::string> evidence;  ///< names that it measures
    std::vector<Turn> turns;            ///< besides those that statements name, which --quick does
    /// The whole evidence with a value turned; InputError where it does not go with the others.
    /// Called on several threads.
    std::function<Evidence(const Turn& turn)> measure;
};

/// Does it again with each value turned, after it has been done as it is, and keeps in study.turned
/// what the statements ask for. FOLDER/assumptions/NAME_turned.json holds what was measured; a
/// later run into the same folder takes from there what was measured of the same experiment: as
/// quick or not, and with an evidence as it is that equals the file's bit for bit.
/// @throws Interrupted; what was measured until then is in the file
void do_again(Study& study, const TurnedExperiment& experiment);

}  // namespace limpet::statements
