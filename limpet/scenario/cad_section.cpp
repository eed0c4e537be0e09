// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/models/cad_model.hpp"
#include "limpet/scenario/parts.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace limpet::scenario {
namespace {

namespace fs = std::filesystem;

constexpr double kSameShare = 0.01;  // of masses and inertias
constexpr double kSameLength_m = 1e-3;

/// Reads the names of one kind and sees that the URDF has them.
/// @param all  its links or its joints
template <class All>
void read_names(const YamlNode& model, const char* section, const char* kind,
                const std::vector<std::string_view>& parts, const models::UrdfRobot& robot,
                const All& all, models::CadNames& names) {
    const YamlNode* node = model.find(section);
    if (is_section(node)) {
        check_keys(*node, parts);
    }
    for (const std::string_view part : parts) {
        const YamlNode* given = is_section(node) ? node->find(part) : nullptr;
        const std::string name = given != nullptr ? read_text(*given) : std::string(part);
        if (find_named(all, name) == nullptr) {
            fail(given != nullptr ? *given : model,
                 fmt::format("{}: there is no {} \"{}\" for the {}, there are: {}", robot.file,
                             kind, shown(name), part, listed(names_of(all))));
        }
        names.emplace(part, name);
    }
}

std::shared_ptr<const models::CadModel> load_model(const YamlNode& model, const fs::path& folder,
                                                   bool has_cup) {
    if (!is_section(&model)) {
        fail(model, "is empty, needs urdf");
    }
    check_keys(model, {"urdf", "links", "joints"});
    const YamlNode* urdf = model.find("urdf");
    if (urdf == nullptr) {
        fail(model, "needs urdf, the path of a URDF");
    }
    const fs::path file = folder / read_text(*urdf);
    if (!is_file(file)) {
        fail(*urdf, fmt::format("there is no file {}", shown_path(file)));
    }
    models::UrdfRobot robot = models::read_urdf(shown_path(file));
    models::CadNames names;
    std::vector<std::string_view> links = {"base"};
    if (has_cup) {
        links.insert(links.end(), {"carriage", "cup_yoke", "cup"});
    }
    read_names(model, "links", "link", links, robot, robot.links, names);
    if (has_cup) {
        read_names(model, "joints", "joint", {"slider", "cup_pitch", "cup_yaw"}, robot,
                   robot.joints, names);
    } else if (model.find("joints") != nullptr) {
        fail(*model.find("joints"), "has_cup is false: no joint is needed");
    }
    return std::make_shared<const models::CadModel>(
        make_cad_model(robot, fs::absolute(file).lexically_normal().string(), names, has_cup));
}

/// A number that follows from the model.
struct Following {
    const char* section;  ///< of the vehicle file, "" its top
    const char* key;
    double value;
    double* into;
    double tolerance;
};

std::vector<Following> following(const models::CadModel& cad, vehicle::Airframe& airframe) {
    const auto share = [](double value) { return kSameShare * std::abs(value); };
    std::vector<Following> all = {
        {"", "mass_kg", cad.mass_kg, &airframe.mass_kg, share(cad.mass_kg)}};
    const char* axes[] = {"xx", "yy", "zz"};
    for (int i = 0; i < 3; ++i) {
        all.push_back({"inertia_kg_m2", axes[i], cad.inertia_kg_m2[i], &airframe.inertia_kg_m2[i],
                       share(cad.inertia_kg_m2[i])});
    }
    if (!airframe.has_cup) {
        return all;
    }
    const vehicle::BodyInertia cup = cup_with_yoke(cad);
    all.push_back({"slider", "mass_kg", cad.carriage.mass_kg, &airframe.slider.mass_kg,
                   share(cad.carriage.mass_kg)});
    all.push_back({"cup", "mass_kg", cup.mass_kg, &airframe.cup.mass_kg, share(cup.mass_kg)});
    all.push_back({"cup", "joint_x_m", cad.joint_B_m.x(), &airframe.cup.joint_x_m, kSameLength_m});
    all.push_back({"cup", "joint_z_m", cad.joint_B_m.z(), &airframe.cup.joint_z_m, kSameLength_m});
    all.push_back({"cup", "mass_offset_m", cup.centre_B_m.x() - cad.joint_B_m.x(),
                   &airframe.cup.mass_offset_m, kSameLength_m});
    return all;
}

/// Where a number is written: in its section, for inertias also as an item of a list.
const YamlNode* written(const YamlNode& vehicle, const Following& one) {
    if (*one.section == '\0') {
        return vehicle.find(one.key);
    }
    const YamlNode* section = vehicle.find(one.section);
    if (section == nullptr || section->kind != YamlNode::Kind::list) {
        return section == nullptr ? nullptr : section->find(one.key);
    }
    const std::size_t item = std::string_view("xyz").find(one.key[0]);
    return item < section->children.size() ? &section->children[item] : nullptr;
}

}  // namespace

void read_model(const YamlNode& vehicle, const fs::path& folder, vehicle::Airframe& airframe) {
    if (const YamlNode* model = vehicle.find("model")) {
        airframe.cad = load_model(*model, folder, airframe.has_cup);
    }
    const models::CadModel* const cad = models::cad_of(airframe);
    if (cad == nullptr) {
        return;
    }
    for (const Following& one : following(*cad, airframe)) {
        const YamlNode* node = written(vehicle, one);
        if (node != nullptr && !(std::abs(*one.into - one.value) <= one.tolerance)) {
            fail(*node, fmt::format("{} differs from {:.6g} of {}, leave it out",
                                    number_text(*one.into), one.value, shown_path(cad->file)));
        }
        *one.into = one.value;
    }
    if (airframe.has_cup && !(std::abs(cad->joint_B_m.y()) <= kSameLength_m)) {
        throw InputError(
            fmt::format("{}: the cup's joint is {:.4g} m to the right of the centre "
                        "of mass, must be ahead of it within {} m",
                        shown_path(cad->file), cad->joint_B_m.y(), kSameLength_m));
    }
}

}  // namespace limpet::scenario
