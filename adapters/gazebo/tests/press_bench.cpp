// SPDX-License-Identifier: Apache-2.0
#include "press_bench.hpp"

#include <sdf/sdf.hh>

namespace limpet::gazebo11 {

std::string box_model(const std::string& name, const std::string& pose, const std::string& size,
                      bool is_static) {
    return "<model name='" + name + "'><static>" + (is_static ? "1" : "0") + "</static><pose>" +
           pose + "</pose><link name='link'><collision name='face'><geometry><box><size>" + size +
           "</size></box></geometry></collision></link></model>";
}

std::string plain_surface() {
    return "<surface><vacuum_pressure_Pa>60000</vacuum_pressure_Pa>"
           "<sealing_time_constant_s>0.2</sealing_time_constant_s>"
           "<unsealing_time_constant_s>0.5</unsealing_time_constant_s><friction>0.8</friction>"
           "<seal_threshold_median_N>20</seal_threshold_median_N>"
           "<seal_threshold_sigma>0</seal_threshold_sigma>"
           "<seal_tilt_median_deg>14</seal_tilt_median_deg>"
           "<seal_tilt_sigma_deg>0</seal_tilt_sigma_deg>"
           "<pump_ripple_Pa>0</pump_ripple_Pa></surface>";
}

std::string cup_settings(const std::string& attachment, const std::string& more) {
    return plain_surface() + "<attachment>" + attachment + "</attachment><pump>true</pump>" + more;
}

std::string bench_world(const std::string& gravity, const std::string& more,
                        const std::string& in_body, const std::string& engine) {
    return "<sdf version='1.6'><world name='bench'><gravity>" + gravity +
           "</gravity><physics type='" + engine +
           "'><max_step_size>0.001</max_step_size>"
           "<real_time_update_rate>0</real_time_update_rate></physics>" +
           box_model("wall", "1.05 0 0 0 0 0", "0.1 2 2") +
           "<model name='body'><pose>0.9 0 0 0 0 0</pose><link name='hull'><inertial><pose>-0.02 0 "
           "0 0 0 0</pose><mass>1</mass>"
           "<inertia><ixx>0.004</ixx><iyy>0.004</iyy><izz>0.004</izz></inertia></inertial>"
           "<collision name='hull'><geometry><box><size>0.1 0.08 0.08</size></box></geometry>"
           "</collision></link>" +
           in_body + "</model>" + more + "</world></sdf>";
}

sdf::ElementPtr plugin_element(const std::string& inside, const std::string& name) {
    sdf::SDFPtr text(new sdf::SDF());
    sdf::init(text);
    sdf::readString("<sdf version='1.6'><model name='m'><link name='l'/><plugin name='" + name +
                        "' filename='f'>" + inside + "</plugin></model></sdf>",
                    text);
    // The copy outlives the document.
    return text->Root()->GetElement("model")->GetElement("plugin")->Clone();
}

PressBench::PressBench(const std::string& plugin, const std::string& gravity,
                       const std::string& more, const std::string& engine)
    : server(bench_world(gravity, more, "", engine)), body(server.world()->ModelByName("body")) {
    cup.Load(body, plugin_element("<link>hull</link><lip_pose>0.06 0 0 0 0 0</lip_pose>" + plugin));
    on_update =
        gazebo::event::Events::ConnectWorldUpdateBegin([this](const gazebo::common::UpdateInfo&) {
            const double speed_m_s = body->WorldLinearVel().X();
            body->GetLinks().at(0)->AddForce(
                push_N - ignition::math::Vector3d(hand_N_s_m * speed_m_s, 0.0, 0.0));
        });
}

int PressBench::run_until(const std::function<bool()>& is_so, int limit) {
    for (int steps = 0; steps <= limit; ++steps) {
        if (is_so()) {
            return steps;
        }
        run(1);
    }
    return -1;
}

}  // namespace limpet::gazebo11
