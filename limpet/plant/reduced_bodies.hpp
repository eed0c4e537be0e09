// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

#include "limpet/core/signals/kinematics.hpp"
#include "limpet/plant/mechanism_step.hpp"
#include "limpet/plant/reduced_state.hpp"

// The reduced engine on a scalar type T: a vehicle in each lane. Nine generalised coordinates,
// semi-implicit Euler, joints, legs and whatever holds the lip within the step (MechanismStep).
namespace limpet::plant {

template <class T>
class ReducedBodies {
public:
    using Mask = MaskOf<T>;
    static constexpr int kLanes = T::kCount;

    ReducedNumbers<T> numbers;
    ReducedState<T> state;
    std::array<const Faces*, kLanes> faces{};

    /// After every change of numbers or state.
    void refresh() {
        pushes_.fill(true);
        find_place();
    }
    [[nodiscard]] MechanismStep<T>& step() { return step_; }
    [[nodiscard]] const Mechanism<T>& at() const { return step_.at(); }

    void apply(int lane, Body body, const Wrench& wrench_W, const Vector3& p_W_m) {
        const Vector3 arm_m = p_W_m - in_lane(state.bodies.p_WB_m, lane);
        const Vector3 moment_N_m = wrench_W.moment_N_m + arm_m.cross(wrench_W.force_N);
        const auto k = static_cast<std::size_t>(body);
        PushedOn<T>& on = state.pushed[k];
        pushes_[k] = true;
        set_lane(on.force_W_N, lane, in_lane(on.force_W_N, lane) + wrench_W.force_N);
        set_lane(on.moment_W_N_m, lane, in_lane(on.moment_W_N_m, lane) + moment_N_m);
        news_ = true;
    }

    /// All springs and forces of a step.
    /// @param contacts  where each leg can touch something
    void prepare(const T& step_s, const std::array<Mask, kTips>& contacts) {
        if (!step_.closed(step_s)) {
            touching_ = false;
            if (any(contacts[0] || contacts[1]) && numbers.mechanism.has_cup) {
                find_touches(step_s, contacts);
            } else {
                state.tips = {};
            }
            close(step_s);
        }
        if (news_) {
            push_all();
            news_ = false;
        }
    }
    /// The step itself, when it is prepared.
    void advance(const T& step_s) {
        const MechanismChange<T> change = settle(step_s);
        if (numbers.mechanism.has_cup) {
            state.slider_N = step_.joint_force(0, change);
        }
        take_contacts(change, step_s);
        integrate(change, step_s);
        state.pushed = {};
        pushes_.fill(false);
        find_place();
    }

    [[nodiscard]] Kinematics kinematics(int lane, Body body) const {
        const MechanismState<T>& base = state.bodies;
        const auto seen = [lane](const Vec3<T>& p, const Eigen::Quaternion<T>& q, const Vec3<T>& v,
                                 const Vec3<T>& w) -> Kinematics {
            return {.p_WF_m = in_lane(p, lane),
                    .q_WF = {q.w()[lane], q.x()[lane], q.y()[lane], q.z()[lane]},
                    .v_WF_W_m_s = in_lane(v, lane),
                    .w_WF_F_rad_s = in_lane(w, lane)};
        };
        if (body == Body::base) {
            return seen(base.p_WB_m, base.q_WB, base.v_WB_W_m_s, base.w_WB_B_rad_s);
        }
        const auto of = [&seen](const Motion<T>& moves) {
            return seen(moves.p_WF_m, moves.q_WF, moves.v_WF_W_m_s, moves.w_WF_F_rad_s);
        };
        return body == Body::cup ? of(cup_) : of(motion(body));
    }

private:
    /// A tip on a face, in this step.
    struct Touch {
        Mask acts{};
        Mask slides{};
        Mat3<T> R_WT = Mat3<T>::Identity();
        std::array<Spatial<T>, 3> direction;  ///< of the tip's motion along the axes of T
        std::array<StepForce<T>, 3> spring{};
        Vec3<T> rate_m_s = Vec3<T>::Zero();
        T stiffness_N_m{}, damping_N_s_m{};  ///< across
    };

    void find_place() {
        step_.start(numbers.mechanism, state.bodies);
        if (numbers.mechanism.has_cup) {
            cup_ = motion(Body::cup);
        }
        news_ = true;
    }

    [[nodiscard]] Motion<T> motion(Body body) const {
        const MechanismState<T>& base = state.bodies;
        const Mechanism<T>& now = at();
        const bool cup = body == Body::cup;
        Motion<T> moves{base.p_WB_m, base.q_WB, base.v_WB_W_m_s, base.w_WB_B_rad_s};
        Vec3<T> v_B_m_s = base.w_WB_B_rad_s.cross(now.joint_B_m);
        v_B_m_s.x() += base.joint_rate[0];
        if (cup) {
            v_B_m_s += now.cup_w_B_rad_s.cross(now.lip_arm_B_m);
            moves.q_WF = base.q_WB * now.q_BC;
            moves.w_WF_F_rad_s = now.R_BC.transpose() * now.cup_w_B_rad_s;
        }
        moves.p_WF_m += now.R_WB * (cup ? now.lip_B_m : now.joint_B_m);
        moves.v_WF_W_m_s += now.R_WB * v_B_m_s;
        return moves;
    }

    void push_all() {
        MechanismForces<T>& all = step_.pushed();
        all = at().force;
        Spatial<T>* const on[] = {&all.base, &all.carriage, &all.cup};
        for (std::size_t k = 0; k < kBodies; ++k) {
            if (pushes_[k]) {
                push(state.pushed[k], *on[k]);
            }
        }
    }
    void push(const PushedOn<T>& by, Spatial<T>& on) const {
        const Mat3<T>& R_WB = at().R_WB;
        on += Spatial<T>::of(R_WB.transpose() * by.moment_W_N_m, R_WB.transpose() * by.force_W_N);
    }

    void close(const T& step_s) {
        step_.begin(step_s);
        for (const auto& of_tip : touches_) {
            for (const Touch& touch : of_tip) {
                if (touching_ && any(touch.acts)) {
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        step_.add_spring(touch.direction[axis], touch.spring[axis]);
                    }
                }
            }
        }
        step_.close();
    }

    void find_touches(const T& step_s, const std::array<Mask, kTips>& contacts) {
        for (std::size_t tip = 0; tip < kTips; ++tip) {
            const Vec3<T> tip_W_m = state.bodies.p_WB_m + at().R_WB * numbers.tip_B_m[tip];
            for (std::size_t face = 0; face < kFaces; ++face) {
                Touch& touch = touches_[tip][face];
                touch.acts = touch.slides = {};
                T gap_m(0.0);
                for (int lane = 0; lane < kLanes; ++lane) {
                    if (!in_lane(contacts[tip], lane) || !look(tip_W_m, face, lane, touch, gap_m)) {
                        state.tips[tip][face].stretch_y_m.set(lane, 0.0);
                        state.tips[tip][face].stretch_z_m.set(lane, 0.0);
                    }
                }
                if (any(touch.acts)) {
                    touching_ = true;
                    meet(touch, state.tips[tip][face], tip, gap_m, step_s);
                }
            }
        }
    }
    /// @return whether the tip touches the face there
    [[nodiscard]] bool look(const Vec3<T>& tip_W_m, std::size_t face, int lane, Touch& touch,
                            T& gap_m) const {
        const auto k = static_cast<std::size_t>(lane);
        if (faces[k] == nullptr || !(*faces[k])[face].there) {
            return false;
        }
        const WallGeometry& by = (*faces[k])[face].geometry;
        const Vector3 at_W_m = in_lane(tip_W_m, lane);
        if (!(before_wall_m(by, at_W_m) < numbers.tip_radius_m[lane])) {
            return false;
        }
        const TangentFrame spot = tangent_frame(by, at_W_m);
        if (!spot.on_wall) {
            return false;
        }
        set_lane(touch.acts, lane, true);
        gap_m.set(lane, spot.gap_m);
        touch.stiffness_N_m.set(lane, (*faces[k])[face].tip_stiffness_N_m);
        touch.damping_N_s_m.set(lane, (*faces[k])[face].tip_damping_N_s_m);
        for (int i = 0; i < 9; ++i) {
            touch.R_WT.data()[i].set(lane, spot.R_WT.data()[i]);
        }
        return true;
    }
    void meet(Touch& touch, const TipContact<T>& contact, std::size_t tip, const T& gap_m,
              const T& step_s) const {
        const MechanismState<T>& bodies = state.bodies;
        const Mat3<T> R_BT = at().R_WB.transpose() * touch.R_WT;
        const Vec3<T> meets_B_m =
            numbers.tip_B_m[tip] + numbers.tip_radius_m * Vec3<T>(R_BT.col(0));
        touch.rate_m_s = touch.R_WT.transpose() * bodies.v_WB_W_m_s +
                         R_BT.transpose() * bodies.w_WB_B_rad_s.cross(meets_B_m);
        const T stretch_m[] = {numbers.tip_radius_m - gap_m, contact.stretch_y_m,
                               contact.stretch_z_m};
        const T mobility = double{kTips} * step_s / numbers.mechanism.mass_kg;
        const T none(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            touch.direction[k] =
                Spatial<T>::wrench(meets_B_m, Vec3<T>(R_BT.col(axis)), Vec3<T>::Zero());
            const T stiffness_N_m = axis == 0 ? touch.stiffness_N_m : T(vehicle::kTipStiffness_N_m);
            const T damping_N_s_m = axis == 0 ? touch.damping_N_s_m : T(vehicle::kTipDamping_N_s_m);
            touch.spring[k] = within_step<T>(-stiffness_N_m * stretch_m[k], stiffness_N_m,
                                             damping_N_s_m, touch.rate_m_s[axis], mobility, step_s);
        }
        // What leaves faster than its rubber follows is free.
        const Mask holds = touch.acts && touch.spring[0].now <= none;
        for (StepForce<T>& spring : touch.spring) {
            spring = {select(holds, spring.now, none), select(holds, spring.gain, none)};
        }
    }

    [[nodiscard]] static T force_N(const Touch& touch, std::size_t axis,
                                   const MechanismChange<T>& change) {
        const StepForce<T>& spring = touch.spring[axis];
        return spring.now - spring.gain * touch.direction[axis].dot(change.base);
    }

    /// @return where the tip's springs had to change: it lifts, or slides
    [[nodiscard]] Mask let_slide(Touch& touch, const MechanismChange<T>& change) const {
        constexpr double kSettled = 1e-4;  // how well friction agrees with the press
        const T none(0.0);
        const T push_N = -force_N(touch, 0, change);
        const T y_N = force_N(touch, 1, change);
        const T z_N = force_N(touch, 2, change);
        const T asked_N = sqrt(y_N * y_N + z_N * z_N);
        const T limit_N = numbers.friction * push_N;
        const T beyond_N = asked_N - limit_N;
        const Mask lifts = touch.acts && push_N < none;
        // One that slides presses as it slides, not as it did while it was taken to stick.
        const T tolerated_N = select(touch.slides, kSettled * limit_N, none);
        const Mask off = beyond_N > tolerated_N || (touch.slides && -beyond_N > tolerated_N);
        const Mask slips = touch.acts && !lifts && off && asked_N != none;
        touch.slides = touch.slides || slips;
        for (StepForce<T>& spring : touch.spring) {
            spring = {select(lifts, none, spring.now), select(lifts, none, spring.gain)};
        }
        const T share = limit_N / select(slips, asked_N, T(1.0));
        touch.spring[1] = {select(slips, y_N * share, touch.spring[1].now),
                           select(slips, none, touch.spring[1].gain)};
        touch.spring[2] = {select(slips, z_N * share, touch.spring[2].now),
                           select(slips, none, touch.spring[2].gain)};
        return lifts || slips;
    }

    /// The change of the speeds with all tips either sticking within their limits or sliding.
    [[nodiscard]] MechanismChange<T> settle(const T& step_s) {
        constexpr int kPasses = 12;  // a tip lifts, another takes over and slides, harder or less
        for (int pass = 0; touching_ && pass < kPasses; ++pass) {
            const MechanismChange<T>& change = step_.change();
            Mask changed{};
            for (auto& of_tip : touches_) {
                for (Touch& touch : of_tip) {
                    if (any(touch.acts)) {
                        changed = let_slide(touch, change) || changed;
                    }
                }
            }
            if (!any(changed)) {
                break;
            }
            close(step_s);
        }
        return step_.change();
    }

    void take_contacts(const MechanismChange<T>& change, const T& step_s) {
        state.contact_force_W_N.setZero();
        const T none(0.0);
        for (std::size_t tip = 0; touching_ && tip < kTips; ++tip) {
            for (std::size_t face = 0; face < kFaces; ++face) {
                const Touch& touch = touches_[tip][face];
                if (!any(touch.acts)) {
                    continue;
                }
                Vec3<T> force_T_N;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    force_T_N[static_cast<Eigen::Index>(axis)] =
                        select(touch.acts, force_N(touch, axis, change), none);
                }
                state.contact_force_W_N += touch.R_WT * force_T_N;
                TipContact<T>& contact = state.tips[tip][face];
                const Mask lifted = touch.spring[0].gain == none;
                const auto stretched = [&](int axis, const T& before_m) {
                    const auto k = static_cast<std::size_t>(axis);
                    const T next_m_s = touch.rate_m_s[axis] + touch.direction[k].dot(change.base);
                    const T stuck_m = before_m + step_s * next_m_s;
                    const T slid_m = -force_T_N[axis] / vehicle::kTipStiffness_N_m;
                    return select(lifted, none, select(touch.slides, slid_m, stuck_m));
                };
                contact.stretch_y_m = stretched(1, contact.stretch_y_m);
                contact.stretch_z_m = stretched(2, contact.stretch_z_m);
            }
        }
    }

    void integrate(const MechanismChange<T>& change, const T& step_s) {
        MechanismState<T>& bodies = state.bodies;
        bodies.v_WB_W_m_s += at().R_WB * change.base.moving();
        bodies.w_WB_B_rad_s += change.base.turning();
        bodies.p_WB_m += step_s * bodies.v_WB_W_m_s;
        const Vec3<T> half_rad = (0.5 * step_s) * bodies.w_WB_B_rad_s;
        bodies.q_WB = turned(bodies.q_WB, half_rad);
        for (std::size_t k = 0; k < kJoints; ++k) {
            bodies.joint_rate[k] += change.joint[k];
            bodies.joint[k] += step_s * bodies.joint_rate[k];
        }
    }
    /// By twice a rotation vector that is small: of a step.
    [[nodiscard]] static Eigen::Quaternion<T> turned(const Eigen::Quaternion<T>& q,
                                                     const Vec3<T>& half_rad) {
        T sine_over, cosine;
        small_sine_cosine<T>(half_rad.squaredNorm(), sine_over, cosine);
        const Vec3<T> v = sine_over * half_rad;
        const Eigen::Quaternion<T> next = q * Eigen::Quaternion<T>(cosine, v.x(), v.y(), v.z());
        const T over = 1.0 / sqrt(next.w() * next.w() + next.x() * next.x() + next.y() * next.y() +
                                  next.z() * next.z());
        return {next.w() * over, next.x() * over, next.y() * over, next.z() * over};
    }

    MechanismStep<T> step_;
    Motion<T> cup_;
    std::array<std::array<Touch, kFaces>, kTips> touches_;
    bool touching_ = false;
    std::array<bool, kBodies> pushes_{};  ///< bodies that something may push
    bool news_ = true;                    ///< pushes that step_ does not know
};

template <class T>
[[nodiscard]] SliderMotion slider_of(const ReducedBodies<T>& bodies, int lane) {
    return {.position_m = bodies.state.bodies.joint[0][lane],
            .velocity_m_s = bodies.state.bodies.joint_rate[0][lane],
            .force_N = bodies.state.slider_N[lane]};
}
template <class T>
[[nodiscard]] bool is_finite(const ReducedBodies<T>& bodies, int lane) {
    const MechanismState<T>& state = bodies.state.bodies;
    return std::isfinite(in_lane(state.p_WB_m, lane).sum() +
                         in_lane(state.w_WB_B_rad_s, lane).sum());
}

}  // namespace limpet::plant
