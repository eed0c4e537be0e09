// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "limpet/core/frames.hpp"
#include "limpet/core/parameters.hpp"
#include "limpet/core/rotor_list.hpp"

namespace limpet::vehicle {

/// Propeller and motor, the Gazebo motor model's parameters. Source: facts.md section 1, Table I.
struct RotorParameters {
    double motor_constant_kg_m = 2.5e-5;  ///< k_mot: thrust = k_mot w^2
    double moment_constant_m = 1.9e-2;    ///< k_mom: torque = k_mom thrust
    double drag_constant_kg = 8e-4;       ///< lambda_1: drag = lambda_1 w v across the axis
    double rolling_constant_kg_m = 1e-6;  ///< mu_1: rolling moment = mu_1 w v across the axis
    double time_constant_up_s = 0.0125;
    double time_constant_down_s = 0.025;
    double command_delay_s = 0.0;       ///< dead time of the speed controller, whole ticks
    double speed_scale_rad_s = 700.0;   ///< command 1 adds this to the offset
    double speed_offset_rad_s = 100.0;  ///< at command 0 while armed
    double speed_max_rad_s = 800.0;
    double radius_m = 0.1524;            ///< of the propeller, 12 in
    double height_m = 0.04;              ///< of the propeller planes above the centre of mass
    double axial_loss_speed_m_s = 25.0;  ///< thrust is gone at this speed along the axis
    bool speed_follows_voltage = false;  ///< at any command, not the highest speed alone
    /// A motor by its numbers (rotor.hpp) in the place of the time constants; KV 0: none.
    double motor_kv_rpm_V = 0.0;
    double motor_resistance_ohm = 0.15;  ///< winding, speed controller and leads, of one motor
    double spin_inertia_kg_m2 = 1e-4;    ///< propeller and bell
    bool motor_brakes = true;            ///< the speed controller slows it down as it speeds it up
    double nominal_voltage_V = 22.2;     ///< of the battery, at 3.7 V a cell; no row
    /// Of the air around to that of the constants above, all of which go with it; the
    /// environment's, no row.
    double density_ratio = 1.0;

    [[nodiscard]] double thrust_per_speed_2_kg_m() const {
        return motor_constant_kg_m * density_ratio;
    }

    friend bool operator==(const RotorParameters&, const RotorParameters&) = default;
};

/// Where one sits and which way it turns.
struct Rotor {
    Vector3 p_B_m = Vector3::Zero();  ///< hub; z is below_m - RotorParameters::height_m
    int direction = +1;               ///< +1: turns counter-clockwise seen from above
    double below_m = 0.0;             ///< the other propeller planes, as the lower of a pair is
    double thrust_share = 1.0;        ///< of its thrust alone: what the wake of one above leaves

    friend bool operator==(const Rotor&, const Rotor&) = default;
};

/// Spring slider between body and cup. Source: baseline.md.
struct SliderParameters {
    double stiffness_N_m = 500.0;
    double damping_N_s_m = 30.0;
    double preload_N = 5.0;  ///< of the spring against the outer stop
    double travel_m = 0.090;
    double stop_stiffness_N_m = 2e4;  ///< of both stops
    double stop_damping_N_s_m = 100.0;
    double mass_kg = 0.10;

    friend bool operator==(const SliderParameters&, const SliderParameters&) = default;
};

/// Joint with two degrees of freedom and the cup's body. Lip and seal are in suction/.
struct CupMountParameters {
    double joint_x_m = 0.46;      ///< joint ahead of the centre of mass
    double joint_z_m = 0.0;       ///< below it
    double lip_offset_m = 0.04;   ///< lip plane ahead of the joint
    double mass_offset_m = 0.01;  ///< the cup's own centre of mass ahead of the joint
    double centring_stiffness_N_m_rad = 0.3;
    double centring_damping_N_m_s_rad = 0.02;
    double range_deg = 85.0;  ///< of each hinge, either way
    double radius_m = 0.04;
    double mass_kg = 0.10;

    friend bool operator==(const CupMountParameters&, const CupMountParameters&) = default;
};

/// Two legs that limit the pitch when perched.
struct LegParameters {
    double tip_x_m = -0.05;
    double tip_y_m = 0.15;  ///< half their distance
    double tip_z_m = 0.25;
    double tip_radius_m = 0.012;
    double friction = 0.8;

    friend bool operator==(const LegParameters&, const LegParameters&) = default;
};

struct BatteryParameters {
    int cells = 6;
    double capacity_Ah = 4.0;
    double internal_resistance_ohm = 0.03;
    double avionics_power_W = 12.0;  ///< companion computer, autopilot, sensors
    double pump_power_W = 12.0;
    double drive_efficiency = 0.75;  ///< motor and speed controller: shaft power / electric power
    double initial_charge = 1.0;     ///< 0..1

    friend bool operator==(const BatteryParameters&, const BatteryParameters&) = default;
};

/// What hangs below the vehicle on a cable; by default nothing does.
struct PayloadParameters {
    double mass_kg = 0.0;  ///< 0: there is none
    double cable_length_m = 1.0;
    double cable_stretch_m = 1e-3;  ///< under the payload's weight
    double cable_damping = 0.1;     ///< along the cable, share of the critical
    double hook_x_m = 0.0;          ///< where the cable is made fast, in B
    double hook_y_m = 0.0;
    double hook_z_m = 0.05;
    double drag_area_m2 = 0.004;  ///< c_d A
    double friction = 0.5;        ///< on ground and wall

    friend bool operator==(const PayloadParameters&, const PayloadParameters&) = default;
};

/// Mass of one body, with the slider at its outer stop and the joint centred.
struct BodyInertia {
    double mass_kg = 0.0;
    Vector3 centre_B_m = Vector3::Zero();
    Matrix3 inertia_kg_m2 = Matrix3::Zero();  ///< about the body's own centre, axes of B
};

/// The bodies of a vehicle as a CAD program gives them; names and looks come with
/// limpet/models/cad_model.hpp.
struct CadBodies {
    virtual ~CadBodies() = default;
    BodyInertia base;
    BodyInertia carriage;
    BodyInertia cup_yoke;
    BodyInertia cup;
};
/// Yoke and cup as one body.
[[nodiscard]] BodyInertia cup_with_yoke(const CadBodies& bodies);

/// The numbers of a vehicle. Positions are in B: origin at the centre of mass of the whole vehicle
/// with the slider at its outer stop, forward-right-down.
struct AirframeNumbers {
    bool has_cup = true;   ///< slider, joint, cup, legs and pump; a plain multirotor has none
    double mass_kg = 3.2;  ///< of the whole vehicle
    Vector3 inertia_kg_m2 = {0.05, 0.10, 0.14};  ///< of the whole vehicle about B, diagonal
    Vector3 pump_B_m = {-0.16, 0.0, 0.03};
    RotorList<Rotor> rotors = {{{0.205, 0.205, -0.04}, +1},
                               {{-0.205, -0.205, -0.04}, +1},
                               {{0.205, -0.205, -0.04}, -1},
                               {{-0.205, 0.205, -0.04}, -1}};
    RotorParameters rotor;
    SliderParameters slider;
    CupMountParameters cup;
    LegParameters legs;
    BatteryParameters battery;
    PayloadParameters payload;
    double lidar_x_m = 0.205;          ///< both LiDARs on the front arms
    double lidar_separation_m = 0.41;  ///< l of eq. (7)
    double lidar_z_m = 0.0;

    friend bool operator==(const AirframeNumbers&, const AirframeNumbers&) = default;
};

/// ONE description of a vehicle, from which MJCF, SDF and URDF are made.
struct Airframe : AirframeNumbers {
    std::string name = "perching_uav";
    std::string description;
    /// Bodies as a CAD program gives them, else null: then they are made of the numbers. Masses,
    /// inertias and the cup's joint of the numbers are the same as its.
    std::shared_ptr<const CadBodies> cad{};

    friend bool operator==(const Airframe&, const Airframe&) = default;
};

/// What the rotors carry: the vehicle and what hangs on it.
[[nodiscard]] double carried_mass_kg(const AirframeNumbers& airframe);
/// Rotors as many as would lift alike if nothing were in another's wake.
[[nodiscard]] double lifting_rotors(const AirframeNumbers& airframe);
/// From the centre of mass to the furthest hub.
[[nodiscard]] double hubs_reach_m(const AirframeNumbers& airframe);

/// Tables behind the YAML sections `rotor`, `slider`, `cup`, `legs`, `battery`, `payload` of a
/// vehicle file.
[[nodiscard]] const ParameterTable<RotorParameters>& rotor_table();
/// Of an item of the list `rotors`, besides its direction.
[[nodiscard]] const ParameterTable<Rotor>& rotor_place_table();
[[nodiscard]] const ParameterTable<SliderParameters>& slider_table();
[[nodiscard]] const ParameterTable<CupMountParameters>& cup_mount_table();
[[nodiscard]] const ParameterTable<LegParameters>& leg_table();
[[nodiscard]] const ParameterTable<BatteryParameters>& battery_table();
[[nodiscard]] const ParameterTable<PayloadParameters>& payload_table();
/// Numbers of the airframe itself: mass_kg, inertia_xx_kg_m2, lidar_x_m, ...
[[nodiscard]] const ParameterTable<Airframe>& airframe_table();

/// Pitch at which the leg tips and a lip that lies flat meet a vertical wall.
[[nodiscard]] double pitch_on_legs_rad(const Airframe& airframe);

/// @throws InputError when the parts do not make a body: the base's share of mass or inertia is not
///         positive or breaks the triangle inequality, two rotors in one place or at one x and y
///         that turn alike
void validate(const Airframe& airframe);

/// @param what  for the message: "base"
/// @throws InputError unless some real body has this mass and inertia
void require_physical(const std::string& what, double mass_kg, const Matrix3& inertia_kg_m2);

/// What is left for the base when slider and cup are taken out of the whole. Diagonal when the
/// joint is level with the centre of mass.
[[nodiscard]] BodyInertia base_inertia(const Airframe& airframe);
/// A slender rod of twice the travel, behind the joint.
[[nodiscard]] BodyInertia carriage_inertia(const Airframe& airframe);
/// A solid disc of the cup's radius, as thick as the lip is ahead of the joint.
[[nodiscard]] BodyInertia cup_inertia(const Airframe& airframe);

/// Spring, damper and two stops of a joint, see joint_law.hpp. [N/m or N m/rad, N s/m or N m s/rad,
/// m or rad]
template <class T>
struct JointLawOf {
    T stiffness{};
    T damping{};
    T rest{};  ///< where the spring is slack
    T lower{};
    T upper{};
    T stop_stiffness{};
    T stop_damping{};
};
using JointLaw = JointLawOf<double>;
/// The slider: > 0 extends, 0 at the outer stop. The rest beyond that is the pre-load.
[[nodiscard]] JointLaw slider_law(const SliderParameters& slider);
/// Either hinge of the cup; its end is a rubber bumper.
[[nodiscard]] JointLaw hinge_law(const CupMountParameters& mount);

// A leg's tip on a wall or the ground: as MuJoCo's contact of time constant 4 ms and damping ratio
// 1 (models/mjcf_writer.cpp) on the 1.5 kg that a leg carries: k = m / (0.95 * 0.004)^2, d = 2 m /
// (0.95 * 0.004).
inline constexpr double kTipStiffness_N_m = 1e5;
inline constexpr double kTipDamping_N_s_m = 800.0;

// How large the numbers of a vehicle are by its mass and size: for what has not been measured.

/// Principal moments of inertia that a vehicle of this mass and reach has. Of multirotors from 27 g
/// to 11 kg I/(m r^2), r from the centre of mass to the furthest hub, is 0.18 to 0.35 in roll and
/// pitch and 0.3 to 0.6 in yaw; what stands out ahead, as a cup on its slider, adds to pitch and
/// yaw.
/// @return [kg m^2], roll, pitch, yaw
[[nodiscard]] Vector3 usual_inertia_kg_m2(const AirframeNumbers& airframe);

/// @param inertia_kg_m2  about one axis
/// @param axis           0 roll, 1 pitch, 2 yaw
/// @param factor         how far from usual_inertia_kg_m2() is allowed, > 1
[[nodiscard]] bool is_plausible_inertia(const AirframeNumbers& airframe, double inertia_kg_m2,
                                        int axis, double factor);

}  // namespace limpet::vehicle
