// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/force_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/core/within_step.hpp"

namespace limpet::suction {
namespace {

/// One of the six springs and dampers between lip and wall as it stands: x, y, z, twist, tilt about
/// y and z.
struct LipSpring {
    double spring, stiffness, damping, rate;  ///< [N, N/m, N s/m, m/s; N m, ...]
};

std::array<LipSpring, 6> springs_of(const LipParameters& lip, const LipMotion& motion,
                                    const Anchor& anchor, bool sealed) {
    const double depth_m = -motion.gap_m;
    const double beyond_m = std::max(0.0, depth_m - lip.hard_depth_m);
    // A free lip meets the wall edge first: its damping grows with the area in contact.
    const double contact = sealed ? 1.0 : std::clamp(depth_m / lip.damping_depth_m, 0.0, 1.0);
    const double push_N =
        lip.stiffness_N_m * (depth_m - beyond_m) + lip.hard_stiffness_N_m * beyond_m;
    const auto shear = [&lip](double stretch_m, double rate_m_s) -> LipSpring {
        return {-lip.shear_stiffness_N_m * stretch_m, lip.shear_stiffness_N_m,
                lip.shear_damping_N_s_m, rate_m_s};
    };
    const auto tilt = [&](int axis) -> LipSpring {
        return {-lip.tilt_stiffness_N_m_rad * motion.rotation_rad[axis], lip.tilt_stiffness_N_m_rad,
                lip.tilt_damping_N_m_s_rad, motion.rate_rad_s[axis]};
    };
    const double twist_rad = motion.rotation_rad.x() - anchor.twist_rad;
    return {LipSpring{-push_N, beyond_m > 0.0 ? lip.hard_stiffness_N_m : lip.stiffness_N_m,
                      lip.damping_N_s_m * contact, -motion.gap_rate_m_s},
            shear(motion.y_m - anchor.y_m, motion.y_rate_m_s),
            shear(motion.z_m - anchor.z_m, motion.z_rate_m_s),
            LipSpring{-lip.twist_stiffness_N_m_rad * twist_rad, lip.twist_stiffness_N_m_rad,
                      lip.twist_damping_N_m_s_rad, motion.rate_rad_s.x()},
            tilt(1),
            tilt(2)};
}

using LipForces = std::array<StepForce<double>, 6>;

LipForces within_step_of(const std::array<LipSpring, 6>& springs, const CupBearer* bearer) {
    static const Vector6 kNone = Vector6::Zero();
    const double step_s = bearer != nullptr ? bearer->step_s() : 0.0;
    const Vector6& mobility_1_s = bearer != nullptr ? bearer->mobility_1_s() : kNone;
    LipForces forces;
    for (std::size_t i = 0; i < forces.size(); ++i) {
        const LipSpring& one = springs[i];
        forces[i] =
            within_step<double>(one.spring, one.stiffness, one.damping, one.rate,
                                step_s * mobility_1_s[static_cast<Eigen::Index>(i)], step_s);
    }
    return forces;
}

/// Where all hold: w = now - G dv.
Vector6 held_wrench(const LipForces& forces, const Vector6& change) {
    Vector6 w;
    for (std::size_t i = 0; i < forces.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        w[at] = forces[i].now - forces[i].gain * change[at];
    }
    return w;
}

/// The springs' mean wrench over a step together with what hangs on the cup:
/// w = now - G (drift + A w).
class LipStep {
public:
    LipStep(const LipForces& forces, const CupBearer::Response& response)
        : forces_(forces), response_(response) {}
    /// Where the others are at w, this one would be here.
    [[nodiscard]] double alone(int i, const Vector6& w) const {
        const StepForce<double>& force = forces_[static_cast<std::size_t>(i)];
        const double off =
            w[i] - force.now + force.gain * (response_.drift[i] + response_.mobility.row(i).dot(w));
        return w[i] - off / (1.0 + force.gain * response_.mobility(i, i));
    }

private:
    const LipForces& forces_;
    const CupBearer::Response& response_;
};

/// As std::hypot, which guards against numbers that no force has.
double along(double y, double z) {
    return std::sqrt(y * y + z * z);
}

/// What limits the lip, the normal force given.
struct LipLimits {
    double vacuum_N, friction, radius_m;
    bool sealed;

    /// An open lip only pushes, and both pull at most as the vacuum does.
    [[nodiscard]] double pull_N(double demand_N) const {
        return std::min(sealed ? demand_N : std::min(0.0, demand_N), vacuum_N);
    }
    [[nodiscard]] double lip_N(double pull_N) const { return std::max(0.0, vacuum_N - pull_N); }
    [[nodiscard]] double shear_N(double pull_N) const { return friction * lip_N(pull_N); }
    [[nodiscard]] double twist_N_m(double pull_N) const { return shear_N(pull_N) * radius_m; }
    [[nodiscard]] double peel_N_m(double pull_N) const { return lip_N(pull_N) * lever_m(); }
    [[nodiscard]] double lever_m() const { return 0.5 * radius_m; }
};

/// What the lip must bear, before its limits.
struct LipDemand {
    double pull_N, shear_N, twist_N_m, peel_N_m;

    explicit LipDemand(const Vector6& w)
        : pull_N(w[0]),
          shear_N(along(w[1], w[2])),
          twist_N_m(std::abs(w[3])),
          peel_N_m(along(w[4], w[5])) {}
    [[nodiscard]] bool fits(const LipLimits& limits) const {
        return limits.pull_N(pull_N) == pull_N && shear_N <= limits.shear_N(pull_N) &&
               twist_N_m <= limits.twist_N_m(pull_N) && peel_N_m <= limits.peel_N_m(pull_N);
    }
};

/// Shortens two components that together exceed a limit.
double shorten(Vector6& w, int first, double limit) {
    const double wanted = along(w[first], w[first + 1]);
    if (wanted > limit) {
        w[first] *= limit / wanted;
        w[first + 1] *= limit / wanted;
    }
    return wanted;
}

/// Where some give way the others have to do with what is left, and turn to where it leads: swept
/// through in turn until all agree (projected Gauss-Seidel).
[[gnu::noinline]] LipDemand give_way(const LipStep& step, const LipLimits& limits, Vector6& w) {
    constexpr int kSweeps = 40;
    constexpr double kAgree_N = 1e-9;
    LipDemand demand(w);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        const Vector6 before = w;
        demand.pull_N = step.alone(0, w);
        w[0] = limits.pull_N(demand.pull_N);
        for (const int i : {1, 2}) {
            w[i] = step.alone(i, w);
        }
        demand.shear_N = shorten(w, 1, limits.shear_N(w[0]));
        const double twist_N_m = step.alone(3, w);
        demand.twist_N_m = std::abs(twist_N_m);
        w[3] = std::clamp(twist_N_m, -limits.twist_N_m(w[0]), limits.twist_N_m(w[0]));
        for (const int i : {4, 5}) {
            w[i] = step.alone(i, w);
        }
        demand.peel_N_m = shorten(w, 4, limits.peel_N_m(w[0]));
        if ((w - before).lpNorm<Eigen::Infinity>() < kAgree_N) {
            break;
        }
    }
    return demand;
}

/// What gives way moves its anchor along: spring and damper between lip and anchor bear the limit
/// together, F = k s + c s', so that the spring comes to hold it alone by exp(-k t / c), not at
/// once.
class Slide {
public:
    /// @param step_s  0: as it stands, at its end
    Slide(double stiffness, double damping, double step_s)
        : stiffness_(stiffness),
          step_s_(step_s),
          keeps_(step_s > 0.0 && damping > 0.0 ? std::exp(-stiffness * step_s / damping) : 0.0) {}
    /// @param rate   of the lip over the step
    /// @param force  by the wall on it, at the limit
    /// @return where the anchor is at the step's end
    [[nodiscard]] double anchor(double anchor, double lip, double rate, double force) const {
        const double held = -force / stiffness_;
        const double stretch = held + keeps_ * (lip - anchor - held);
        return lip + step_s_ * rate - stretch;
    }

private:
    double stiffness_, step_s_, keeps_;
};

/// Beyond which limit a sealed lip is loaded; the gravest first.
LetGo let_go_of(const LipLoad& load, bool twisted_open) {
    if (load.pull_margin_N < 0.0) {
        return LetGo::pulled;
    }
    if (load.shear_margin_N < 0.0 || twisted_open) {
        return LetGo::sheared;
    }
    return load.peel_margin_N < 0.0 ? LetGo::peeled : LetGo::no;
}

}  // namespace

const ParameterTable<LipParameters>& lip_table() {
    using L = LipParameters;
    static const ParameterTable<L> table = {
        {"radius_m", "m", 1e-3, 1.0, &L::radius_m, "sealed radius of the cup",
         "assumed: 80 mm cup, facts.md section 3"},
        {"stiffness_N_m", "N/m", 1.0, 1e7, &L::stiffness_N_m, "of the lip along the cup's axis",
         "baseline.md"},
        {"hard_stiffness_N_m", "N/m", 1.0, 1e7, &L::hard_stiffness_N_m, "where the lip bottoms out",
         "baseline.md"},
        {"hard_depth_m", "m", 0.0, 1.0, &L::hard_depth_m,
         "compression at which the lip bottoms out", "baseline.md"},
        {"damping_N_s_m", "N s/m", 0.0, 1e4, &L::damping_N_s_m, "of the lip along the cup's axis",
         "baseline.md"},
        {"damping_depth_m", "m", 1e-6, 1.0, &L::damping_depth_m,
         "compression over which the damping of an open lip comes in", "baseline.md"},
        {"shear_stiffness_N_m", "N/m", 1.0, 1e7, &L::shear_stiffness_N_m,
         "of the lip along the wall", "assumed: as along the axis"},
        {"shear_damping_N_s_m", "N s/m", 0.0, 1e4, &L::shear_damping_N_s_m,
         "of the lip along the wall", "assumed: as along the axis"},
        {"tilt_stiffness_N_m_rad", "N m/rad", 0.0, 1e5, &L::tilt_stiffness_N_m_rad,
         "of the lip against tilting", "baseline.md"},
        {"tilt_damping_N_m_s_rad", "N m s/rad", 0.0, 1e3, &L::tilt_damping_N_m_s_rad,
         "of the lip against tilting", "assumed: a tenth of critical for a 0.1 kg cup"},
        {"twist_stiffness_N_m_rad", "N m/rad", 0.0, 1e5, &L::twist_stiffness_N_m_rad,
         "of the lip about the cup's axis", "assumed: as against tilting"},
        {"twist_damping_N_m_s_rad", "N m s/rad", 0.0, 1e3, &L::twist_damping_N_m_s_rad,
         "of the lip about the cup's axis",
         "assumed: a loss factor of rubber of 0.2 at the 3 Hz at which the vehicle rolls on it"},
        {"least_radius_m", "m", 0.0, 1e3, &L::least_radius_m,
         "least radius of a round wall on which the lip seals, from the cup's manufacturer; 0: "
         "where radius_m^2 / 2R is hard_depth_m",
         "assumed: by geometry; Schmalz: \"minimum radius of curvature of the workpiece\""},
    };
    return table;
}

double least_radius_m(const LipParameters& lip) {
    if (lip.least_radius_m > 0.0 || !(lip.hard_depth_m > 0.0)) {
        return lip.least_radius_m;
    }
    return 0.5 * lip.radius_m * lip.radius_m / lip.hard_depth_m;
}

LipParameters on_wall(const LipParameters& lip, const WallGeometry& wall) {
    LipParameters both = lip;
    both.least_radius_m = least_radius_m(lip);
    const double soft = share_of_spring(lip.stiffness_N_m, wall);
    both.stiffness_N_m *= soft;
    both.hard_stiffness_N_m *= share_of_spring(lip.hard_stiffness_N_m, wall);
    both.hard_depth_m /= soft;
    both.damping_N_s_m *= soft * soft;
    both.damping_depth_m /= soft;
    return both;
}

bool follows(const LipParameters& lip, const WallGeometry& wall) {
    const TangentFrame spot = tangent_frame(wall, wall.p_WT_m);
    const double bulge_1_m = std::max(spot.curvature_y_1_m, spot.curvature_z_1_m);
    return bulge_1_m <= 0.0 || bulge_1_m * least_radius_m(lip) <= 1.0;
}

std::string_view to_string(LetGo reason) {
    switch (reason) {
        case LetGo::no: return "holds";
        case LetGo::lifted: return "lifted off";
        case LetGo::pulled: return "pulled off";
        case LetGo::sheared: return "sheared off";
        case LetGo::peeled: return "peeled off";
    }
    throw InternalError("reason of letting go out of range");
}

LipMotion lip_motion(const WallGeometry& wall, const Kinematics& cup) {
    const TangentFrame spot = tangent_frame(wall, cup.p_WF_m);
    LipMotion motion{.R_WT = spot.R_WT, .gap_m = spot.gap_m, .y_m = spot.y_m, .z_m = spot.z_m};
    // Everything below is about 100 times costlier and only matters next to the wall.
    constexpr double kNear_m = 0.25;
    if (motion.gap_m > kNear_m) {
        return motion;
    }
    const Vector3 v_TC = spot.R_WT.transpose() * cup.v_WF_W_m_s;
    motion.gap_rate_m_s = -v_TC.x();
    // Before a wall that bulges, the spot goes a shorter way than the lip.
    motion.y_rate_m_s = v_TC.y() / (1.0 + spot.curvature_y_1_m * spot.gap_m);
    motion.z_rate_m_s = v_TC.z() / (1.0 + spot.curvature_z_1_m * spot.gap_m);
    const Matrix3& R_TC = motion.R_TC = spot.R_WT.transpose() * cup.q_WF.toRotationMatrix();
    motion.rotation_rad = rotation_vector_from_matrix(R_TC);
    motion.rate_rad_s = R_TC * cup.w_WF_F_rad_s;
    // T itself turns as its spot wanders over the bulge.
    motion.rate_rad_s.y() -= spot.curvature_z_1_m * motion.z_rate_m_s;
    motion.rate_rad_s.z() += spot.curvature_y_1_m * motion.y_rate_m_s;
    motion.bulge_1_m = std::max(spot.curvature_y_1_m, spot.curvature_z_1_m);
    motion.faces_wall = R_TC(0, 0) > 0.5 && spot.on_wall;
    return motion;
}

double vacuum_force_N(double pressure_Pa, double radius_m, double ambient_Pa) {
    return std::max(0.0, ambient_Pa - pressure_Pa) * kPi * radius_m * radius_m;
}

LipLoad lip_load(const LipParameters& lip, const LipMotion& motion, Anchor& anchor, double friction,
                 double vacuum_N, bool sealed, CupBearer* bearer) {
    const LipForces forces = within_step_of(springs_of(lip, motion, anchor, sealed), bearer);
    const LipLimits limits{vacuum_N, friction, lip.radius_m, sealed};
    CupBearer::Held held{.change = Vector6::Zero()};
    if (bearer != nullptr) {
        held = bearer->hold(motion.R_WT, forces);
    }
    Vector6 w = held_wrench(forces, held.change);
    LipDemand demand(w);
    Vector6 change = held.change;
    if (!demand.fits(limits)) {
        const CupBearer::Response response =
            bearer != nullptr ? bearer->response(motion.R_WT) : CupBearer::Response{};
        const LipDemand wanted = demand;
        demand = give_way(LipStep(forces, response), limits, w);
        held.press_N = response.press_with_N(w);
        change = response.drift + response.mobility * w;
        if (sealed) {
            demand = wanted;  // it lets go of what it cannot hold
        }
    }
    LipLoad load;
    load.press_N = held.press_N;
    load.wrench_T = {.force_N = w.head<3>(), .moment_N_m = w.tail<3>()};
    load.pull_N = w[0];
    load.shear_N = along(w[1], w[2]);
    load.peel_N_m = along(w[4], w[5]);
    const double pull_N = sealed ? limits.pull_N(demand.pull_N) : w[0];
    load.pull_margin_N = vacuum_N - (sealed ? demand.pull_N : w[0]);
    load.shear_margin_N = limits.shear_N(pull_N) - demand.shear_N;
    load.peel_margin_N = (limits.peel_N_m(pull_N) - demand.peel_N_m) / limits.lever_m();
    const bool twists = demand.twist_N_m > limits.twist_N_m(pull_N);
    if (sealed) {
        load.let_go = let_go_of(load, twists);
        return load;
    }
    const double step_s = bearer != nullptr ? bearer->step_s() : 0.0;
    if (load.shear_margin_N < 0.0) {
        const Slide slide(lip.shear_stiffness_N_m, lip.shear_damping_N_s_m, step_s);
        anchor.y_m = slide.anchor(anchor.y_m, motion.y_m, motion.y_rate_m_s + change[1], w[1]);
        anchor.z_m = slide.anchor(anchor.z_m, motion.z_m, motion.z_rate_m_s + change[2], w[2]);
    }
    if (twists) {
        const Slide slide(lip.twist_stiffness_N_m_rad, lip.twist_damping_N_m_s_rad, step_s);
        anchor.twist_rad = slide.anchor(anchor.twist_rad, motion.rotation_rad.x(),
                                        motion.rate_rad_s.x() + change[3], w[3]);
    }
    load.let_go = motion.gap_m > 0.0 ? LetGo::lifted : LetGo::no;
    return load;
}

LipLoad held_load(const LipParameters& lip, const Wrench& wrench_T, double friction,
                  double vacuum_N) {
    const Vector3& force_N = wrench_T.force_N;
    const Vector3& moment_N_m = wrench_T.moment_N_m;
    const double lip_N = std::max(0.0, vacuum_N - force_N.x());
    const double lever_m = 0.5 * lip.radius_m;
    LipLoad load;
    load.wrench_T = wrench_T;
    load.pull_N = force_N.x();
    load.shear_N = std::hypot(force_N.y(), force_N.z());
    load.peel_N_m = std::hypot(moment_N_m.y(), moment_N_m.z());
    load.pull_margin_N = vacuum_N - load.pull_N;
    load.shear_margin_N = friction * lip_N - load.shear_N;
    load.peel_margin_N = lip_N - load.peel_N_m / lever_m;
    load.let_go = let_go_of(load, std::abs(moment_N_m.x()) > friction * lip_N * lip.radius_m);
    return load;
}

}  // namespace limpet::suction
