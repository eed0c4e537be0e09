// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/standing.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::vehicle {

double tipping_turn_rad(const Airframe& airframe) {
    const double pitch_rad = pitch_on_legs_rad(airframe);
    const auto out_m = [pitch_rad](double x_m, double z_m) {
        return -std::cos(pitch_rad) * x_m - std::sin(pitch_rad) * z_m;
    };
    const auto down_m = [pitch_rad](double x_m, double z_m) {
        return std::cos(pitch_rad) * z_m - std::sin(pitch_rad) * x_m;
    };
    const CupMountParameters& cup = airframe.cup;
    // From the joint to the contact: out of the wall, aside, down; and to the centre of mass.
    const double tip_x_m = airframe.legs.tip_x_m - cup.joint_x_m;
    const double tip_z_m = airframe.legs.tip_z_m - cup.joint_z_m;
    const double contact_out_m = out_m(tip_x_m, tip_z_m) - airframe.legs.tip_radius_m;
    const double contact_down_m = down_m(tip_x_m, tip_z_m);
    const double mass_out_m = out_m(-cup.joint_x_m, -cup.joint_z_m);
    const double mass_down_m = down_m(-cup.joint_x_m, -cup.joint_z_m);
    // The weight's moment about that line is none: tan(turn) of a weight (0, sin, cos).
    return std::clamp(std::atan2(airframe.legs.tip_y_m * mass_out_m,
                                 contact_down_m * mass_out_m - contact_out_m * mass_down_m),
                      0.0, 0.5 * kPi);
}

}  // namespace limpet::vehicle
