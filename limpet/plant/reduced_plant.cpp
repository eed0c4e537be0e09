// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/reduced_plant.hpp"

#include <algorithm>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/machines.hpp"
#include "limpet/core/visit.hpp"
#include "limpet/plant/engines.hpp"
#include "limpet/plant/lane_group.hpp"

namespace limpet::plant {
namespace {

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

Face face(const WallGeometry& geometry, bool there) {
    const double share = share_of_spring(vehicle::kTipStiffness_N_m, geometry);
    return {.there = there,
            .geometry = geometry,
            .tip_stiffness_N_m = share * vehicle::kTipStiffness_N_m,
            .tip_damping_N_s_m = share * share * vehicle::kTipDamping_N_s_m};
}

std::shared_ptr<const ReducedModel> own_reduced(const std::shared_ptr<const PlantModel>& model) {
    auto own = std::dynamic_pointer_cast<const ReducedModel>(model);
    require(own != nullptr, "a model of the reduced engine's");
    return own;
}

using OneBody = ReducedBodies<Lanes<1>>;

LIMPET_FOR_MACHINES [[gnu::flatten]] void prepare_step(OneBody& bodies, const StepMode& mode) {
    bodies.prepare(mode.step_s, {mode.touches(0), mode.touches(1)});
    (void)bodies.step().change();  // who prepares needs it next
}
LIMPET_FOR_MACHINES [[gnu::flatten]] void take_step(OneBody& bodies, double step_s) {
    bodies.advance(step_s);
}

}  // namespace

void require_sound(bool finite) {
    if (!finite) [[unlikely]] {
        throw Diverged();
    }
}

ReducedModel::ReducedModel(const vehicle::Airframe& airframe, const models::Scene& scene)
    : mechanism_(make_mechanism(airframe)),
      numbers_{
          .mechanism = mechanism_.numbers,
          .tip_B_m = {Vector3{airframe.legs.tip_x_m, -airframe.legs.tip_y_m, airframe.legs.tip_z_m},
                      Vector3{airframe.legs.tip_x_m, airframe.legs.tip_y_m, airframe.legs.tip_z_m}},
          .tip_radius_m = airframe.legs.tip_radius_m,
          .friction = airframe.legs.friction},
      faces_{face(scene.wall, scene.wall.present), face(ground(scene.ground_z_W_m), true)} {}

std::unique_ptr<Plant> ReducedModel::make() const {
    if (auto lane = free_lane(shared_from_this())) {
        return lane;
    }
    return std::make_unique<ReducedPlant>(shared_from_this());
}

std::optional<double> ReducedModel::ray(const Vector3& origin_W_m, const Vector3& dir_W) const {
    const auto& [wall, floor] = faces_;
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

ReducedPlant::ReducedPlant(std::shared_ptr<const ReducedModel> model)
    : MechanismBearer(bodies_.step()), model_(std::move(model)) {
    put_lane(bodies_.numbers, 0, lane_of(model_->numbers(), 0));
    bodies_.faces[0] = &model_->faces();
    bodies_.refresh();
}

ReducedPlant::ReducedPlant(const std::shared_ptr<const PlantModel>& model)
    : ReducedPlant(own_reduced(model)) {}

void ReducedPlant::apply(Body body, const Wrench& wrench_W, const Vector3& p_W_m) {
    require(body == Body::base || model_->numbers().mechanism.has_cup,
            "this vehicle has a slider and a cup");
    if (body == Body::cup && bodies_.step().holds_lip()) {
        return;  // it is that of the springs
    }
    bodies_.apply(0, body, wrench_W, p_W_m);
}

void ReducedPlant::prepare(const StepMode& mode) {
    prepare_step(bodies_, mode);
}

CupBearer* ReducedPlant::bear_cup(const StepMode& mode) {
    require(model_->numbers().mechanism.has_cup, "this vehicle has a slider and a cup");
    return ask(model_->mechanism(), mode);
}

void ReducedPlant::step(const StepMode& mode) {
    prepare(mode);
    take_step(bodies_, mode.step_s);
    require_sound(is_finite(bodies_, 0));
}

Kinematics ReducedPlant::kinematics(Body body) const {
    require(body == Body::base || model_->numbers().mechanism.has_cup,
            "this vehicle has a slider and a cup");
    return bodies_.kinematics(0, body);
}

SliderMotion ReducedPlant::slider() const {
    return slider_of(bodies_, 0);
}

std::optional<double> ReducedPlant::ray(const Vector3& origin_W_m, const Vector3& dir_W) const {
    return model_->ray(origin_W_m, dir_W);
}

Vector3 ReducedPlant::contact_force_W() const {
    return in_lane(bodies_.state.contact_force_W_N, 0);
}

PlantState ReducedPlant::save() const {
    return {lane_of(bodies_.state, 0)};
}

void ReducedPlant::restore(const PlantState& saved) {
    put_lane(bodies_.state, 0, saved.values);
    bodies_.refresh();
}

MechanismState<double> ReducedPlant::mechanism() const {
    ReducedState<double> state;
    put_lane(state, 0, save().values);
    return state.bodies;
}

void ReducedPlant::set_pose(const Vector3& p_WB_m, const Quaternion& q_WB,
                            const Vector3& v_WB_W_m_s, const Vector3& w_WB_B_rad_s) {
    ReducedState<double> state;
    put_lane(state, 0, save().values);
    state.bodies.p_WB_m = p_WB_m;
    state.bodies.q_WB = q_WB.normalized();
    state.bodies.v_WB_W_m_s = v_WB_W_m_s;
    state.bodies.w_WB_B_rad_s = w_WB_B_rad_s;
    state.tips = {};
    restore({lane_of(state, 0)});
}

void ReducedPlant::displace(std::span<const double> step) {
    require(step.size() == 2 * kFreedoms, "a step for each degree of freedom and each speed");
    ReducedState<double> state;
    put_lane(state, 0, save().values);
    MechanismState<double>& bodies = state.bodies;
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
    restore({lane_of(state, 0)});
}

void ReducedPlant::displacement_from(const PlantState& origin, std::span<double> step) const {
    require(step.size() == 2 * kFreedoms, "space for each degree of freedom and each speed");
    ReducedState<double> before;
    put_lane(before, 0, origin.values);
    const MechanismState<double>& from = before.bodies;
    const MechanismState<double> bodies = mechanism();
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
