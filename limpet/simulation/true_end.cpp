// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/true_end.hpp"

#include <cmath>

#include "limpet/simulation/collision.hpp"
#include "limpet/suction/cup.hpp"

namespace limpet::simulation {
namespace {

constexpr double kSlow_m_s = 0.5;     ///< what guidance waits for is slower: pre_speed_m_s
constexpr double kPlace_m = 0.5;      ///< and nearer: pre_tolerance_m
constexpr double kKeeps_m = 0.25;     ///< of a vehicle that is adrift
constexpr double kKeeps_s = 2.0;      ///< so it drifts at less than 0.13 m/s
constexpr double kBorne_share = 0.5;  ///< of the weight, on the legs
constexpr double kFirst_s = 0.005;    ///< nothing is seen before the first step has been made

void since(double& since_s, bool holds, double time_s) {
    since_s = !holds ? -1.0 : since_s < 0.0 ? time_s : since_s;
}

}  // namespace

void watch_end(EndWatch& watch, const FlightModel& model, const FlightState& state) {
    const Truth& truth = state.truth;
    const double time_s = seconds(state.tick);
    const CupPhase phase = state.cup.status.phase;
    const double weight_N = model.airframe.mass_kg * kGravity_m_s2;
    since(watch.slow_since_s, truth.base.v_WF_W_m_s.squaredNorm() < kSlow_m_s * kSlow_m_s, time_s);
    since(watch.sealed_since_s, suction::is_sealed(phase), time_s);
    since(watch.clear_since_s, phase == CupPhase::free && truth.legs_force_W_N.isZero(0.0), time_s);
    since(watch.borne_since_s, -truth.legs_force_W_N.z() > kBorne_share * weight_N, time_s);
    if (watch.anchored_since_s < 0.0 ||
        (truth.base.p_WF_m - watch.anchor_W_m).squaredNorm() > kKeeps_m * kKeeps_m) {
        watch.anchor_W_m = truth.base.p_WF_m;
        watch.anchored_since_s = time_s;
    }
    since(watch.guidance_ended_s, state.guidance.ending.has_value(), time_s);
}

Vector3 place_W_m(const FlightModel& model) {
    const Vector3& start_W_m = model.start.p_WB_m;
    if (!model.task.perch || !model.has_wall) {
        return start_W_m;
    }
    constexpr double kSteepest = 0.1;  // guidance goes level, as the LiDARs look
    const TangentFrame wall = tangent_frame(model.cup.wall, start_W_m);
    const Vector3 into_W = wall.into_W();
    const double level = std::hypot(into_W.x(), into_W.y());
    if (level < kSteepest) {
        return start_W_m;
    }
    const Vector3 ahead_W(into_W.x() / level, into_W.y() / level, 0.0);
    return start_W_m +
           (wall.gap_m / level - model.guidance.pre_distance_m - model.guidance.lidar_x_m) *
               ahead_W;
}

double off_place_m(const FlightModel& model, const FlightState& state) {
    return (state.truth.base.p_WF_m - place_W_m(model)).norm();
}

double place_tolerance_m(const FlightModel& model) {
    const auto& sensors = model.sensors.parameters;
    return model.scenario->autopilot.EKF2_GPS_CTRL > 0
               ? kPlace_m +
                     2.0 * std::hypot(sensors.gps_drift_horizontal_m, sensors.gps_drift_vertical_m)
               : kPlace_m;
}

TrueEnd true_end(const EndWatch& watch, const FlightModel& model, const FlightState& state) {
    if (model.mount != vehicle::Mount::free) {
        return TrueEnd::mounted;
    }
    if (collision(model, state.truth)) {
        return TrueEnd::fallen;
    }
    const double time_s = seconds(state.tick);
    const auto for_as_long = [time_s](double since_s, double wanted_s) {
        return since_s >= 0.0 && time_s - since_s >= wanted_s - kFirst_s;
    };
    if (for_as_long(watch.slow_since_s, kStill_s)) {
        if (for_as_long(watch.sealed_since_s, kStill_s)) {
            return TrueEnd::on_wall;
        }
        if (for_as_long(watch.borne_since_s, kStill_s)) {
            return TrueEnd::standing;
        }
        if (for_as_long(watch.clear_since_s, kStill_s) &&
            off_place_m(model, state) <= place_tolerance_m(model)) {
            return TrueEnd::hovering;
        }
    }
    return for_as_long(watch.anchored_since_s, kKeeps_s) &&
                   for_as_long(watch.clear_since_s, kKeeps_s)
               ? TrueEnd::adrift
               : TrueEnd::moving;
}

}  // namespace limpet::simulation
