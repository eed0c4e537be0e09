// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/lane_group.hpp"

#include <boost/context/fiber.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/plant/lane_bodies.hpp"

namespace limpet::plant {
namespace {

constexpr std::size_t kStack_B = 512UL * 1024UL;

// The thread sanitizer follows one stack a thread.
#if defined(__SANITIZE_THREAD__)
constexpr bool kOneByOne = true;
#elif defined(__has_feature)
constexpr bool kOneByOne = __has_feature(thread_sanitizer);
#else
constexpr bool kOneByOne = false;
#endif

class Group;
thread_local Group* current_group = nullptr;

/// What a mission waits for.
enum class Waits {
    no,
    answer,
    step
};

class Group {
public:
    explicit Group(const LaneKind& kind)
        : kind_(kind), fibers_(static_cast<std::size_t>(kind.lanes)) {}

    void fly(const std::function<void()>& missions) {
        begin_all(missions);
        current_group = this;
        while (turn()) {
        }
        current_group = nullptr;
        if (failed_) {
            std::rethrow_exception(failed_);
        }
    }

    /// From within a mission: until the others have come so far too.
    void wait(Waits what) {
        Fiber& fiber = fibers_[running_];
        fiber.waits = what;
        fiber.outside = std::move(fiber.outside).resume();
    }

    /// @return -1: none is free
    [[nodiscard]] int take(const ReducedModel& model) {
        if (bodies_ == nullptr) {
            bodies_.reset(kind_.make(model));
        }
        const int lane = static_cast<int>(running_);
        if (std::exchange(fibers_[running_].taken, true)) {
            return -1;
        }
        bodies_->enter(lane, model);
        return lane;
    }
    void give_back(int lane) {
        bodies_->leave(lane);
        fibers_[static_cast<std::size_t>(lane)].taken = false;
    }
    [[nodiscard]] LaneBodies& bodies() { return *bodies_; }

private:
    struct Fiber {
        boost::context::fiber inside;   ///< where the mission goes on
        boost::context::fiber outside;  ///< and who resumed it
        Waits waits = Waits::no;
        bool taken = false;
    };

    /// Where there is no memory for so many stacks, fewer.
    /// @throws std::bad_alloc where there is none for one
    void begin_all(const std::function<void()>& missions) {
        std::size_t begun = 0;
        try {
            for (; begun < fibers_.size(); ++begun) {
                begin(begun, missions);
            }
        } catch (const std::bad_alloc&) {
            if (begun == 0) {
                throw;
            }
            fibers_.resize(begun);
        }
    }

    void begin(std::size_t k, const std::function<void()>& missions) {
        fibers_[k].inside = boost::context::fiber(
            std::allocator_arg, boost::context::protected_fixedsize_stack(kStack_B),
            [this, k, &missions](boost::context::fiber&& outside) {
                fibers_[k].outside = std::move(outside);
                try {
                    missions();
                } catch (...) {
                    failed_ = failed_ ? failed_ : std::current_exception();
                }
                return std::move(fibers_[k].outside);
            });
    }

    /// Everybody goes on as far as it can.
    /// @return false when all are over
    bool turn() {
        bool requested = false;
        bool flies = false;
        for (running_ = 0; running_ < fibers_.size(); ++running_) {
            Fiber& fiber = fibers_[running_];
            if (fiber.inside && fiber.waits == Waits::no) {
                fiber.inside = std::move(fiber.inside).resume();
            }
            flies = flies || fiber.inside;
            requested = requested || (fiber.inside && fiber.waits == Waits::answer);
        }
        if (!flies) {
            return false;
        }
        if (requested) {
            bodies_->answer();
        } else {
            bodies_->step();
        }
        for (Fiber& fiber : fibers_) {
            if (!requested || fiber.waits == Waits::answer) {
                fiber.waits = Waits::no;
            }
        }
        return true;
    }

    const LaneKind& kind_;
    std::vector<Fiber> fibers_;
    std::size_t running_ = 0;
    std::unique_ptr<LaneBodies> bodies_;
    std::exception_ptr failed_ = nullptr;
};

/// A lane as the loop knows a plant.
class LanePlant final : public Plant, private CupBearer {
public:
    LanePlant(Group& group, int lane, std::shared_ptr<const ReducedModel> model)
        : group_(group), bodies_(group.bodies()), lane_(lane), model_(std::move(model)) {}
    ~LanePlant() override { group_.give_back(lane_); }
    LanePlant(const LanePlant&) = delete;
    LanePlant& operator=(const LanePlant&) = delete;

    void apply(Body body, const Wrench& wrench_W, const Vector3& p_W_m) override {
        if (body != Body::cup || !bodies_.holds(lane_)) {  // it is that of the springs
            bodies_.apply(lane_, body, wrench_W, p_W_m);
        }
    }
    [[nodiscard]] CupBearer* bear_cup(const StepMode& mode) override {
        mode_ = mode;
        bodies_.set_mode(lane_, mode);
        return this;
    }
    void step(const StepMode& mode) override {
        bodies_.set_mode(lane_, mode);
        group_.wait(Waits::step);
        require_sound(bodies_.is_finite(lane_));
    }
    [[nodiscard]] Kinematics kinematics(Body body) const override {
        return bodies_.kinematics(lane_, body);
    }
    [[nodiscard]] SliderMotion slider() const override { return bodies_.slider(lane_); }
    [[nodiscard]] std::optional<double> ray(const Vector3& origin_W_m,
                                            const Vector3& dir_W) const override {
        return model_->ray(origin_W_m, dir_W);
    }
    [[nodiscard]] Vector3 contact_force_W() const override {
        return bodies_.contact_force_W(lane_);
    }
    [[nodiscard]] PlantState save() const override { return bodies_.save(lane_); }
    void restore(const PlantState& state) override { bodies_.restore(lane_, state); }
    void set_pose(const Vector3& p_WB_m, const Quaternion& q_WB, const Vector3& v_WB_W_m_s,
                  const Vector3& w_WB_B_rad_s) override {
        ReducedPlant& alone = by_itself();
        alone.set_pose(p_WB_m, q_WB, v_WB_W_m_s, w_WB_B_rad_s);
        restore(alone.save());
    }

private:
    [[nodiscard]] double step_s() const override { return mode_.step_s; }
    [[nodiscard]] const Vector6& mobility_1_s() const override {
        return model_->mechanism().lip_mobility_1_s;
    }
    [[nodiscard]] Held hold(const Matrix3& R_WT,
                            const std::array<StepForce<double>, 6>& springs) override {
        bodies_.hold(lane_, R_WT, springs);
        group_.wait(Waits::answer);
        return bodies_.held(lane_);
    }
    /// Few request it, and seldom together: each by itself.
    [[nodiscard]] Response response(const Matrix3& R_WT) override {
        bodies_.let_go(lane_);
        return by_itself().bear_cup(mode_)->response(R_WT);
    }
    void let_go() override { bodies_.let_go(lane_); }

    /// The same vehicle outside the lanes.
    [[nodiscard]] ReducedPlant& by_itself() {
        if (alone_ == nullptr) {
            alone_ = std::make_unique<ReducedPlant>(model_);
        }
        alone_->restore(save());
        return *alone_;
    }

    Group& group_;
    LaneBodies& bodies_;
    int lane_;
    std::shared_ptr<const ReducedModel> model_;
    std::unique_ptr<ReducedPlant> alone_;
    StepMode mode_;
};

}  // namespace

void fly_side_by_side(const std::function<void()>& missions, const LaneKind& kind) {
    require(current_group == nullptr, "a thread with one group of lanes");
    if (kOneByOne) {
        missions();
        return;
    }
    Group(kind).fly(missions);
}

std::unique_ptr<Plant> free_lane(const std::shared_ptr<const ReducedModel>& model) {
    if (current_group == nullptr || !model->numbers().mechanism.has_cup) {
        return nullptr;
    }
    const int lane = current_group->take(*model);
    return lane < 0 ? nullptr : std::make_unique<LanePlant>(*current_group, lane, model);
}

}  // namespace limpet::plant
