// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "limpet/simulation/flight.hpp"

/// Why a flight fails: what its cup bore until it let go, and which numbers would change that.
namespace limpet::why {

/// Loads on the lip and the most that it bears at that moment, by what the vacuum presses.
struct LipLoads {
    double pull_N = 0.0, pull_most_N = 0.0;
    double shear_N = 0.0, shear_most_N = 0.0;
    double peel_N_m = 0.0, peel_most_N_m = 0.0;
};

/// Where a peeling moment comes from: what the joint hands on to the cup, and the load at the joint
/// by its distance from the lip. Of each the size; they may act against each other.
struct PeelSources {
    double spring_N_m = 0.0;  ///< the joint's centring spring
    double damper_N_m = 0.0;  ///< its damper
    double lever_N_m = 0.0;   ///< shear at the lip times lip_offset_m
    double bent_deg = 0.0;    ///< the joint
};

/// From one seal to the time when the cup let go.
struct Hold {
    double sealed_s = 0.0;
    double attached_s = kNaN;   ///< NaN: the pressure never fell below the threshold
    double ended_s = kNaN;      ///< NaN: it holds to the flight's end
    std::string let_go;         ///< "peeled off"; empty while it holds
    bool on_purpose = false;    ///< pump off or valve open
    double pressure_Pa = kNaN;  ///< the lowest
    double pitch_deg = -90.0;   ///< the highest while sealed
    double margin_N = std::numeric_limits<double>::infinity();  ///< the least while attached
    std::string phase;                                          ///< of guidance when it let go
    LipLoads loads;  ///< when it let go; else the last tick's
    PeelSources peel;

    [[nodiscard]] double held_s(double end_s) const {
        return (ended_s < end_s ? ended_s : end_s) - sealed_s;
    }
};

/// The cup against time while it is sealed, 100 times a second, each tick around a touch, and as it
/// lets go; NaN between two holds.
struct HoldTrace {
    std::vector<double> time_s, pitch_deg, pressure_hPa;
    std::vector<double> pull_margin_N, shear_margin_N, peel_margin_N;
};

/// Watches a flight: FlightWatch::on_tick.
class HoldWatch {
public:
    explicit HoldWatch(bool traces = false) : traces_(traces) {}
    void tick(const simulation::Flight& flight, const guidance::EventList& events);
    [[nodiscard]] const std::vector<Hold>& holds() const { return holds_; }
    [[nodiscard]] const HoldTrace& trace() const { return trace_; }

private:
    void add_to_trace(const simulation::Flight& flight, bool sealed, const Event* lets_go);

    bool traces_;
    bool sealed_ = false;
    guidance::PerchingState state_ = {};
    std::vector<Hold> holds_;
    HoldTrace trace_;
};

}  // namespace limpet::why
