// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <pugixml.hpp>
#include <string_view>

#include "limpet/compare/channels.hpp"
#include "limpet/compare/compare.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/record/story.hpp"

namespace limpet::compare {
namespace {

constexpr double kLeastRest_s = 1.0;
constexpr double kMillimetres = 1e3;

/// Masses of a body of MJCF and of all below it. Our models say each; none has to be worked out of
/// shapes, as MuJoCo would.
struct MassSum : pugi::xml_tree_walker {
    double mass_kg = 0.0;
    bool for_each(pugi::xml_node& node) override {
        if (std::string_view(node.name()) == "inertial") {
            mass_kg += node.attribute("mass").as_double();
        }
        return true;
    }
};

/// Weight of all that hangs on "base" [N].
double weight_N(const record::Recording& recording) {
    const mcap::Attachment* attached = recording.attachment("model.xml");
    pugi::xml_document model;
    if (attached == nullptr || !model.load_string(attached->text.c_str())) {
        return kNaN;
    }
    pugi::xml_node base = model.find_node([](const pugi::xml_node& node) {
        return std::string_view(node.name()) == "body" &&
               std::string_view(node.attribute("name").value()) == "base";
    });
    MassSum sum;
    return base && base.traverse(sum) ? sum.mass_kg * kGravity_m_s2 : kNaN;
}

/// The last rest but its first half.
std::optional<record::Window> settled(const record::Recording& recording) {
    std::optional<record::Window> window;
    for (const record::Phase& phase : phases(recording)) {
        if (phase.state == "resting" && phase.window.span_s() >= kLeastRest_s) {
            window = {0.5 * (phase.window.from_s + phase.window.to_s), phase.window.to_s};
        }
    }
    return window;
}

}  // namespace

std::optional<Rest> rest_of(const record::Recording& recording) {
    const auto window = settled(recording);
    const record::Table* truth = find_table(recording, "/truth/vehicle");
    const record::Table* wrench = find_table(recording, "/truth/cup_wrench");
    const record::Table* cup = find_table(recording, "/cup");
    const auto v =
        columns_of<8>(truth, {"roll_rad", "pitch_rad", "yaw_rad", "cup_pitch_rad", "cup_yaw_rad",
                              "slider_position_m", "legs_force_north_N", "legs_force_down_N"});
    const auto w = columns_of<3>(wrench, {"wrench.force.x", "wrench.force.y", "wrench.force.z"});
    const auto c = columns_of<2>(cup, {"pull_N", "shear_N"});
    // The three are written together: one row of each an instant.
    if (!window || v[0] == nullptr || w[0] == nullptr || c[0] == nullptr ||
        truth->time_s != wrench->time_s || truth->time_s != cup->time_s) {
        return std::nullopt;
    }
    Rest sum;
    double samples = 0.0;
    for (std::size_t i = 0; i < truth->time_s.size(); ++i) {
        if (!window->holds(truth->time_s[i])) {
            continue;
        }
        const auto at = [i](const record::Column* column) { return column->values[i]; };
        const Quaternion q_WB = quaternion_from_euler(
            {.roll_rad = at(v[0]), .pitch_rad = at(v[1]), .yaw_rad = at(v[2])});
        const Quaternion q_BC = Eigen::AngleAxisd(at(v[3]), Vector3::UnitY()) *
                                Eigen::AngleAxisd(at(v[4]), Vector3::UnitZ());
        const Vector3 cup_W =
            q_WB * q_BC * record::ros::flu_from_frd({at(w[0]), at(w[1]), at(w[2])});
        sum.pitch_deg += degrees(at(v[1]));
        sum.roll_deg += degrees(at(v[0]));
        sum.slider_mm += kMillimetres * at(v[5]);
        sum.cup_pull_N += at(c[0]);
        sum.cup_shear_N += at(c[1]);
        sum.hanging_load_N -= cup_W.z() + at(v[7]);
        sum.wall_push_N -= cup_W.x() + at(v[6]);
        samples += 1.0;
    }
    if (samples < 1.0) {
        return std::nullopt;
    }
    for (const RestNumber& number : kRestNumbers) {
        sum.*number.field /= samples;
    }
    sum.weight_N = weight_N(recording);
    return sum;
}

}  // namespace limpet::compare
