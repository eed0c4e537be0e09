// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/payload.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "limpet/core/within_step.hpp"

namespace limpet::vehicle {
namespace {

/// The cable as it stands: from the payload to the hook.
struct Cable {
    Vector3 arm_W_m;   ///< of the hook, from the base's origin
    Vector3 up_W;      ///< unit vector to the hook
    double stretch_m;  ///< <= 0: slack
    double rate_m_s;   ///< > 0: grows longer
};

Cable cable_of(const PayloadModel& model, const PayloadStatus& payload, const Kinematics& base) {
    const Vector3 arm_W_m = base.q_WF * model.hook_B_m;
    const Vector3 hook_v_W_m_s = base.v_WF_W_m_s + (base.q_WF * base.w_WF_F_rad_s).cross(arm_W_m);
    const Vector3 to_hook_W_m = base.p_WF_m + arm_W_m - payload.p_W_m;
    const double length_m = to_hook_W_m.norm();
    if (payload.parted || length_m <= model.rest_length_m) {
        return {arm_W_m, -Vector3::UnitZ(), 0.0, 0.0};
    }
    const Vector3 up_W = to_hook_W_m / length_m;
    return {arm_W_m, up_W, length_m - model.rest_length_m,
            up_W.dot(hook_v_W_m_s - payload.v_W_m_s)};
}

/// Change of the hook's speed along the cable by a unit of pull, over a second.
double give_1_kg(const PayloadModel& model, const Kinematics& base, const Vector3& up_W) {
    const Vector3 up_B = base.q_WF.conjugate() * up_W;
    const Vector3 turn_B = (model.hook_B_m - model.base_centre_B_m).cross(up_B);
    return model.base_1_kg + turn_B.dot(model.base_inertia_1_kg_m2 * turn_B);
}

/// Drag within the step: the payload's change of velocity in it is give * impulse / mass, and
/// without a cable `free`. The slope of the square of a speed is twice as steep along it.
struct Resisted {
    Matrix3 give;
    Vector3 free_m_s;
};

Resisted resisted(const PayloadModel& model, const PayloadStatus& payload, const PayloadPull& pull,
                  double step_s) {
    const Vector3 through_W_m_s = payload.v_W_m_s - pull.wind_W_m_s;
    const double speed_m_s = through_W_m_s.norm();
    if (model.drag_kg_m == 0.0 || speed_m_s == 0.0) {
        return {Matrix3::Identity(), step_s * pull.field_W_m_s2};
    }
    const double mobility_1_kg_s = step_s / model.mass_kg;
    const double c_N_s_m = model.drag_kg_m * speed_m_s;
    const auto across = within_step(0.0, 0.0, c_N_s_m, speed_m_s, mobility_1_kg_s, step_s);
    const auto along = within_step(0.0, 0.0, 2.0 * c_N_s_m, speed_m_s, mobility_1_kg_s, step_s);
    const Vector3 way = through_W_m_s / speed_m_s;
    const double give_across = 1.0 / (1.0 + mobility_1_kg_s * across.gain);
    const double give_along = 1.0 / (1.0 + mobility_1_kg_s * along.gain);
    const Matrix3 give =
        give_across * Matrix3::Identity() + (give_along - give_across) * (way * way.transpose());
    return {give, give * (step_s * pull.field_W_m_s2 + mobility_1_kg_s * across.now * way)};
}

/// A surface before the payload.
struct Stop {
    Vector3 out_W;
    double gap_m;
};

/// Velocity at the end of the step with which the payload does not go into it.
void stop_at(const Stop& stop, double friction, double step_s, Vector3& v_W_m_s) {
    constexpr double kOut_m_s = 0.5;  // what is inside comes out, and is not shot out
    const double least_m_s = std::min(-stop.gap_m / step_s, kOut_m_s);
    const double push_m_s = least_m_s - v_W_m_s.dot(stop.out_W);
    if (push_m_s <= 0.0) {
        return;
    }
    v_W_m_s += push_m_s * stop.out_W;
    const Vector3 slides_m_s = v_W_m_s - v_W_m_s.dot(stop.out_W) * stop.out_W;
    const double slide_m_s = slides_m_s.norm();
    if (slide_m_s > 0.0) {
        v_W_m_s -= std::min(1.0, friction * push_m_s / slide_m_s) * slides_m_s;
    }
}

Vector3 stopped(const PayloadModel& model, const Vector3& p_W_m, double step_s, Vector3 v_W_m_s) {
    constexpr double kDeep_m = 0.02;  // further in it has come from the side or from behind
    if (model.wall) {
        const TangentFrame spot = tangent_frame(*model.wall, p_W_m);
        if (spot.on_wall && spot.gap_m > -kDeep_m) {
            stop_at({-spot.into_W(), spot.gap_m}, model.friction, step_s, v_W_m_s);
        }
    }
    stop_at({-Vector3::UnitZ(), model.ground_z_W_m - p_W_m.z()}, model.friction, step_s, v_W_m_s);
    return v_W_m_s;
}

}  // namespace

PayloadModel make_payload(const Airframe& airframe, double ground_z_W_m,
                          const std::optional<WallGeometry>& wall) {
    const PayloadParameters& payload = airframe.payload;
    PayloadModel model{.hangs = payload.mass_kg > 0.0, .mass_kg = payload.mass_kg};
    if (!model.hangs) {
        return model;
    }
    model.rest_length_m = payload.cable_length_m - payload.cable_stretch_m;
    model.stiffness_N_m = payload.mass_kg * kGravity_m_s2 / payload.cable_stretch_m;
    model.damping_N_s_m =
        2.0 * payload.cable_damping * std::sqrt(model.stiffness_N_m * payload.mass_kg);
    model.hook_B_m = {payload.hook_x_m, payload.hook_y_m, payload.hook_z_m};
    model.drag_kg_m = 0.5 * kAirDensity_kg_m3 * airframe.rotor.density_ratio * payload.drag_area_m2;
    model.friction = payload.friction;
    const BodyInertia base = base_inertia(airframe);
    model.base_1_kg = 1.0 / base.mass_kg;
    model.base_centre_B_m = base.centre_B_m;
    model.base_inertia_1_kg_m2 = base.inertia_kg_m2.inverse();
    model.ground_z_W_m = ground_z_W_m;
    model.wall = wall;
    return model;
}

Vector3 drag_W_N(const PayloadModel& model, const Vector3& wind_W_m_s) {
    return model.drag_kg_m * wind_W_m_s.norm() * wind_W_m_s;
}

PayloadStatus hang(const PayloadModel& model, const Kinematics& base, const PayloadPull& pull) {
    const Vector3 force_W_N = model.mass_kg * pull.field_W_m_s2 + drag_W_N(model, pull.wind_W_m_s);
    const double tension_N = force_W_N.norm();
    const double length_m = model.rest_length_m + tension_N / model.stiffness_N_m;
    return {.p_W_m = base.p_WF_m + base.q_WF * model.hook_B_m + length_m * force_W_N.normalized(),
            .v_W_m_s = base.v_WF_W_m_s,
            .tension_N = tension_N};
}

Wrench step(const PayloadModel& model, PayloadStatus& payload, const Kinematics& base,
            const PayloadPull& pull, double step_s) {
    const double mobility_1_kg_s = step_s / model.mass_kg;
    const Cable cable = cable_of(model, payload, base);
    const Resisted air = resisted(model, payload, pull, step_s);
    const Vector3 pulled = air.give * cable.up_W;  // its velocity's change by an impulse of m
    const double gives = mobility_1_kg_s * cable.up_W.dot(pulled);
    const double give = step_s * give_1_kg(model, base, cable.up_W) + gives;
    const auto spring = within_step(-model.stiffness_N_m * cable.stretch_m, model.stiffness_N_m,
                                    model.damping_N_s_m, cable.rate_m_s, give, step_s);
    Vector3 by_stops_m_s = Vector3::Zero();
    Vector3 v_W_m_s;
    // A stop changes what the cable bears, and the other way about.
    constexpr int kPasses = 4;
    for (int pass = 0; pass < kPasses; ++pass) {
        payload.tension_N = 0.0;
        if (cable.stretch_m > 0.0) {
            // Whatever else moves or holds the base is taken to bear what the payload leaves to the
            // cable, as in hover and at rest: there the tension is that, at any step.
            double drift_m_s = -cable.up_W.dot(air.free_m_s + by_stops_m_s);
            drift_m_s *= drift_m_s > 0.0 ? give / gives : 1.0;
            payload.tension_N =
                std::max(0.0, (spring.gain * drift_m_s - spring.now) / (1.0 + spring.gain * give));
        }
        const Vector3 unstopped_m_s =
            payload.v_W_m_s + air.free_m_s + mobility_1_kg_s * payload.tension_N * pulled;
        v_W_m_s = stopped(model, payload.p_W_m, step_s, unstopped_m_s);
        by_stops_m_s = v_W_m_s - unstopped_m_s;
        if (by_stops_m_s.isZero(0.0)) {
            break;
        }
    }
    payload.v_W_m_s = v_W_m_s;
    payload.p_W_m += step_s * v_W_m_s;
    const Vector3 force_W_N = -payload.tension_N * cable.up_W;
    return {.force_N = force_W_N, .moment_N_m = cable.arm_W_m.cross(force_W_N)};
}

}  // namespace limpet::vehicle
