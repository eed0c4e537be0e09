// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/collision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpet::simulation {

bool legs_can_touch(const FlightModel& model, const Kinematics& base) {
    const vehicle::AirframeNumbers& airframe = model.airframe;
    if (!airframe.has_cup) {
        return false;
    }
    const Vector3 tips_B_m(airframe.legs.tip_x_m, 0.0, airframe.legs.tip_z_m);
    const Vector3 tips_W_m = base.p_WF_m + base.q_WF * tips_B_m;
    const double range_m = model.simulation.contact_range_m;
    return tips_W_m.z() > model.simulation.start_height_m - range_m ||
           (model.has_wall && before_wall_m(model.cup.wall, tips_W_m) < range_m);
}

double closest_hub_m(const FlightModel& model, const Kinematics& base) {
    double closest_m = std::numeric_limits<double>::infinity();
    for (const vehicle::Rotor& rotor : model.airframe.rotors) {
        const Vector3 p_WR_m = base.p_WF_m + base.q_WF * rotor.p_B_m;
        const double before_m = before_wall_m(model.cup.wall, p_WR_m);
        if (before_m < closest_m && tangent_frame(model.cup.wall, p_WR_m).on_wall) {
            closest_m = before_m;
        }
    }
    return closest_m;
}

std::optional<guidance::Ending> collision(const FlightModel& model, const Truth& truth) {
    const vehicle::AirframeNumbers& airframe = model.airframe;
    const Vector3& p_WB_m = truth.base.p_WF_m;
    const double ground_m = model.simulation.start_height_m;
    const double to_ground_m = ground_m - p_WB_m.z();
    bool on_ground = to_ground_m < 0.0;
    if (to_ground_m < model.hubs_reach_m) {
        for (const vehicle::Rotor& rotor : airframe.rotors) {
            on_ground = on_ground || (p_WB_m + truth.base.q_WF * rotor.p_B_m).z() > ground_m;
        }
    }
    if (on_ground) {
        return guidance::Ending{.outcome = Outcome::crashed, .reason = "hit the ground"};
    }
    if (model.nearness.has_ceiling()) {
        for (const vehicle::Rotor& rotor : airframe.rotors) {
            if ((p_WB_m + truth.base.q_WF * rotor.p_B_m).z() < model.nearness.ceiling_z_W_m) {
                return guidance::Ending{.outcome = Outcome::crashed, .reason = "hit the ceiling"};
            }
        }
    }
    if (!model.has_wall) {
        return std::nullopt;
    }
    const double reaches_m = model.hubs_reach_m + airframe.rotor.radius_m;
    if (std::abs(before_wall_m(model.cup.wall, p_WB_m)) > reaches_m) {
        return std::nullopt;
    }
    const TangentFrame spot = tangent_frame(model.cup.wall, p_WB_m);
    const Vector3 n_B = truth.base.q_WF.conjugate() * spot.into_W();
    // A disc reaches its radius times the sine of the angle between its axis and the direction.
    const double reach_m =
        airframe.rotor.radius_m * std::sqrt(std::max(0.0, 1.0 - n_B.z() * n_B.z()));
    const bool hollow = spot.curvature_y_1_m < 0.0 || spot.curvature_z_1_m < 0.0;
    for (const vehicle::Rotor& rotor : airframe.rotors) {
        if (!hollow && spot.gap_m - n_B.dot(rotor.p_B_m) >= reach_m) {
            continue;  // clear of the flat wall there, and this one bends away from it
        }
        const Vector3 p_WR_m = p_WB_m + truth.base.q_WF * rotor.p_B_m;
        if (before_wall_m(model.cup.wall, p_WR_m) < reach_m &&
            tangent_frame(model.cup.wall, p_WR_m).on_wall) {
            return guidance::Ending{.outcome = Outcome::crashed,
                                    .reason = "a propeller hit the wall"};
        }
    }
    return std::nullopt;
}

const suction::Surface& surface_under_cup(const FlightModel& model, const suction::CupState& cup) {
    // The touch that is going on has been counted; a free cup looks at the spot that comes next.
    const int touch = cup.touches - (cup.status.phase == CupPhase::free ? 0 : 1);
    const auto last = static_cast<int>(model.surfaces.size()) - 1;
    return model.surfaces[static_cast<std::size_t>(std::min(touch, last))];
}

}  // namespace limpet::simulation
