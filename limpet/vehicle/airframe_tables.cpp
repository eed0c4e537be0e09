// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/airframe.hpp"

namespace limpet::vehicle {

const ParameterTable<RotorParameters>& rotor_table() {
    using P = RotorParameters;
    static const ParameterTable<P> table = {
        {"motor_constant_kg_m", "kg m", 1e-8, 1e-2, &P::motor_constant_kg_m,
         "thrust over speed squared, k_mot", "paper Table I"},
        {"moment_constant_m", "m", 0.0, 1.0, &P::moment_constant_m, "torque over thrust, k_mom",
         "paper Table I"},
        {"drag_constant_kg", "kg", 0.0, 1.0, &P::drag_constant_kg,
         "drag over rotor speed and cross wind, lambda_1", "paper Table I"},
        {"rolling_constant_kg_m", "kg m", 0.0, 1.0, &P::rolling_constant_kg_m,
         "rolling moment over rotor speed and cross wind, mu_1", "Gazebo motor model, Iris"},
        {"time_constant_up_s", "s", 1e-4, 1.0, &P::time_constant_up_s, "lag while speeding up",
         "Gazebo motor model, Iris"},
        {"time_constant_down_s", "s", 1e-4, 1.0, &P::time_constant_down_s, "lag while slowing down",
         "Gazebo motor model, Iris"},
        {"command_delay_s", "s", 0.0, 0.1, &P::command_delay_s,
         "dead time of the speed controller, rounded to whole ticks",
         "assumed: none, as in the Gazebo motor model"},
        {"speed_scale_rad_s", "rad/s", 1.0, 5000.0, &P::speed_scale_rad_s,
         "what command 1 adds to the offset", "assumed: hover at command 0.657"},
        {"speed_offset_rad_s", "rad/s", 0.0, 1000.0, &P::speed_offset_rad_s,
         "speed at command 0 while armed", "Gazebo motor model, Iris"},
        {"speed_max_rad_s", "rad/s", 1.0, 5000.0, &P::speed_max_rad_s,
         "upper limit of all commands", "assumed: 380 KV on a loaded 6S pack gives 768..830"},
        {"radius_m", "m", 0.01, 1.0, &P::radius_m, "radius of the propeller", "paper: 12x5.5 in"},
        {"height_m", "m", -0.5, 0.5, &P::height_m, "propeller planes above the centre of mass",
         "assumed: baseline.md"},
        {"axial_loss_speed_m_s", "m/s", 1.0, 1000.0, &P::axial_loss_speed_m_s,
         "axial wind at which the thrust is gone", "Gazebo motor model"},
        {"speed_follows_voltage", "switch", 0.0, 1.0, &P::speed_follows_voltage,
         "a speed controller without feedback: every command's speed is proportional to the "
         "battery's voltage under load, and holds at 3.7 V a cell; off: only the highest speed, "
         "below that voltage",
         "brushless motor: speed = KV x duty x voltage; Gazebo motor model: none"},
        {"motor_kv_rpm_V", "rpm/V", 0.0, 1e5, &P::motor_kv_rpm_V,
         "speed over voltage of the motor; 0: both time constants instead; else they are not used, "
         "the lag follows from KV, resistance, inertia and speed",
         "off; paper: 380"},
        {"motor_resistance_ohm", "ohm", 1e-3, 100.0, &P::motor_resistance_ohm,
         "of one motor's winding, speed controller and leads",
         "assumed: facts.md section 1, 0.10..0.25"},
        {"spin_inertia_kg_m2", "kg m^2", 1e-8, 1.0, &P::spin_inertia_kg_m2,
         "of a propeller and its motor's bell about the axis",
         "assumed: a 12 in carbon propeller's"},
        {"motor_brakes", "switch", 0.0, 1.0, &P::motor_brakes,
         "the speed controller brakes; off: a motor that is too fast runs down in the air",
         "assumed: damped or active freewheeling, as today's controllers do"},
    };
    return table;
}

const ParameterTable<Rotor>& rotor_place_table() {
    static const ParameterTable<Rotor> table = {
        {"x_m", "m", -5.0, 5.0, [](Rotor& r) -> double& { return r.p_B_m.x(); },
         "hub ahead of the centre of mass", "vehicle file"},
        {"y_m", "m", -5.0, 5.0, [](Rotor& r) -> double& { return r.p_B_m.y(); }, "hub right of it",
         "vehicle file"},
        {"below_m", "m", 0.0, 1.0, &Rotor::below_m,
         "propeller plane below rotor.height_m: the lower of a coaxial pair", "all in one plane"},
        {"thrust_share", "-", 0.05, 1.0, &Rotor::thrust_share,
         "of its thrust alone: what the wake of a rotor above it leaves; its torque stays",
         "none is in another's wake"},
    };
    return table;
}

const ParameterTable<SliderParameters>& slider_table() {
    using P = SliderParameters;
    static const ParameterTable<P> table = {
        {"stiffness_N_m", "N/m", 10.0, 1e5, &P::stiffness_N_m, "spring",
         "assumed: contact outlasts the 0.154 s that concrete needs, 300..800"},
        {"damping_N_s_m", "N s/m", 0.0, 1e4, &P::damping_N_s_m,
         "damper; too little and the rebound tears the cup off", "assumed: 25..45 attaches"},
        {"preload_N", "N", 0.0, 200.0, &P::preload_N, "of the spring against the outer stop",
         "assumed: baseline.md"},
        {"travel_m", "m", 1e-3, 0.5, &P::travel_m, "from stop to stop",
         "assumed: not used up at 1.2 m/s"},
        {"stop_stiffness_N_m", "N/m", 100.0, 1e6, &P::stop_stiffness_N_m, "of both bumpers",
         "assumed: soft bumper"},
        {"stop_damping_N_s_m", "N s/m", 0.0, 1e4, &P::stop_damping_N_s_m, "of both bumpers",
         "assumed: soft bumper"},
        {"mass_kg", "kg", 1e-3, 10.0, &P::mass_kg, "of the moving part without the cup",
         "assumed: baseline.md"},
    };
    return table;
}

const ParameterTable<CupMountParameters>& cup_mount_table() {
    using P = CupMountParameters;
    static const ParameterTable<P> table = {
        {"joint_x_m", "m", 0.0, 5.0, &P::joint_x_m, "joint ahead of the centre of mass, slider out",
         "assumed: clears the propeller tips at 0.357 m"},
        {"joint_z_m", "m", -1.0, 1.0, &P::joint_z_m, "joint below the centre of mass",
         "assumed: level with it"},
        {"lip_offset_m", "m", 1e-3, 0.5, &P::lip_offset_m, "lip plane ahead of the joint",
         "assumed: baseline.md, keep it within 0.04"},
        {"mass_offset_m", "m", 0.0, 0.5, &P::mass_offset_m,
         "the cup's centre of mass ahead of the joint",
         "assumed: fitting and yoke outweigh the rubber"},
        {"centring_stiffness_N_m_rad", "N m/rad", 0.0, 100.0, &P::centring_stiffness_N_m_rad,
         "of both hinges", "assumed: 0 lets the cup arrive tilted and slip"},
        {"centring_damping_N_m_s_rad", "N m s/rad", 0.0, 10.0, &P::centring_damping_N_m_s_rad,
         "of both hinges", "assumed: baseline.md"},
        {"range_deg", "deg", 1.0, 89.0, &P::range_deg, "of each hinge, either way",
         "assumed: perched at 66.5"},
        {"radius_m", "m", 5e-3, 0.5, &P::radius_m, "of the lip",
         "assumed: 80 mm carries 2.1 times the weight at 880 hPa"},
        {"mass_kg", "kg", 1e-3, 10.0, &P::mass_kg, "of the cup with its fitting",
         "assumed: baseline.md"},
    };
    return table;
}

const ParameterTable<LegParameters>& leg_table() {
    using P = LegParameters;
    static const ParameterTable<P> table = {
        {"tip_x_m", "m", -2.0, 2.0, &P::tip_x_m, "tips ahead of the centre of mass",
         "assumed: perched pitch of 66.5 deg"},
        {"tip_y_m", "m", 1e-3, 2.0, &P::tip_y_m, "half the distance of the tips",
         "assumed: baseline.md"},
        {"tip_z_m", "m", 1e-3, 2.0, &P::tip_z_m, "tips below the centre of mass",
         "assumed: perched pitch of 66.5 deg"},
        {"tip_radius_m", "m", 1e-3, 0.2, &P::tip_radius_m, "of the rubber ball on each tip",
         "assumed: a rubber foot"},
        {"friction", "-", 0.0, 5.0, &P::friction, "of the tips on the wall",
         "assumed: rubber on concrete"},
    };
    return table;
}

const ParameterTable<BatteryParameters>& battery_table() {
    using P = BatteryParameters;
    static const ParameterTable<P> table = {
        {"cells", "count", 1.0, 14.0, &P::cells, "in series", "paper: 6S"},
        {"capacity_Ah", "Ah", 0.1, 100.0, &P::capacity_Ah, "when full", "paper: 4000 mAh"},
        {"internal_resistance_ohm", "ohm", 0.0, 1.0, &P::internal_resistance_ohm,
         "of the whole pack", "assumed: 5 mohm a cell"},
        {"avionics_power_W", "W", 0.0, 500.0, &P::avionics_power_W,
         "companion computer, autopilot, sensors", "assumed: a small computer at half load"},
        {"pump_power_W", "W", 0.0, 500.0, &P::pump_power_W, "while the pump runs",
         "assumed: a 12 V diaphragm pump at 1 A"},
        {"drive_efficiency", "-", 0.1, 1.0, &P::drive_efficiency,
         "shaft power over electric power of motor and speed controller",
         "assumed: usual of such motors in hover"},
        {"initial_charge", "-", 0.0, 1.0, &P::initial_charge, "of the capacity at the start",
         "assumed: full"},
    };
    return table;
}

const ParameterTable<PayloadParameters>& payload_table() {
    using P = PayloadParameters;
    static const ParameterTable<P> table = {
        {"mass_kg", "kg", 0.0, 100.0, &P::mass_kg, "of the load on the cable; 0: none",
         "paper: none"},
        {"cable_length_m", "m", 0.05, 50.0, &P::cable_length_m, "under the payload's weight",
         "assumed"},
        {"cable_stretch_m", "m", 1e-4, 0.02, &P::cable_stretch_m,
         "of the cable under the payload's weight",
         "assumed: a metre of 1.5 mm nylon cord and 2 N"},
        {"cable_damping", "-", 0.0, 1.0, &P::cable_damping,
         "along the cable, share of the critical on a vehicle that is held", "assumed"},
        {"hook_x_m", "m", -2.0, 2.0, &P::hook_x_m,
         "where the cable is made fast, ahead of the centre of mass", "assumed: under it"},
        {"hook_y_m", "m", -2.0, 2.0, &P::hook_y_m, "to the right of it", "assumed: under it"},
        {"hook_z_m", "m", -2.0, 2.0, &P::hook_z_m, "below it", "assumed: the body's underside"},
        {"drag_area_m2", "m2", 0.0, 10.0, &P::drag_area_m2,
         "of the payload, drag coefficient times area",
         "assumed: a ball of 10 cm, c_d 0.5 (Hoerner, Fluid-dynamic drag)"},
        {"friction", "-", 0.0, 2.0, &P::friction, "of the payload on ground and wall", "assumed"},
    };
    return table;
}

const ParameterTable<Airframe>& airframe_table() {
    using A = Airframe;
    static const ParameterTable<A> table = {
        {"mass_kg", "kg", 0.01, 500.0, &A::mass_kg, "of the whole vehicle", "paper: 3.2 kg"},
        {"inertia_xx_kg_m2", "kg m2", 1e-6, 100.0,
         [](A& a) -> double& { return a.inertia_kg_m2.x(); },
         "of the whole vehicle about its centre of mass, roll", "assumed: build 0.035..0.06"},
        {"inertia_yy_kg_m2", "kg m2", 1e-6, 100.0,
         [](A& a) -> double& { return a.inertia_kg_m2.y(); }, "pitch", "assumed: build 0.09..0.11"},
        {"inertia_zz_kg_m2", "kg m2", 1e-6, 100.0,
         [](A& a) -> double& { return a.inertia_kg_m2.z(); }, "yaw", "assumed: build 0.13..0.15"},
        {"pump_x_m", "m", -5.0, 5.0, [](A& a) -> double& { return a.pump_B_m.x(); },
         "pump ahead of the centre of mass", "paper: at the rear, for balance; place assumed"},
        {"pump_z_m", "m", -5.0, 5.0, [](A& a) -> double& { return a.pump_B_m.z(); },
         "pump below the centre of mass", "assumed: under the rear plate"},
        {"lidar_x_m", "m", -5.0, 5.0, &A::lidar_x_m,
         "both range finders ahead of the centre of mass", "paper: on the front arms"},
        {"lidar_separation_m", "m", 1e-3, 5.0, &A::lidar_separation_m,
         "distance of the two, l of eq. (7)", "assumed: under the motors"},
        {"lidar_z_m", "m", -5.0, 5.0, &A::lidar_z_m, "both below the centre of mass",
         "assumed: level with it"},
    };
    return table;
}

}  // namespace limpet::vehicle
