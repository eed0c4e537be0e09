// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "limpet/core/random.hpp"
#include "limpet/core/signals/cup_status.hpp"
#include "limpet/core/signals/event.hpp"
#include "limpet/suction/force_law.hpp"
#include "limpet/suction/pressure_model.hpp"
#include "limpet/suction/surface.hpp"

namespace limpet::suction {

// Fig. 6 of the paper as a state machine. The joint of its plugin is `attached`; the threshold and
// the dwell are those of its section III.B. Every row is checked in each step, top first.
//
//   free       touching    the lip meets the wall, mouth first (the seal's demand is drawn)
//   touching   free        the lip lifts off                                  -> contact_lost
//   touching   sealing     pump on, valve shut, press force above the threshold, tilt below its
//                          limit, and the lip lies still: it neither slides nor rocks
//   sealing    touching    load beyond a limit while still pressed: it slid or rocked open
//   sealing    free        load beyond a limit: pulled, sheared, peeled       -> contact_lost
//   sealing    unsealing   pump off or valve open
//   sealing    attached    pressure below the attachment threshold            -> attached
//   attached   free        load beyond a limit                                -> contact_lost
//   attached   unsealing   pump off or valve open
//   unsealing  free        the load opens it                                  -> detached
//   unsealing  sealing     pump on again, valve shut
//
// A touch lasts until the lip has lifted: its demand is drawn once, however often the lip seals and
// opens in between. A cup that lets go while its lip still meets the wall is `touching` until it
// lifts; what happened was reported when it let go.

struct CupParameters {
    LipParameters lip;
    PressureParameters pressure;
    double attachment_pressure_Pa = 88000.0;  ///< below it the phase is attached; see cup_table()
    bool valve_fitted = false;                ///< a solenoid valve breaks the vacuum
    double seal_creep_1_s = 0.0;              ///< growth of a seal's leak by time
    double seal_wear_1_N = 0.0;               ///< and by what the pull on it rises and falls
    double pump_runs_on_s = 0.0;              ///< draws for so long after it was switched off
    int pressure_model = 0;                   ///< place in pressure_models()
    double ambient_Pa = kAtmosphere_Pa;       ///< of the air around; the environment's, no row
};

[[nodiscard]] inline const PressureModel& model_of(const CupParameters& cup) {
    return pressure_models()[static_cast<std::size_t>(cup.pressure_model)];
}

/// Rows of `suction:` other than the lip's and the pressure models'.
[[nodiscard]] const ParameterTable<CupParameters>& cup_table();

/// Immutable during a flight.
struct CupModel {
    CupParameters parameters;
    WallGeometry wall;
};

/// Long before a flight begins.
inline constexpr double kNever_s = 1e9;

struct CupState {
    CupStatus status;
    double mean_pressure_Pa =
        kAtmosphere_Pa;  ///< without ripple; the status adds the pump's ripple
    Anchor anchor;
    SealDemand demand;
    bool pump_resting = false;     ///< a cycling pump between two refills
    double leak_growth = 0.0;      ///< of this seal, over its fresh leak
    double worn_at_N = 0.0;        ///< pull of the step before
    double pulled_N = 0.0;         ///< likewise, as the cup's volume felt it
    double pump_on_s = -kNever_s;  ///< when it was last switched on
    int touches = 0;
    bool let_go_said = false;  ///< of this touch: lifting off is no more news
    RandomStream random;
};

struct CupInput {
    double time_s = 0.0;
    double press_N = 0.0;         ///< through the mechanism, > 0 presses the cup on the wall [N]
    CupBearer* bearer = nullptr;  ///< what hangs on the cup; it knows the press better
    bool pump_on = false;
    bool valve_open = false;
    bool pump_draws = true;  ///< false: it runs for nothing, or its hose is blocked
    double hole_mm2 = 0.0;   ///< to the atmosphere, in hose or lip
    /// In T, about the lip's centre: what a joint, that holds the cup in the lip's place, does to
    /// it.
    std::optional<Wrench> held_T = {};
};

struct CupOutput {
    Wrench wrench_W;  ///< by the wall (or its joint) on the cup about the lip's centre, in W
    std::optional<Event> event;  ///< attached, contact_lost, detached
};

/// One step: load at this state, then pressure over `dt_s`.
/// @param surface  of the spot that is under the cup now
/// @param cup      frame C, from the plant
[[nodiscard]] CupOutput step(const CupModel& model, CupState& state, const Surface& surface,
                             const Kinematics& cup, const CupInput& input, double dt_s);

// What step() is made of, for a cup whose lip is felt in one place and whose seal and pressure are
// kept in another (the paper's Figs. 5 and 6: plugin and node).

/// What seal and pressure go by, of the lip's motion and load.
struct LipContact {
    bool touches = false;  ///< on the wall, mouth first
    double gap_m = 0.0;
    double tilt_rad = 0.0;
    /// Neither slides nor rocks, nor is the wall too round: a seal needs the whole lip on the wall.
    bool lies_still = true;
    LetGo let_go = LetGo::no;
    double press_N = 0.0;  ///< as CupInput::press_N
    double pull_N = 0.0;
    double peel_N_m = 0.0;
    double pull_margin_N = 0.0;
    double shear_margin_N = 0.0;
    double peel_margin_N = 0.0;
};

/// The lip at one instant.
struct LipNow {
    LipMotion motion;
    LipLoad load;
    LipContact contact;  ///< the same in a few words
};

/// The first half at the wall: motion and load in the phase that the cup is in. A free lip that
/// meets the wall is loaded as one that touches; its springs begin here.
[[nodiscard]] LipNow feel_lip(const CupModel& model, CupState& state, const Surface& surface,
                              const Kinematics& cup, const CupInput& input);

/// The second half at the wall, once the contact has changed the phase: what the status says of the
/// load; a lip that has let go is loaded anew.
/// @return on the cup about the lip's centre, in W
[[nodiscard]] Wrench load_cup(const CupModel& model, CupState& state, const Surface& surface,
                              const CupInput& input, LipNow& lip);

/// The pump is switched on, or was not long enough ago.
[[nodiscard]] bool pump_turns(const CupParameters& parameters, const CupState& state,
                              const CupInput& input);

/// Whether the vacuum acts between lip and wall.
[[nodiscard]] bool is_sealed(CupPhase phase);

/// From free to touching; what the seal requires is not drawn.
void begin_touch(CupState& state);

/// The rows of the table that open the seal or end the contact.
/// @param contact  why, in let_go
/// @return contact_lost or detached, once a touch
[[nodiscard]] std::optional<Event> let_go(CupState& state, const LipContact& contact,
                                          double time_s);

/// Seal and pressure: phase by the contact, then pressure over `dt_s`.
[[nodiscard]] std::optional<Event> step(const CupParameters& parameters, CupState& state,
                                        const Surface& surface, const LipContact& contact,
                                        const CupInput& input, double dt_s);

}  // namespace limpet::suction
