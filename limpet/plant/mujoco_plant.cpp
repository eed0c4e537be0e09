// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mujoco_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/loaded/mujoco.hpp"
#include "limpet/plant/mujoco_frames.hpp"

namespace limpet::plant {

namespace {

using loaded::mujoco;

using mujoco_frames::turn;
using mujoco_frames::turn_attitude;

using Map3 = Eigen::Map<const Vector3>;

/// Visits every array on which the future depends, besides the positions, in the order in which it
/// is saved. All else that mjData holds follows from these.
template <class Visit>
void for_each_state(const mjModel& model, mjData& data, Wrench& contacts_W, double& slider_N,
                    Visit visit) {
    visit(&data.time, 1);
    visit(data.qvel, model.nv);
    visit(data.qacc_warmstart, model.nv);
    visit(data.qfrc_applied, model.nv);
    visit(data.xfrc_applied, 6 * model.nbody);
    visit(contacts_W.force_N.data(), 3);
    visit(contacts_W.moment_N_m.data(), 3);
    visit(&slider_N, 1);
}

std::shared_ptr<const MujocoModel> own_model(const std::shared_ptr<const PlantModel>& model) {
    auto own = std::dynamic_pointer_cast<const MujocoModel>(model);
    require(own != nullptr, "a model of MuJoCo's");
    return own;
}

}  // namespace

MujocoPlant::MujocoPlant(std::shared_ptr<const MujocoModel> model)
    : model_(std::move(model)),
      options_(std::make_unique<mjModel>(model_->get())),
      data_(mujoco().mj_makeData(options_.get()), mujoco().mj_deleteData),
      integrated_(data_->qpos, data_->qpos + options_->nq) {
    refresh();
    start_twin();
}

MujocoPlant::MujocoPlant(const std::shared_ptr<const PlantModel>& model)
    : MujocoPlant(own_model(model)) {}

MujocoPlant::~MujocoPlant() = default;

std::unique_ptr<Plant> MujocoModel::make() const {
    return std::make_unique<MujocoPlant>(shared_from_this());
}

int MujocoPlant::engine_body(Body body) const {
    const MujocoModel::Places& at = model_->places();
    require(body == Body::base || at.has_cup, "this vehicle has a slider and a cup");
    switch (body) {
        case Body::base: return at.base_body;
        case Body::carriage: return at.carriage_body;
        case Body::cup: return at.cup_body;
    }
    throw InternalError("no such body");
}

void MujocoPlant::apply(Body body, const Wrench& wrench_W, const Vector3& p_W_m) {
    const int id = engine_body(body);
    const Vector3 force = turn(wrench_W.force_N);
    // MuJoCo takes the force at the body's own centre of mass.
    const Vector3 arm = turn(p_W_m) - Map3(data_->xipos + 3 * id);
    double* applied = data_->xfrc_applied + 6 * id;
    Eigen::Map<Vector3>(applied) += force;
    Eigen::Map<Vector3>(applied + 3) += turn(wrench_W.moment_N_m) + arm.cross(force);
    if (model_->places().has_cup) {
        push(twin_, body, wrench_W, p_W_m);
    }
}

void MujocoPlant::step(const StepMode& mode) {
    const int without = model_->get().opt.disableflags | (mode.contacts ? 0 : mjDSBL_CONTACT);
    if (options_->opt.timestep != mode.step_s || options_->opt.disableflags != without ||
        legs_lost_ != mode.legs_lost) {
        break_legs(mode.legs_lost);
        options_->opt.timestep = mode.step_s;
        options_->opt.disableflags = without;
        refresh();
    }
    if (model_->places().has_cup) {
        push_joints(mode.step_s);
    }
    mujoco().mj_step2(options_.get(), data_.get());
    // The first half makes new contacts, which have no forces yet.
    sum_contacts();
    take_positions();
    refresh();
    require_healthy();
    start_twin();
    std::fill_n(data_->xfrc_applied, 6 * options_->nbody, 0.0);
    std::fill_n(data_->qfrc_applied, options_->nv, 0.0);
}

/// A pair of leg and wall meets no more where it would have to be deeper than anything gets.
void MujocoPlant::break_legs(const std::array<bool, 2>& lost) {
    constexpr double kDeeper_m = -1e3;
    if (lost == legs_lost_) {
        return;
    }
    legs_lost_ = lost;
    const mjModel& whole = model_->get();
    pair_margin_.assign(whole.pair_margin, whole.pair_margin + whole.npair);
    for (std::size_t leg = 0; leg < std::min(lost.size(), pair_margin_.size()); ++leg) {
        if (lost[leg]) {
            pair_margin_[leg] = kDeeper_m;
        }
    }
    options_->pair_margin = pair_margin_.data();
}

void MujocoPlant::take_positions() {
    std::copy_n(data_->qpos, options_->nq, integrated_.data());
}

/// MuJoCo's first half normalises the quaternion in place, and once more is not always the same
/// bits. So it always starts from the positions as they were integrated: a state that is refreshed
/// again, after a change of mode or in another plant, stays as it is.
void MujocoPlant::refresh() {
    std::copy_n(integrated_.data(), options_->nq, data_->qpos);
    mujoco().mj_step1(options_.get(), data_.get());
}

/// Where MuJoCo's bodies are, and pushed by the legs as in the last step: what they will push in
/// this one is MuJoCo's solver's to find.
void MujocoPlant::start_twin() {
    const MujocoModel::Places& at = model_->places();
    if (!at.has_cup) {
        return;
    }
    const double* qpos = data_->qpos + at.base_position;
    const double* qvel = data_->qvel + at.base_velocity;
    MechanismState<double> state{.p_WB_m = turn(qpos),
                                 .q_WB = turn_attitude(qpos + 3).normalized(),
                                 .v_WB_W_m_s = turn(qvel),
                                 .w_WB_B_rad_s = turn(qvel + 3)};
    for (std::size_t k = 0; k < kJoints; ++k) {
        state.joint[k] = data_->qpos[at.joint_position[k]];
        state.joint_rate[k] = data_->qvel[at.joint_velocity[k]];
    }
    twin_.start(model_->mechanism().numbers, state);
    push(twin_, Body::base, contacts_W_, state.p_WB_m);
}

CupBearer* MujocoPlant::bear_cup(const StepMode& mode) {
    require(model_->places().has_cup, "this vehicle has a slider and a cup");
    return bearer_.ask(model_->mechanism(), mode);
}

void MujocoPlant::push_joints(double step_s) {
    twin_.close(step_s);
    const MechanismChange<double>& change = twin_.change();
    for (std::size_t k = 0; k < kJoints; ++k) {
        data_->qfrc_applied[model_->places().joint_velocity[k]] = twin_.joint_force(k, change);
    }
    slider_N_ = twin_.joint_force(0, change);
}

void MujocoPlant::sum_contacts() {
    contacts_W_ = {};
    const Vector3 base = turn(data_->xpos + 3 * model_->places().base_body);
    for (int i = 0; i < data_->ncon; ++i) {
        const mjContact& contact = data_->contact[i];
        if (contact.efc_address < 0) {
            continue;
        }
        mjtNum force[6];  // by the first shape on the second, in the contact's axes
        mujoco().mj_contactForce(options_.get(), data_.get(), i, force);
        mjtNum force_world[3];
        mujoco().mju_rotVecMatT(force_world, force, contact.frame);
        const int second = options_->body_weldid[options_->geom_bodyid[contact.geom2]];
        const double sign = second == 0 ? -1.0 : 1.0;
        const Vector3 force_W_N = sign * turn(force_world);
        contacts_W_.force_N += force_W_N;
        contacts_W_.moment_N_m += (turn(contact.pos) - base).cross(force_W_N);
    }
}

/// MuJoCo counts what goes wrong, resets the state and goes on; a flight must not.
void MujocoPlant::require_healthy() {
    for (int i = 0; i < mjNWARNING; ++i) {
        if (data_->warning[i].number > 0) [[unlikely]] {
            const int info = data_->warning[i].lastinfo;
            throw InternalError(fmt::format("MuJoCo diverged after {} s: {}", data_->time,
                                            mujoco().mju_warningText(i, info)));
        }
    }
}

Kinematics MujocoPlant::kinematics(Body body) const {
    const int id = engine_body(body);
    const mjData& data = *data_;
    const Vector3 origin(body == Body::cup ? data.site_xpos + 3 * model_->places().lip_site
                                           : data.xpos + 3 * id);
    // cvel is the motion of the body's material at the vehicle's centre of mass, in world axes.
    const Map3 w(data.cvel + 6 * id);
    const Map3 v_at_centre(data.cvel + 6 * id + 3);
    const Vector3 arm = origin - Map3(data.subtree_com + 3 * options_->body_rootid[id]);
    const Quaternion q_WF = turn_attitude(data.xquat + 4 * id);
    return {.p_WF_m = turn(origin),
            .q_WF = q_WF,
            .v_WF_W_m_s = turn(Vector3(v_at_centre + w.cross(arm))),
            .w_WF_F_rad_s = q_WF.conjugate() * turn(w.data())};
}

SliderMotion MujocoPlant::slider() const {
    const MujocoModel::Places& at = model_->places();
    if (!at.has_cup) {
        return {};
    }
    return {.position_m = data_->qpos[at.joint_position[0]],
            .velocity_m_s = data_->qvel[at.joint_velocity[0]],
            .force_N = slider_N_};
}

std::optional<double> MujocoPlant::ray(const Vector3& origin_W_m, const Vector3& dir_W) const {
    static constexpr mjtByte kSurroundings[mjNGROUP] = {1, 0, 0, 0, 0, 0};
    const Vector3 from = turn(origin_W_m);
    const Vector3 along = turn(dir_W);
    int shape = -1;
    const double distance_m = mujoco().mj_ray(options_.get(), data_.get(), from.data(),
                                              along.data(), kSurroundings, 1, -1, &shape);
    return shape < 0 ? std::nullopt : std::optional(distance_m);
}

PlantState MujocoPlant::save() const {
    PlantState state{.values = integrated_};
    Wrench contacts_W = contacts_W_;
    double slider_N = slider_N_;
    for_each_state(*options_, *data_, contacts_W, slider_N,
                   [&state](const double* values, int count) {
                       state.values.insert(state.values.end(), values, values + count);
                   });
    return state;
}

void MujocoPlant::restore(const PlantState& state) {
    int expected = options_->nq;
    const auto add = [&expected](const double*, int count) { expected += count; };
    for_each_state(*options_, *data_, contacts_W_, slider_N_, add);
    require(state.values.size() == static_cast<std::size_t>(expected), "a state of this model");
    // Also after a divergence: its warnings and half-done work must not outlive it.
    mujoco().mj_resetData(options_.get(), data_.get());
    const double* from = state.values.data();
    const auto read = [&from](double* values, int count) {
        std::copy_n(from, count, values);
        from += count;
    };
    read(integrated_.data(), options_->nq);
    for_each_state(*options_, *data_, contacts_W_, slider_N_, read);
    refresh();
    start_twin();
    if (model_->places().has_cup) {  // what waits for the next step
        for (const Body body : {Body::base, Body::carriage, Body::cup}) {
            const double* applied = data_->xfrc_applied + 6 * engine_body(body);
            push(twin_, body, {.force_N = turn(applied), .moment_N_m = turn(applied + 3)},
                 turn(data_->xipos + 3 * engine_body(body)));
        }
    }
}

void MujocoPlant::set_pose(const Vector3& p_WB_m, const Quaternion& q_WB, const Vector3& v_WB_W_m_s,
                           const Vector3& w_WB_B_rad_s) {
    const MujocoModel::Places& at = model_->places();
    mujoco_frames::write(p_WB_m, data_->qpos + at.base_position);
    mujoco_frames::write_attitude(q_WB.normalized(), data_->qpos + at.base_position + 3);
    mujoco_frames::write(v_WB_W_m_s, data_->qvel + at.base_velocity);
    mujoco_frames::write(w_WB_B_rad_s, data_->qvel + at.base_velocity + 3);
    take_positions();
    refresh();
    start_twin();
}

std::span<const double> MujocoPlant::positions() const {
    return {data_->qpos, static_cast<std::size_t>(options_->nq)};
}

}  // namespace limpet::plant
