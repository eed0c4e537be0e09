// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpet/models/cad_model.hpp"

namespace limpet::models {

namespace {

Part box(std::string name, const Vector3& centre, const Vector3& size, Paint paint,
         double yaw_rad = 0.0) {
    return {.name = std::move(name),
            .shape = Shape::box,
            .p_F_m = centre,
            .q_F = quaternion_from_euler({.yaw_rad = yaw_rad}),
            .size_m = size,
            .paint = paint};
}

/// Turns z the shortest way to `along`, about -x where that is -z. Eigen's FromTwoVectors does the
/// same by a singular value decomposition that takes ten seconds to compile.
Quaternion turned_from_z(const Vector3& along) {
    const Vector3 to = along.normalized();
    const double cosine = to.z();
    if (cosine < -1.0 + 1e-12) {
        return {0.0, -1.0, 0.0, 0.0};
    }
    const double twice_w = std::sqrt((1.0 + cosine) * 2.0);
    Quaternion q;
    q.vec() = Vector3::UnitZ().cross(to) * (1.0 / twice_w);
    q.w() = 0.5 * twice_w;
    return q;
}

Part rod(std::string name, const Vector3& from, const Vector3& to, double radius_m, Paint paint) {
    const Vector3 along = to - from;
    return {.name = std::move(name),
            .shape = Shape::cylinder,
            .p_F_m = 0.5 * (from + to),
            .q_F = turned_from_z(along),
            .size_m = {radius_m, radius_m, along.norm()},
            .paint = paint};
}

Part ball(std::string name, const Vector3& centre, double radius_m, Paint paint) {
    return {.name = std::move(name),
            .shape = Shape::sphere,
            .p_F_m = centre,
            .size_m = Vector3::Constant(radius_m),
            .paint = paint};
}

void draw_body(std::vector<Part>& parts) {
    parts.push_back(box("plate_top", {0.0, 0.0, -0.014}, {0.20, 0.11, 0.003}, Paint::carbon));
    parts.push_back(box("plate_bottom", {0.0, 0.0, 0.014}, {0.20, 0.11, 0.003}, Paint::carbon));
    parts.push_back(box("battery", {-0.03, 0.0, 0.040}, {0.14, 0.048, 0.046}, Paint::battery));
    parts.push_back(box("computer", {0.02, 0.0, -0.032}, {0.095, 0.065, 0.026}, Paint::aluminium));
    parts.push_back(box("autopilot", {-0.06, 0.0, -0.024}, {0.045, 0.045, 0.016}, Paint::board));
}

void draw_rotor(std::vector<Part>& parts, const vehicle::Airframe& airframe, std::size_t i) {
    const std::string number = std::to_string(i);
    const vehicle::Rotor& rotor = airframe.rotors[i];
    const Vector3& hub = rotor.p_B_m;
    const double radius_m = airframe.rotor.radius_m;
    const Vector3 mount{hub.x(), hub.y(), 0.0};
    const bool shares_arm = std::any_of(airframe.rotors.begin(), airframe.rotors.begin() + i,
                                        [&hub](const vehicle::Rotor& other) {
                                            return (other.p_B_m - hub).head<2>().norm() < 0.01;
                                        });
    if (!shares_arm) {
        parts.push_back(rod("arm_" + number, 0.2 * mount, mount, 0.009, Paint::carbon));
    }
    const double up = hub.z() > 0.0 ? -1.0 : 1.0;  // which way the motor stands on its arm
    parts.push_back(rod("motor_" + number, mount + Vector3(0.0, 0.0, up * 0.008),
                        hub + Vector3(0.0, 0.0, up * 0.006), 0.021, Paint::aluminium));
    parts.push_back(rod("rotor_" + number, hub + Vector3(0.0, 0.0, 0.001),
                        hub - Vector3(0.0, 0.0, 0.001), radius_m, Paint::propeller));
    const double angle_rad = radians(35.0 + 50.0 * static_cast<double>(i));
    parts.push_back(
        box("blade_" + number, hub, {2.0 * radius_m, 0.024, 0.004}, Paint::blade, angle_rad));
}

/// Two carbon tubes carry the bushing in which the slider's rod runs.
void draw_perching_gear(std::vector<Part>& parts, const vehicle::Airframe& airframe) {
    const double z_m = airframe.cup.joint_z_m;
    const double front_m = airframe.cup.joint_x_m - airframe.slider.travel_m - 0.035;
    for (const double side : {-1.0, 1.0}) {
        const std::string suffix = side < 0.0 ? "_left" : "_right";
        parts.push_back(rod("tube" + suffix, {0.02, 0.026 * side, z_m},
                            {front_m, 0.026 * side, z_m}, 0.007, Paint::carbon));
        parts.push_back(
            rod("leg_rod" + suffix, {-0.01, 0.05 * side, 0.014},
                {airframe.legs.tip_x_m, airframe.legs.tip_y_m * side, airframe.legs.tip_z_m}, 0.006,
                Paint::carbon));
        parts.push_back(box("lidar" + suffix,
                            {airframe.lidar_x_m, 0.5 * airframe.lidar_separation_m * side,
                             airframe.lidar_z_m + 0.016},
                            {0.022, 0.035, 0.018}, Paint::board));
    }
    parts.push_back(
        box("bushing_front", {front_m, 0.0, z_m}, {0.03, 0.075, 0.03}, Paint::aluminium));
    const Vector3& pump = airframe.pump_B_m;
    parts.push_back(rod("pump", pump - Vector3(0.04, 0.0, 0.0), pump + Vector3(0.02, 0.0, 0.0),
                        0.020, Paint::pump));
    parts.push_back(
        box("pump_head", pump + Vector3(0.03, 0.0, 0.0), {0.025, 0.045, 0.04}, Paint::aluminium));
    parts.push_back(rod("hose", pump + Vector3(0.03, 0.034, 0.0), {front_m, 0.038, z_m + 0.012},
                        0.004, Paint::hose));
}

void draw_carriage(std::vector<Part>& parts, const vehicle::Airframe& airframe) {
    const auto add = [&parts](Part part) {
        part.body = "carriage";
        parts.push_back(std::move(part));
    };
    add(rod("slider_rod", {-2.0 * airframe.slider.travel_m, 0.0, 0.0}, Vector3::Zero(), 0.008,
            Paint::aluminium));
    add(ball("slider_yoke", Vector3::Zero(), 0.013, Paint::carbon));
}

/// A fitting, two bellows and the lip.
void draw_cup(std::vector<Part>& parts, const vehicle::Airframe& airframe) {
    const double length_m = airframe.cup.lip_offset_m;
    const double radius_m = airframe.cup.radius_m;
    const auto add = [&](const char* name, double from, double to, double width, Paint paint) {
        Part part = rod(name, {from * length_m, 0.0, 0.0}, {to * length_m, 0.0, 0.0},
                        width * radius_m, paint);
        part.body = "cup";
        parts.push_back(std::move(part));
    };
    add("cup_fitting", 0.0, 0.35, 0.32, Paint::aluminium);
    add("cup_neck", 0.30, 0.50, 0.55, Paint::rubber);
    add("cup_bellow", 0.50, 0.62, 0.80, Paint::rubber);
    add("cup_waist", 0.62, 0.78, 0.62, Paint::rubber);
    add("cup_lip", 0.78, 1.0, 1.0, Paint::rubber);
}

}  // namespace

std::span<const PaintLook> paint_looks() {
    static constexpr PaintLook looks[] = {
        {"carbon", {0.07, 0.07, 0.08, 1.0}, 0.5, 0.6},
        {"aluminium", {0.62, 0.64, 0.67, 1.0}, 0.8, 0.7},
        {"propeller", {0.25, 0.27, 0.30, 0.22}, 0.1, 0.1},
        {"blade", {0.12, 0.12, 0.13, 0.85}, 0.3, 0.4},
        {"rubber", {0.95, 0.42, 0.08, 1.0}, 0.2, 0.2},
        {"foot", {0.16, 0.16, 0.16, 1.0}, 0.1, 0.1},
        {"battery", {0.12, 0.22, 0.50, 1.0}, 0.3, 0.3},
        {"board", {0.10, 0.32, 0.20, 1.0}, 0.3, 0.3},
        {"pump", {0.78, 0.78, 0.75, 1.0}, 0.5, 0.5},
        {"hose", {0.30, 0.60, 0.90, 0.8}, 0.4, 0.4},
    };
    return looks;
}

const PaintLook& look(Paint paint) {
    return paint_looks()[static_cast<std::size_t>(paint)];
}

const std::array<double, 4>& colour(const Part& part) {
    return part.rgba ? *part.rgba : look(part.paint).rgba;
}

std::vector<Part> draw(const vehicle::Airframe& airframe) {
    if (const CadModel* cad = cad_of(airframe)) {
        return cad->parts;
    }
    std::vector<Part> parts;
    draw_body(parts);
    for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
        draw_rotor(parts, airframe, i);
    }
    if (airframe.has_cup) {
        draw_perching_gear(parts, airframe);
        draw_carriage(parts, airframe);
        draw_cup(parts, airframe);
    }
    return parts;
}

std::vector<Part> leg_tips(const vehicle::Airframe& airframe) {
    if (!airframe.has_cup) {
        return {};
    }
    const vehicle::LegParameters& legs = airframe.legs;
    return {ball("leg_left", {legs.tip_x_m, -legs.tip_y_m, legs.tip_z_m}, legs.tip_radius_m,
                 Paint::foot),
            ball("leg_right", {legs.tip_x_m, legs.tip_y_m, legs.tip_z_m}, legs.tip_radius_m,
                 Paint::foot)};
}

}  // namespace limpet::models
