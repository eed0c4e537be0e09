// SPDX-License-Identifier: Apache-2.0
#include "channels.hpp"

#include <cmath>

namespace limpet::python {
namespace {

const CupStatus& cup(const Flight& flight) {
    return flight.truth().cup_status;
}
const Kinematics& base(const Flight& flight) {
    return flight.truth().base;
}
Euler euler(const Flight& flight) {
    return euler_from_quaternion(base(flight).q_WF);
}
Euler estimated(const Flight& flight) {
    return euler_from_quaternion(flight.estimate().q_WB);
}
/// Believed velocity along the believed heading and right of it.
double along(const Flight& flight, double forward, double right) {
    const Vector3& v_W = flight.estimate().v_WB_m_s;
    const double yaw = estimated(flight).yaw_rad;
    return forward * (std::cos(yaw) * v_W.x() + std::sin(yaw) * v_W.y()) +
           right * (std::cos(yaw) * v_W.y() - std::sin(yaw) * v_W.x());
}
double yes(bool is) {
    return is ? 1.0 : 0.0;
}
template <std::size_t kRotor>
double rotor(const Flight& flight) {
    return flight.rotors().command[kRotor];
}

}  // namespace

const std::vector<Channel>& channel_table() {
    using F = const Flight&;
    static const std::vector<Channel> table = {
        {"time_s", "time", [](F f) { return f.time_s(); }},
        {"north_m", "position of B, north", [](F f) { return base(f).p_WF_m.x(); }},
        {"east_m", "east", [](F f) { return base(f).p_WF_m.y(); }},
        {"down_m", "down", [](F f) { return base(f).p_WF_m.z(); }},
        {"velocity_north_m_s", "velocity", [](F f) { return base(f).v_WF_W_m_s.x(); }},
        {"velocity_east_m_s", "", [](F f) { return base(f).v_WF_W_m_s.y(); }},
        {"velocity_down_m_s", "", [](F f) { return base(f).v_WF_W_m_s.z(); }},
        {"roll_rad", "attitude", [](F f) { return euler(f).roll_rad; }},
        {"pitch_rad", "nose up positive", [](F f) { return euler(f).pitch_rad; }},
        {"yaw_rad", "heading", [](F f) { return euler(f).yaw_rad; }},
        {"rate_roll_rad_s", "angular velocity in B", [](F f) { return base(f).w_WF_F_rad_s.x(); }},
        {"rate_pitch_rad_s", "", [](F f) { return base(f).w_WF_F_rad_s.y(); }},
        {"rate_yaw_rad_s", "", [](F f) { return base(f).w_WF_F_rad_s.z(); }},
        {"cup_pressure_Pa", "in the cup, absolute", [](F f) { return cup(f).pressure_Pa; }},
        {"cup_phase", "0 free, 1 touching, 2 sealing, 3 attached, 4 unsealing",
         [](F f) { return static_cast<double>(cup(f).phase); }},
        {"cup_pull_N", "> 0 pulls the vehicle off", [](F f) { return cup(f).pull_N; }},
        {"cup_shear_N", "along the wall", [](F f) { return cup(f).shear_N; }},
        {"cup_peel_N_m", "tilting moment", [](F f) { return cup(f).peel_N_m; }},
        {"cup_pull_margin_N", "to spare", [](F f) { return cup(f).pull_margin_N; }},
        {"pump_running", "0, 1", [](F f) { return yes(cup(f).pump_running); }},
        {"valve_open", "0, 1", [](F f) { return yes(cup(f).valve_open); }},
        {"slider_m", "< 0 compressed", [](F f) { return f.truth().slider.position_m; }},
        {"slider_force_N", "< 0 pressed", [](F f) { return f.truth().slider.force_N; }},
        {"legs_force_N", "of the wall on the legs",
         [](F f) { return f.truth().legs_force_W_N.norm(); }},
        {"thrust_N", "of all rotors", [](F f) { return f.truth().thrust_N; }},
        {"battery_remaining", "0..1", [](F f) { return f.truth().battery.remaining; }},
        {"estimated_north_m", "what the autopilot believes",
         [](F f) { return f.estimate().p_WB_m.x(); }},
        {"estimated_east_m", "", [](F f) { return f.estimate().p_WB_m.y(); }},
        {"estimated_down_m", "", [](F f) { return f.estimate().p_WB_m.z(); }},
        {"estimated_velocity_forward_m_s", "along the estimated heading",
         [](F f) { return along(f, 1.0, 0.0); }},
        {"estimated_velocity_right_m_s", "right of it", [](F f) { return along(f, 0.0, 1.0); }},
        {"estimated_velocity_down_m_s", "", [](F f) { return f.estimate().v_WB_m_s.z(); }},
        {"estimated_roll_rad", "", [](F f) { return estimated(f).roll_rad; }},
        {"estimated_pitch_rad", "", [](F f) { return estimated(f).pitch_rad; }},
        {"estimated_yaw_rad", "", [](F f) { return estimated(f).yaw_rad; }},
        {"estimated_rate_pitch_rad_s", "in B", [](F f) { return f.estimate().w_WB_B_rad_s.y(); }},
        {"measured_force_N", "of the force sensor",
         [](F f) { return f.readings().force.value.axial_N; }},
        {"measured_cup_pressure_Pa", "of the pressure sensor",
         [](F f) { return f.readings().cup_pressure.value.pressure_Pa; }},
        {"lidar_left_m", "0: no echo",
         [](F f) { return f.readings().lidar_left.value.distance_m; }},
        {"lidar_right_m", "0: no echo",
         [](F f) { return f.readings().lidar_right.value.distance_m; }},
        {"rotor_command_0", "0..1 in the order of the vehicle file", rotor<0>},
        {"rotor_command_1", "", rotor<1>},
        {"rotor_command_2", "", rotor<2>},
        {"rotor_command_3", "", rotor<3>},
        {"rotor_command_4", "0: there is none", rotor<4>},
        {"rotor_command_5", "", rotor<5>},
        {"rotor_command_6", "", rotor<6>},
        {"rotor_command_7", "", rotor<7>},
        {"rotor_command_8", "", rotor<8>},
        {"rotor_command_9", "", rotor<9>},
        {"rotor_command_10", "", rotor<10>},
        {"rotor_command_11", "", rotor<11>},
    };
    return table;
}

std::size_t channel_index(const std::string& name) {
    const auto& table = channel_table();
    std::string names;
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (name == table[i].name) {
            return i;
        }
        names += std::string(names.empty() ? "" : ", ") + table[i].name;
    }
    throw py::key_error("\"" + name + "\": no channel; there are " + names);
}

void ChannelLog::sample(const Flight& flight) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        columns[i].push_back(channel_table()[i].of(flight));
    }
}

}  // namespace limpet::python
