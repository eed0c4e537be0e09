// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/cad_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "limpet/core/errors.hpp"
#include "limpet/models/model_text.hpp"

namespace limpet::models {

namespace {

using model_text::flu;

constexpr double kSamePlace_m = 1e-3;
constexpr double kSameAxis = 1e-3;  // rad

/// A joint of the perching: what hangs on it is a new body.
struct Role {
    std::string_view part;  ///< our name of the joint
    std::string_view from;
    std::string_view body;  ///< that it carries
    bool slides = false;
    int axis = 0;  ///< of the base's, x forward, y left, z up
    bool either_way = false;
};

constexpr std::array kRoles = {Role{"slider", "base", "carriage", true, 0, false},
                               Role{"cup_pitch", "carriage", "cup_yoke", false, 1, true},
                               Role{"cup_yaw", "cup_yoke", "cup", false, 2, true}};

/// A link in its place: frame in the base link's, and the body that it moves with.
struct PlacedLink {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    std::string_view body;
};
using Placed = std::map<std::string, PlacedLink>;

Eigen::Isometry3d isometry(const Vector3& p_m, const Quaternion& q) {
    return Eigen::Translation3d(p_m) * q;
}

std::string root_of(const UrdfRobot& robot) {
    std::string root;
    for (const UrdfLink& link : robot.links) {
        const bool hangs = std::any_of(robot.joints.begin(), robot.joints.end(),
                                       [&](const UrdfJoint& j) { return j.child == link.name; });
        if (hangs) {
            continue;
        }
        if (!root.empty()) {
            throw InputError(
                fmt::format("{}: link \"{}\" hangs on no joint, and \"{}\" neither: "
                            "only one may",
                            link.place, link.name, root));
        }
        root = link.name;
    }
    if (root.empty()) {
        throw InputError(robot.file + ": every link hangs on another: there is no first one");
    }
    return root;
}

const Role* role_of(const UrdfJoint& joint, const CadNames& names, bool has_cup) {
    for (const Role& role : kRoles) {
        if (has_cup && joint.name == called(names, role.part)) {
            return &role;
        }
    }
    return nullptr;
}

void check_kind(const UrdfJoint& joint, const Role& role, std::string_view from) {
    const bool turns = joint.type == "revolute" || joint.type == "continuous";
    if (role.slides ? joint.type != "prismatic" : !turns) {
        throw InputError(fmt::format("{}: joint \"{}\" is {}, the {} must be {}", joint.place,
                                     joint.name, joint.type, role.part,
                                     role.slides ? "prismatic" : "revolute or continuous"));
    }
    if (from != role.from) {
        throw InputError(fmt::format("{}: joint \"{}\" hangs on the {}, the {} must hang on the {}",
                                     joint.place, joint.name, from, role.part, role.from));
    }
}

Placed place_links(const UrdfRobot& robot, const CadNames& names, bool has_cup) {
    Placed placed;
    placed[root_of(robot)] = {Eigen::Isometry3d::Identity(), "base"};
    for (bool grew = true; grew;) {  // parents may stand after their children
        grew = false;
        for (const UrdfJoint& joint : robot.joints) {
            const auto parent = placed.find(joint.parent);
            if (parent == placed.end() || placed.count(joint.child) > 0) {
                continue;
            }
            const Role* role = role_of(joint, names, has_cup);
            if (role != nullptr) {
                check_kind(joint, *role, parent->second.body);
            }
            placed[joint.child] = {parent->second.pose * isometry(joint.p_m, joint.q),
                                   role != nullptr ? role->body : parent->second.body};
            grew = true;
        }
    }
    for (const UrdfLink& link : robot.links) {
        if (placed.count(link.name) == 0) {
            throw InputError(
                fmt::format("{}: link \"{}\" hangs in a ring of joints", link.place, link.name));
        }
    }
    return placed;
}

/// Everything seen from the base link, in its axes.
void turn_to_base(Placed& placed, const std::string& base) {
    const Eigen::Isometry3d to_base = placed.at(base).pose.inverse();
    for (auto& [name, link] : placed) {
        link.pose = to_base * link.pose;
    }
}

void check_links(const UrdfRobot& robot, const CadNames& names, const Placed& placed,
                 bool has_cup) {
    for (const std::string_view part : {"base", "carriage", "cup_yoke", "cup"}) {
        const std::string name = called(names, part);
        if ((has_cup || part == "base") && placed.at(name).body != part) {
            throw InputError(fmt::format("{}: link \"{}\" moves with the {}, must be the {}",
                                         robot.link(name)->place, name, placed.at(name).body,
                                         part));
        }
    }
}

void check_axes(const UrdfRobot& robot, const CadNames& names, const Placed& placed) {
    for (const Role& role : kRoles) {
        const UrdfJoint& joint = *robot.joint(called(names, role.part));
        const Vector3 axis = placed.at(joint.child).pose.linear() * joint.axis;
        const Vector3 wanted = Vector3::Unit(role.axis);
        const double along = role.either_way ? std::abs(axis.dot(wanted)) : axis.dot(wanted);
        if (!(along > std::cos(kSameAxis))) {
            throw InputError(fmt::format(
                "{}: joint \"{}\" has the axis {:.4g} {:.4g} {:.4g} in the base, the {} must have "
                "{:.4g} {:.4g} {:.4g}{}",
                joint.place, joint.name, axis.x(), axis.y(), axis.z(), role.part, wanted.x(),
                wanted.y(), wanted.z(), role.either_way ? ", either way" : ""));
        }
    }
}

/// @return where the hinges cross, in the base link's frame
Vector3 crossing(const UrdfRobot& robot, const CadNames& names, const Placed& placed) {
    Vector3 pitch = placed.at(robot.joint(called(names, "cup_pitch"))->child).pose.translation();
    const UrdfJoint& yaw_joint = *robot.joint(called(names, "cup_yaw"));
    const Vector3 yaw = placed.at(yaw_joint.child).pose.translation();
    if (!((yaw - pitch).norm() <= kSamePlace_m)) {
        throw InputError(
            fmt::format("{}: joint \"{}\" is {:.4g} m off joint \"{}\", the hinges "
                        "must cross within {} m",
                        yaw_joint.place, yaw_joint.name, (yaw - pitch).norm(),
                        called(names, "cup_pitch"), kSamePlace_m));
    }
    return pitch;
}

/// Mass, centre and inertia of what moves together, in the base link's frame and axes.
vehicle::BodyInertia gather(const UrdfRobot& robot, const Placed& placed, std::string_view body) {
    vehicle::BodyInertia sum;
    Vector3 moment_kg_m = Vector3::Zero();
    Matrix3 about_origin = Matrix3::Zero();
    for (const UrdfLink& link : robot.links) {
        const PlacedLink& at = placed.at(link.name);
        if (at.body != body && !body.empty()) {
            continue;
        }
        const Vector3 centre_m = at.pose * link.centre_m;
        const Matrix3 arm = skew(centre_m);
        sum.mass_kg += link.mass_kg;
        moment_kg_m += link.mass_kg * centre_m;
        about_origin += at.pose.linear() * link.inertia_kg_m2 * at.pose.linear().transpose() -
                        link.mass_kg * arm * arm;
    }
    if (!(sum.mass_kg > 0.0)) {
        throw InputError(fmt::format("{}: the links that move with the {} have no mass", robot.file,
                                     body.empty() ? "vehicle" : body));
    }
    sum.centre_B_m = moment_kg_m / sum.mass_kg;
    const Matrix3 arm = skew(sum.centre_B_m);
    sum.inertia_kg_m2 = about_origin + sum.mass_kg * arm * arm;
    return sum;
}

/// To forward-right-down about the whole vehicle's centre of mass.
vehicle::BodyInertia in_B(vehicle::BodyInertia body, const Vector3& centre_m) {
    body.centre_B_m = flu(Vector3(body.centre_B_m - centre_m));
    body.inertia_kg_m2 = flu(body.inertia_kg_m2);
    return body;
}

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Names of meshes in a recording: as their files are called, each file another one, whichever its
/// folder and however a file system takes capitals.
class RecordedNames {
public:
    std::string of(const std::filesystem::path& file) {
        const auto [at, added] = names_.try_emplace(file.string());
        if (added) {
            const bool stl = lower_case(file.extension().string()) == ".stl";
            const std::string ending = stl ? file.extension().string() : ".stl";
            const std::string stem = file.stem().string();
            at->second = stem + ending;
            for (int n = 2; !taken_.insert(lower_case(at->second)).second; ++n) {
                at->second = fmt::format("{}_{}{}", stem, n, ending);
            }
        }
        return at->second;
    }

private:
    std::map<std::string, std::string> names_;
    std::set<std::string> taken_;
};

void draw_parts(CadModel& cad, const UrdfRobot& robot, const Placed& placed,
                const Vector3& centre_m) {
    RecordedNames mesh_names;
    for (const UrdfLink& link : robot.links) {
        const PlacedLink& at = placed.at(link.name);
        int number = 0;
        for (Part part : link.visuals) {
            const Eigen::Isometry3d pose = at.pose * isometry(part.p_F_m, part.q_F);
            const Vector3 p_B_m = flu(Vector3(pose.translation() - centre_m));
            part.name = link.name + "_visual";
            if (++number > 1) {
                part.name += fmt::format("_{}", number);
            }
            part.body = at.body;
            part.p_F_m = at.body == "base" ? p_B_m : Vector3(p_B_m - cad.joint_B_m);
            part.q_F = flu(Quaternion(pose.linear()));
            if (part.shape == Shape::mesh) {
                const std::filesystem::path file = part.mesh_file;
                part.mesh_name = mesh_names.of(file);
                part.own_colours = !part.rgba && lower_case(file.extension().string()) != ".stl";
            }
            part.rgba = part.rgba.value_or(std::array<double, 4>{0.75, 0.75, 0.76, 1.0});
            cad.parts.push_back(std::move(part));
        }
    }
}

}  // namespace

std::string called(const CadNames& names, std::string_view part) {
    const auto given = names.find(part);
    return given == names.end() ? std::string(part) : given->second;
}

CadModel make_cad_model(const UrdfRobot& robot, const std::string& file, const CadNames& names,
                        bool has_cup) {
    Placed placed = place_links(robot, names, has_cup);
    turn_to_base(placed, called(names, "base"));
    check_links(robot, names, placed, has_cup);
    const vehicle::BodyInertia whole = gather(robot, placed, "");
    const auto body = [&](std::string_view part) {
        return in_B(gather(robot, placed, part), whole.centre_B_m);
    };
    CadModel cad;
    cad.file = file;
    cad.names = names;
    cad.mass_kg = whole.mass_kg;
    cad.inertia_kg_m2 = whole.inertia_kg_m2.diagonal();
    cad.base = body("base");
    if (has_cup) {
        check_axes(robot, names, placed);
        cad.joint_B_m = flu(Vector3(crossing(robot, names, placed) - whole.centre_B_m));
        cad.carriage = body("carriage");
        cad.cup_yoke = body("cup_yoke");
        cad.cup = body("cup");
    }
    draw_parts(cad, robot, placed, whole.centre_B_m);
    return cad;
}

}  // namespace limpet::models
