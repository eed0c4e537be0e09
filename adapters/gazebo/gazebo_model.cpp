// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gazebo/ode/error.h>

#include <atomic>
#include <boost/any.hpp>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <gazebo/physics/ContactManager.hh>
#include <utility>

#include "adapters/gazebo/frames.hpp"
#include "adapters/gazebo/gazebo_plant.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/models/links.hpp"

namespace limpet::gazebo11 {
namespace {

using gazebo_frames::turn_W;
namespace physics = gazebo::physics;

/// The world and the scenario are written by the same program; more than rounding is a difference.
constexpr double kSame = 1e-6;
/// Beyond anything that the slider does.
constexpr double kFree_m = 1e3;

std::atomic<long long> complaints{0};

void hear_ode(int /*number*/, const char* text, std::va_list values) {
    if (std::strstr(text, "LCP internal error") != nullptr) {
        ++complaints;
        return;
    }
    std::fputs("ODE: ", stderr);
    std::vfprintf(stderr, text, values);
    std::fputs("\n", stderr);
}

/// @param change  what makes them the same
void require_same(const char* what, double here, double expected, const char* unit,
                  const std::string& change = "export the world anew") {
    if (!(std::abs(here - expected) <= kSame * std::max(1.0, std::abs(expected)))) {
        throw InputError(fmt::format("{} is {:.9g} {} in the world, {:.9g} {} in the scenario; {}",
                                     what, here, unit, expected, unit, change));
    }
}

/// @param part  "link" or "joint"
template <class Found>
Found require_there(const physics::Model& model, const char* part, const std::string& name,
                    Found found) {
    if (found == nullptr) {
        throw InputError(fmt::format("model \"{}\" has no {} \"{}\", which perching needs",
                                     model.GetName(), part, name));
    }
    return found;
}

physics::JointPtr find_joint(physics::Model& model, const std::string& name,
                             physics::Base::EntityType type, const char* kind) {
    const physics::JointPtr found = require_there(model, "joint", name, model.GetJoint(name));
    if (!found->HasType(type)) {
        throw InputError(
            fmt::format("joint \"{}\" of model \"{}\" is not {}", name, model.GetName(), kind));
    }
    return found;
}

/// Explicit springs and dampers of ODE are not stable on a light cup.
physics::JointPtr find_hinge(physics::Model& model, const std::string& name) {
    const physics::JointPtr hinge = find_joint(model, name, physics::Base::HINGE_JOINT, "revolute");
    if (!(hinge->GetStiffness(0) > 0.0 && hinge->GetDamping(0) > 0.0)) {
        throw InputError(fmt::format(
            "joint \"{}\" has no spring and damper, which perching needs; export the model anew",
            name));
    }
    return hinge;
}

std::string solver_of(const physics::PhysicsEngine& engine) {
    return boost::any_cast<std::string>(engine.GetParam("solver_type"));
}

/// ODE alone flies the vehicle, with the solver that keeps a light cup's joints stiff.
void check_engine(const physics::PhysicsEngine& engine) {
    if (engine.GetType() != "ode") {
        throw InputError(fmt::format(
            "physics engine \"{}\": only \"ode\" flies this vehicle; set the world's <physics "
            "type=\"ode\">",
            engine.GetType()));
    }
    if (const std::string solver = solver_of(engine); solver != "world") {
        throw InputError(
            fmt::format("solver \"{}\" leaves the light cup's joints soft; set the world's "
                        "<physics><ode><solver><type>world</type></solver></ode></physics>",
                        solver));
    }
}

void check_gravity_and_mass(const physics::Model& model, double expected_kg) {
    const Vector3 gravity_W = turn_W(model.GetWorld()->Gravity());
    const std::string change =
        fmt::format("set the world's <gravity>0 0 {:.9g}</gravity>", -kGravity_m_s2);
    require_same("gravity", gravity_W.z(), kGravity_m_s2, "m/s^2 downwards", change);
    require_same("gravity across", std::hypot(gravity_W.x(), gravity_W.y()), 0.0, "m/s^2", change);
    double mass_kg = 0.0;
    for (const physics::LinkPtr& link : model.GetLinks()) {
        mass_kg += link->GetInertial()->Mass();
    }
    require_same("the vehicle's mass", mass_kg, expected_kg, "kg");
}

/// The face that rays see must be the one on which the cup seals.
void check_wall(physics::RayShape& ray, const scenario::Scenario& scenario) {
    if (!scenario.wall.present) {
        return;
    }
    constexpr double kBefore_m = 0.05;
    const WallGeometry& wall = scenario.wall.geometry;
    for (const double y : {-0.9, 0.0, 0.9}) {
        for (const double z : {-0.9, 0.0, 0.9}) {
            const Vector3 beside_W_m = wall.p_WT_m + wall.R_WT.col(1) * (y * wall.half_width_m) +
                                       wall.R_WT.col(2) * (z * wall.half_height_m);
            const TangentFrame spot = tangent_frame(wall, beside_W_m);
            const Vector3 into_W = spot.into_W();
            const Vector3 p_W_m = beside_W_m + spot.gap_m * into_W;
            ray.SetPoints(turn_W(Vector3(p_W_m - kBefore_m * into_W)),
                          turn_W(Vector3(p_W_m + kBefore_m * into_W)));
            double distance_m = 0.0;
            std::string entity;
            ray.GetIntersection(distance_m, entity);
            if (entity.empty() || std::abs(distance_m - kBefore_m) > 1e-4) {
                throw InputError(fmt::format(
                    "the wall of the world is not where the scenario's is: no face at x {:.3f} m, "
                    "y {:.3f} m, z {:.3f} m (east, north, up); export the world anew",
                    p_W_m.y(), p_W_m.x(), -p_W_m.z()));
            }
        }
    }
}

}  // namespace

long long take_solver_complaints() {
    return complaints.exchange(0);
}

GazeboModel::GazeboModel(physics::ModelPtr vehicle, const scenario::Scenario& scenario,
                         NextUpdate next)
    : vehicle_(std::move(vehicle)),
      world_(vehicle_->GetWorld()),
      engine_(world_->Physics()),
      mechanism_(plant::make_mechanism(scenario.airframe)),
      next_(std::move(next)) {
    const vehicle::Airframe& airframe = scenario.airframe;
    const auto link = [&](const char* part) {
        const std::string name = models::called(airframe, part);
        return require_there(*vehicle_, "link", name, vehicle_->GetLink(name));
    };
    links_[0] = link("base");
    check_engine(*engine_);
    dSetMessageHandler(&hear_ode);
    if (airframe.has_cup) {
        links_[1] = link("carriage");
        links_[2] = link("cup");
        slider_ = find_joint(*vehicle_, models::called(airframe, "slider"),
                             physics::Base::SLIDER_JOINT, "prismatic");
        for (const char* hinge : {"cup_pitch", "cup_yaw"}) {
            hinges_.push_back(find_hinge(*vehicle_, models::called(airframe, hinge)));
        }
        slider_->SetStiffnessDamping(0, 0.0, 0.0);
        slider_->SetLowerLimit(0, -kFree_m);
        slider_->SetUpperLimit(0, kFree_m);
        lip_F_m_ = {airframe.cup.lip_offset_m, 0.0, 0.0};
    }
    vehicle_->SetAutoDisable(false);
    engine_->GetContactManager()->SetNeverDropContacts(true);
    ray_ = boost::dynamic_pointer_cast<physics::RayShape>(
        engine_->CreateShape("ray", physics::CollisionPtr()));
    require(ray_ != nullptr, "ODE has rays");
    check_gravity_and_mass(*vehicle_, airframe.mass_kg);
    check_wall(*ray_, scenario);
    first_ = GazeboPlant::state_of(*vehicle_);
}

}  // namespace limpet::gazebo11
