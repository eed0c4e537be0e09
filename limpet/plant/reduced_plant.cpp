// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/reduced_plant.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/visit.hpp"
#include "limpet/plant/engines.hpp"

namespace limpet::plant {
namespace {

using vehicle::kTipDamping_N_s_m;
using vehicle::kTipStiffness_N_m;

/// How well a sliding tip's friction agrees with its press.
constexpr double kSettled = 1e-4;

/// The floor as a face that looks up.
WallGeometry ground(double z_W_m) {
    constexpr double kEndless_m = 1e6;
    WallGeometry floor{
        .p_WT_m = {0.0, 0.0, z_W_m}, .half_width_m = kEndless_m, .half_height_m = kEndless_m};
    floor.R_WT.col(0) = Vector3::UnitZ();
    floor.R_WT.col(1) = Vector3::UnitY();
    floor.R_WT.col(2) = -Vector3::UnitX();
    return floor;
}

std::shared_ptr<const ReducedModel> own_reduced(const std::shared_ptr<const PlantModel>& model) {
    auto own = std::dynamic_pointer_cast<const ReducedModel>(model);
    require(own != nullptr, "a model of the reduced engine's");
    return own;
}

}  // namespace

ReducedModel::ReducedModel(const vehicle::Airframe& airframe, const models::Scene& scene)
    : mechanism_(make_mechanism(airframe)),
      tip_B_m_{Vector3{airframe.legs.tip_x_m, -airframe.legs.tip_y_m, airframe.legs.tip_z_m},
               Vector3{airframe.legs.tip_x_m, airframe.legs.tip_y_m, airframe.legs.tip_z_m}},
      tip_radius_m_(airframe.legs.tip_radius_m),
      friction_(airframe.legs.friction),
      faces_{Face{.there = scene.wall.present, .geometry = scene.wall},
             Face{.there = true, .geometry = ground(scene.ground_z_W_m)}} {}

std::unique_ptr<Plant> ReducedModel::make() const {
    return std::make_unique<ReducedPlant>(shared_from_this());
}

ReducedPlant::ReducedPlant(std::shared_ptr<const ReducedModel> model)
    : MechanismBearer(step_), model_(std::move(model)) {
    refresh();
}

ReducedPlant::ReducedPlant(const std::shared_ptr<const PlantModel>& model)
    : ReducedPlant(own_reduced(model)) {}

void ReducedPlant::refresh() {
    step_.start(model_->mechanism_, state_.bodies);
}

void ReducedPlant::apply(Body body, const Wrench& wrench_W, const Vector3& p_W_m) {
    require(body == Body::base || model_->mechanism_.has_cup,
            "this vehicle has a slider and a cup");
    push(step_, body, wrench_W, p_W_m);
}

void ReducedPlant::prepare(const StepMode& mode) {
    if (step_.ready_s() == mode.step_s) {
        return;
    }
    touching_ = 0;
    if (mode.contacts && model_->mechanism_.has_cup) {
        find_touches(mode.step_s);
    } else {
        state_.tips = {};
    }
    close(mode.step_s);
}

void ReducedPlant::close(double step_s) {
    step_.begin(step_s);
    for (std::size_t i = 0; i < touching_; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            step_.add_spring(touches_[i].direction[axis], touches_[i].spring[axis]);
        }
    }
    step_.close();
}

void ReducedPlant::find_touches(double step_s) {
    const Mechanism<double>& at = step_.at();
    const MechanismState<double>& bodies = state_.bodies;
    for (std::size_t tip = 0; tip < kTips; ++tip) {
        const Vector3& tip_B_m = model_->tip_B_m_[tip];
        const Vector3 tip_W_m = bodies.p_WB_m + at.R_WB * tip_B_m;
        for (std::size_t face = 0; face < kFaces; ++face) {
            TipContact& contact = state_.tips[tip][face];
            const ReducedModel::Face& by = model_->faces_[face];
            const bool near =
                by.there && before_wall_m(by.geometry, tip_W_m) < model_->tip_radius_m_;
            if (!near) {
                contact = {};
                continue;
            }
            const TangentFrame spot = tangent_frame(by.geometry, tip_W_m);
            if (!spot.on_wall) {
                contact = {};
                continue;
            }
            Touch& touch = touches_[touching_++];
            touch.contact = &contact;
            touch.spot = spot;
            touch.slides = false;
            const Matrix3 R_BT = at.R_WB.transpose() * spot.R_WT;
            const Vector3 meets_B_m = tip_B_m + model_->tip_radius_m_ * R_BT.col(0);
            touch.rate_m_s = spot.R_WT.transpose() * bodies.v_WB_W_m_s +
                             R_BT.transpose() * bodies.w_WB_B_rad_s.cross(meets_B_m);
            const double stretch_m[] = {model_->tip_radius_m_ - spot.gap_m, contact.stretch_y_m,
                                        contact.stretch_z_m};
            const double mobility = kTips * step_s / model_->mechanism_.mass_kg;
            for (int axis = 0; axis < 3; ++axis) {
                const auto k = static_cast<std::size_t>(axis);
                touch.direction[k] =
                    Spatial<double>::wrench(meets_B_m, R_BT.col(axis), Vector3::Zero());
                touch.spring[k] =
                    within_step<double>(-kTipStiffness_N_m * stretch_m[k], kTipStiffness_N_m,
                                        kTipDamping_N_s_m, touch.rate_m_s[axis], mobility, step_s);
            }
            if (touch.spring[0].now > 0.0) {
                touch.spring = {};  // leaves faster than its rubber follows
            }
        }
    }
}

/// @return whether the tip's springs had to change: it lifts, or slides
bool ReducedPlant::let_slide(Touch& touch, const MechanismChange<double>& change) const {
    const auto force_N = [&](std::size_t axis) {
        const StepForce<double>& spring = touch.spring[axis];
        return spring.now - spring.gain * touch.direction[axis].dot(change.base);
    };
    const double push_N = -force_N(0);
    if (push_N < 0.0) {
        touch.spring = {};
        return true;
    }
    const double y_N = force_N(1);
    const double z_N = force_N(2);
    const double asked_N = std::sqrt(y_N * y_N + z_N * z_N);
    const double limit_N = model_->friction_ * push_N;
    // One that slides presses as it slides, not as it did while it was taken to stick.
    const bool settled =
        touch.slides ? std::abs(asked_N - limit_N) <= kSettled * limit_N : asked_N <= limit_N;
    if (settled || asked_N == 0.0) {
        return false;
    }
    touch.slides = true;
    touch.spring[1] = {.now = y_N * limit_N / asked_N, .gain = 0.0};
    touch.spring[2] = {.now = z_N * limit_N / asked_N, .gain = 0.0};
    return true;
}

/// The change of the speeds with all tips either sticking within their limits or sliding.
MechanismChange<double> ReducedPlant::settle(double step_s) {
    constexpr int kPasses = 12;  // a tip lifts, another takes over and slides, harder or less
    for (int pass = 0; touching_ > 0 && pass < kPasses; ++pass) {
        const MechanismChange<double> change = step_.change();
        bool changed = false;
        for (std::size_t i = 0; i < touching_; ++i) {
            changed = let_slide(touches_[i], change) || changed;
        }
        if (!changed) {
            return change;
        }
        close(step_s);
    }
    return step_.change();
}

void ReducedPlant::take_contacts(const MechanismChange<double>& change, double step_s) {
    state_.contact_force_W_N.setZero();
    for (std::size_t i = 0; i < touching_; ++i) {
        const Touch& touch = touches_[i];
        Vector3 force_T_N;
        Vector3 next_m_s;
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            const double more_m_s = touch.direction[k].dot(change.base);
            force_T_N[axis] = touch.spring[k].now - touch.spring[k].gain * more_m_s;
            next_m_s[axis] = touch.rate_m_s[axis] + more_m_s;
        }
        state_.contact_force_W_N += touch.spot.R_WT * force_T_N;
        TipContact& contact = *touch.contact;
        const bool lifted = touch.spring[0].gain == 0.0;
        if (lifted) {
            contact = {};
        } else if (touch.slides) {
            contact.stretch_y_m = -force_T_N.y() / kTipStiffness_N_m;
            contact.stretch_z_m = -force_T_N.z() / kTipStiffness_N_m;
        } else {
            contact.stretch_y_m += step_s * next_m_s.y();
            contact.stretch_z_m += step_s * next_m_s.z();
        }
    }
}

void ReducedPlant::integrate(const MechanismChange<double>& change, double step_s) {
    MechanismState<double>& bodies = state_.bodies;
    bodies.v_WB_W_m_s += step_.at().R_WB * change.base.moving();
    bodies.w_WB_B_rad_s += change.base.turning();
    bodies.p_WB_m += step_s * bodies.v_WB_W_m_s;
    bodies.q_WB =
        (bodies.q_WB * quaternion_from_rotation_vector(step_s * bodies.w_WB_B_rad_s)).normalized();
    for (std::size_t k = 0; k < kJoints; ++k) {
        bodies.joint_rate[k] += change.joint[k];
        bodies.joint[k] += step_s * bodies.joint_rate[k];
    }
}

CupBearer* ReducedPlant::bear_cup(const StepMode& mode) {
    require(model_->mechanism_.has_cup, "this vehicle has a slider and a cup");
    return ask(model_->mechanism_, mode);
}

void ReducedPlant::step(const StepMode& mode) {
    prepare(mode);
    const MechanismChange<double> change = settle(mode.step_s);
    state_.slider_N = model_->mechanism_.has_cup ? step_.joint_force(0, change) : 0.0;
    take_contacts(change, mode.step_s);
    integrate(change, mode.step_s);
    if (!std::isfinite(state_.bodies.p_WB_m.sum() + state_.bodies.w_WB_B_rad_s.sum()))
        [[unlikely]] {
        throw InternalError("the reduced engine diverged");
    }
    refresh();
}

Kinematics ReducedPlant::kinematics(Body body) const {
    const MechanismState<double>& bodies = state_.bodies;
    const Mechanism<double>& at = step_.at();
    Kinematics seen{.p_WF_m = bodies.p_WB_m,
                    .q_WF = bodies.q_WB,
                    .v_WF_W_m_s = bodies.v_WB_W_m_s,
                    .w_WF_F_rad_s = bodies.w_WB_B_rad_s};
    if (body == Body::base) {
        return seen;
    }
    require(model_->mechanism_.has_cup, "this vehicle has a slider and a cup");
    const bool cup = body == Body::cup;
    Vector3 v_B_m_s = bodies.w_WB_B_rad_s.cross(at.joint_B_m);
    v_B_m_s.x() += bodies.joint_rate[0];
    if (cup) {
        v_B_m_s += at.cup_w_B_rad_s.cross(at.lip_arm_B_m);
        seen.q_WF = bodies.q_WB * at.q_BC;
        seen.w_WF_F_rad_s = at.R_BC.transpose() * at.cup_w_B_rad_s;
    }
    seen.p_WF_m += at.R_WB * (cup ? at.lip_B_m : at.joint_B_m);
    seen.v_WF_W_m_s += at.R_WB * v_B_m_s;
    return seen;
}

SliderMotion ReducedPlant::slider() const {
    return {.position_m = state_.bodies.joint[0],
            .velocity_m_s = state_.bodies.joint_rate[0],
            .force_N = state_.slider_N};
}

std::optional<double> ReducedPlant::ray(const Vector3& origin_W_m, const Vector3& dir_W) const {
    const auto& [wall, floor] = model_->faces_;
    std::optional<double> way_m;
    if (wall.there) {
        way_m = ray_to_wall_m(wall.geometry, origin_W_m, dir_W);
    }
    const double above_m = floor.geometry.p_WT_m.z() - origin_W_m.z();
    if (above_m > 0.0 && dir_W.z() > 0.0 && (!way_m || above_m < *way_m * dir_W.z())) {
        way_m = above_m / dir_W.z();
    }
    return way_m;
}

PlantState ReducedPlant::save() const {
    State state = state_;
    state.pushed = step_.pushed();
    PlantState saved;
    saved.values.reserve(sizeof state / sizeof(double));
    visit_leaves(state,
                 [&saved](auto value) { saved.values.push_back(static_cast<double>(value)); });
    return saved;
}

ReducedPlant::State ReducedPlant::read(const PlantState& saved) {
    State state;
    std::size_t at = 0;
    visit_leaves(state, [&](auto& value) {
        require(at < saved.values.size(), "a state of this model");
        value = static_cast<std::remove_reference_t<decltype(value)>>(saved.values[at++]);
    });
    require(at == saved.values.size(), "a state of this model");
    return state;
}

void ReducedPlant::restore(const PlantState& saved) {
    state_ = read(saved);
    refresh();
    step_.pushed() = state_.pushed;
}

void ReducedPlant::set_pose(const Vector3& p_WB_m, const Quaternion& q_WB,
                            const Vector3& v_WB_W_m_s, const Vector3& w_WB_B_rad_s) {
    state_.bodies.p_WB_m = p_WB_m;
    state_.bodies.q_WB = q_WB.normalized();
    state_.bodies.v_WB_W_m_s = v_WB_W_m_s;
    state_.bodies.w_WB_B_rad_s = w_WB_B_rad_s;
    state_.tips = {};
    refresh();
}

void ReducedPlant::displace(std::span<const double> step) {
    require(step.size() == 2 * kFreedoms, "a step for each degree of freedom and each speed");
    MechanismState<double>& bodies = state_.bodies;
    const auto three = [&step](std::size_t at) {
        return Vector3(step[at], step[at + 1], step[at + 2]);
    };
    bodies.p_WB_m += three(0);
    bodies.q_WB = (bodies.q_WB * quaternion_from_rotation_vector(three(3))).normalized();
    bodies.v_WB_W_m_s += three(kFreedoms);
    bodies.w_WB_B_rad_s += three(kFreedoms + 3);
    for (std::size_t k = 0; k < kJoints; ++k) {
        bodies.joint[k] += step[6 + k];
        bodies.joint_rate[k] += step[kFreedoms + 6 + k];
    }
    refresh();
}

void ReducedPlant::displacement_from(const PlantState& origin, std::span<double> step) const {
    require(step.size() == 2 * kFreedoms, "room for each degree of freedom and each speed");
    const MechanismState<double> from = read(origin).bodies;
    const MechanismState<double>& bodies = state_.bodies;
    const auto put = [&step](std::size_t at, const Vector3& three) {
        std::copy_n(three.data(), 3, step.data() + at);
    };
    put(0, bodies.p_WB_m - from.p_WB_m);
    put(3, rotation_vector_from_quaternion(from.q_WB.conjugate() * bodies.q_WB));
    put(kFreedoms, bodies.v_WB_W_m_s - from.v_WB_W_m_s);
    put(kFreedoms + 3, bodies.w_WB_B_rad_s - from.w_WB_B_rad_s);
    for (std::size_t k = 0; k < kJoints; ++k) {
        step[6 + k] = bodies.joint[k] - from.joint[k];
        step[kFreedoms + 6 + k] = bodies.joint_rate[k] - from.joint_rate[k];
    }
}

const Engine kReducedEngine = {
    "reduced", "this vehicle alone, in closed form: nine coordinates, own contacts, the fastest",
    [](const vehicle::Airframe& airframe,
       const models::Scene& scene) -> std::shared_ptr<const PlantModel> {
        return std::make_shared<const ReducedModel>(airframe, scene);
    }};

}  // namespace limpet::plant
