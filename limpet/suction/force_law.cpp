// SPDX-License-Identifier: Apache-2.0
#include "limpet/suction/force_law.hpp"

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"

namespace limpet::suction {
namespace {

/// Lip in compression: soft, then hard where it bottoms out [N].
double lip_spring_N(const LipParameters& lip, double depth_m) {
    const double beyond_m = std::max(0.0, depth_m - lip.hard_depth_m);
    return lip.stiffness_N_m * (depth_m - beyond_m) + lip.hard_stiffness_N_m * beyond_m;
}

/// Pull in the direction away from the wall, before its limit [N].
double pull_demand_N(const LipParameters& lip, const LipMotion& motion, bool sealed) {
    const double depth_m = -motion.gap_m;
    // A free lip meets the wall edge first: its damping grows with the area in contact.
    const double contact = sealed ? 1.0 : std::clamp(depth_m / lip.damping_depth_m, 0.0, 1.0);
    const double push_N =
        lip_spring_N(lip, depth_m) - lip.damping_N_s_m * contact * motion.gap_rate_m_s;
    return sealed ? -push_N : std::min(0.0, -push_N);
}

/// Two components along the wall, shortened where together they ask for more than a limit.
struct Limited {
    double y, z;
    double demand = std::hypot(y, z);

    Limited(double limit, double y_asked, double z_asked) : y(y_asked), z(z_asked) {
        if (limit - demand < 0.0) {
            y *= limit / demand;
            z *= limit / demand;
        }
    }
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
    };
    return table;
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
    const Matrix3 R_TC = spot.R_WT.transpose() * cup.q_WF.toRotationMatrix();
    motion.rotation_rad = rotation_vector_from_quaternion(Quaternion(R_TC));
    motion.rate_rad_s = R_TC * cup.w_WF_F_rad_s;
    // T itself turns as its spot wanders over the bulge.
    motion.rate_rad_s.y() -= spot.curvature_z_1_m * motion.z_rate_m_s;
    motion.rate_rad_s.z() += spot.curvature_y_1_m * motion.y_rate_m_s;
    motion.faces_wall = R_TC(0, 0) > 0.5 && spot.on_wall;
    return motion;
}

double vacuum_force_N(double pressure_Pa, double radius_m) {
    return std::max(0.0, kAtmosphere_Pa - pressure_Pa) * kPi * radius_m * radius_m;
}

LipLoad lip_load(const LipParameters& lip, const LipMotion& motion, Anchor& anchor, double friction,
                 double vacuum_N, bool sealed) {
    LipLoad load;
    const double demand_N = pull_demand_N(lip, motion, sealed);
    load.pull_N = std::min(demand_N, vacuum_N);
    load.pull_margin_N = vacuum_N - demand_N;
    const double lip_N = std::max(0.0, vacuum_N - load.pull_N);

    const double shear_limit_N = friction * lip_N;
    const auto shear_N = [&](double stretch_m, double rate_m_s) {
        return -lip.shear_stiffness_N_m * stretch_m - lip.shear_damping_N_s_m * rate_m_s;
    };
    const Limited shear(shear_limit_N, shear_N(motion.y_m - anchor.y_m, motion.y_rate_m_s),
                        shear_N(motion.z_m - anchor.z_m, motion.z_rate_m_s));
    load.shear_N = std::hypot(shear.y, shear.z);
    load.shear_margin_N = shear_limit_N - shear.demand;
    if (!sealed && load.shear_margin_N < 0.0) {
        // slides: the anchor follows so that the spring alone holds the limit
        anchor.y_m = motion.y_m + shear.y / lip.shear_stiffness_N_m;
        anchor.z_m = motion.z_m + shear.z / lip.shear_stiffness_N_m;
    }

    const double lever_m = 0.5 * lip.radius_m;
    const double peel_limit_N_m = lip_N * lever_m;
    const Vector3 upright_N_m = -lip.tilt_stiffness_N_m_rad * motion.rotation_rad -
                                lip.tilt_damping_N_m_s_rad * motion.rate_rad_s;
    const Limited tilt(peel_limit_N_m, upright_N_m.y(), upright_N_m.z());
    load.peel_N_m = std::hypot(tilt.y, tilt.z);
    load.peel_margin_N = (peel_limit_N_m - tilt.demand) / lever_m;

    const double twist_limit_N_m = friction * lip_N * lip.radius_m;
    const double twist_demand_N_m =
        -lip.twist_stiffness_N_m_rad * (motion.rotation_rad.x() - anchor.twist_rad) -
        lip.twist_damping_N_m_s_rad * motion.rate_rad_s.x();
    const double twist_N_m = std::clamp(twist_demand_N_m, -twist_limit_N_m, twist_limit_N_m);
    if (!sealed && twist_N_m != twist_demand_N_m) {
        anchor.twist_rad = motion.rotation_rad.x() + twist_N_m / lip.twist_stiffness_N_m_rad;
    }

    load.wrench_T.force_N = {load.pull_N, shear.y, shear.z};
    load.wrench_T.moment_N_m = {twist_N_m, tilt.y, tilt.z};
    if (!sealed) {
        load.let_go = motion.gap_m > 0.0 ? LetGo::lifted : LetGo::no;
    } else {
        load.let_go = let_go_of(load, twist_N_m != twist_demand_N_m);
    }
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
