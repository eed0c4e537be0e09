// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "limpet/core/frames.hpp"
#include "limpet/core/rotor_list.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/faults/fault.hpp"

namespace limpet::faults {

/// A flight's faults. Most flights have none, and then nothing here is called.
struct FaultsModel {
    std::vector<Fault> faults;           ///< at most kMostFaults
    Vector3 ahead_W = Vector3::UnitX();  ///< level, into the wall
    [[nodiscard]] bool any() const { return !faults.empty(); }
};

/// What acts in this tick, beyond readings and estimate.
struct Acting {
    bool guidance_stalls = false;
    bool link_lost = false;
    bool rotors_hit = false;
    RotorList<double> speed_share;  ///< of what a rotor would turn; when rotors_hit
    double charge_at_most = 1.0;    ///< share of the battery's
    bool pump_draws = true;
    bool valve_stuck_open = false;
    bool valve_stuck_shut = false;
    double hole_mm2 = 0.0;                 ///< to the atmosphere, in hose or lip
    Vector3 gust_W_m_s = Vector3::Zero();  ///< on top of the wind
    double payload_to_right_kg_m = 0.0;    ///< along y of B
    double payload_ahead_kg_m = 0.0;       ///< along x of B
    bool cable_breaks = false;             ///< the payload's
    std::array<bool, 2> legs_lost{};       ///< left, right
    double clock_ahead_s = 0.0;            ///< guidance's
};

/// How far a fault has come.
struct FaultProgress {
    double due_s = -1.0;    ///< < 0: its phase has not been yet
    double began_s = -1.0;  ///< < 0: not yet
    bool over = false;
};

struct FaultsState {
    std::array<FaultProgress, kMostFaults> progress;
    Acting now;
    Readings sensed;            ///< what the sensors sent; those who read it use hear()
    Setpoint through;           ///< the last set-point that came to the autopilot
    double estimated_s = -1.0;  ///< stamp of the last estimate that was changed
};

/// Begins and ends those that are due; what they do from then on is in state.now. Once a tick.
/// @param rotors  how many the vehicle has
/// @param events  gets fault_began and fault_ended, the kind as the reason
void step(const FaultsModel& model, FaultsState& state, guidance::PerchingState phase,
          std::size_t rotors, double time_s, guidance::EventList& events);

/// What the vehicle receives of state.sensed.
/// @param received  what it received last; newer samples replace it
void hear(const FaultsModel& model, const FaultsState& state, double time_s, Readings& received);

/// What drifts in an estimate; once for each.
void mislead(const FaultsModel& model, FaultsState& state, double time_s, Estimate& estimate);

/// What was received after guidance's clock has jumped is stamped by the clock that jumped.
void stamp_anew(const FaultsModel& model, const FaultsState& state, Readings& readings,
                Estimate& estimate);

}  // namespace limpet::faults
