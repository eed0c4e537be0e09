// SPDX-License-Identifier: Apache-2.0
#include "limpet/vehicle/airframe.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <set>

#include "limpet/core/errors.hpp"
#include "limpet/vehicle/joint_law.hpp"
#include "tests/core/whole_table.hpp"

namespace limpet::vehicle {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(BaseInertia, IsWhatSliderAndCupLeaveByHand) {
    const BodyInertia base = base_inertia(Airframe{});
    EXPECT_NEAR(base.mass_kg, 3.0, 1e-12);
    // carriage 0.1 kg at 0.46 - 0.09, cup 0.1 kg at 0.46 + 0.01: -(0.037 + 0.047) / 3
    EXPECT_TRUE(base.centre_B_m.isApprox(Vector3(-0.028, 0.0, 0.0), 1e-12));
    const double carriage_yy = 0.1 * (0.18 * 0.18 / 12.0 + 0.01 * 0.01 / 4.0) + 0.1 * 0.37 * 0.37;
    const double cup_yy = 0.1 * (0.04 * 0.04 / 4.0 + 0.04 * 0.04 / 12.0) + 0.1 * 0.47 * 0.47;
    EXPECT_NEAR(base.inertia_kg_m2(1, 1), 0.10 - carriage_yy - cup_yy - 3.0 * 0.028 * 0.028, 1e-12);
    EXPECT_NEAR(base.inertia_kg_m2(0, 0), 0.05 - 0.5 * 0.1 * 1e-4 - 0.5 * 0.1 * 16e-4, 1e-12);
    EXPECT_TRUE(base.inertia_kg_m2.isDiagonal(0.0));
}

TEST(BaseInertia, TakesTheProductOfInertiaWhenTheJointIsNotLevel) {
    Airframe airframe;
    airframe.cup.joint_z_m = 0.06;
    const BodyInertia base = base_inertia(airframe);
    EXPECT_NEAR(base.centre_B_m.z(), -0.2 * 0.06 / 3.0, 1e-12);
    // sum of m x z over the three bodies, less the base's own tensor entry, is the whole's: zero
    const double point_masses =
        0.1 * 0.37 * 0.06 + 0.1 * 0.47 * 0.06 + 3.0 * base.centre_B_m.x() * base.centre_B_m.z();
    EXPECT_NEAR(base.inertia_kg_m2(0, 2), point_masses, 1e-12);
    EXPECT_GT(point_masses, 1e-3);
}

TEST(BaseInertia, IsTheWholeWithoutACup) {
    Airframe airframe;
    airframe.has_cup = false;
    const BodyInertia base = base_inertia(airframe);
    EXPECT_EQ(base.mass_kg, airframe.mass_kg);
    EXPECT_EQ(base.centre_B_m, Vector3::Zero());
    EXPECT_EQ(base.inertia_kg_m2.diagonal(), airframe.inertia_kg_m2);
}

TEST(Validate, AcceptsTheDefaults) {
    EXPECT_NO_THROW(validate(Airframe{}));
}

TEST(Validate, NamesWhatIsWrong) {
    const auto with = [](auto change) {
        Airframe airframe;
        change(airframe);
        return [airframe] { validate(airframe); };
    };
    EXPECT_THAT(with([](Airframe& a) { a.rotors[2].p_B_m.z() = 0.04; }),
                ThrowsMessage<InputError>(HasSubstr("rotor 2: z_m is 0.04")));
    EXPECT_THAT(with([](Airframe& a) { a.rotors[3].direction = 0; }),
                ThrowsMessage<InputError>(HasSubstr("rotor 3: direction is 0")));
    EXPECT_THAT(with([](Airframe& a) { a.rotors[3].p_B_m = a.rotors[0].p_B_m; }),
                ThrowsMessage<InputError>(HasSubstr("rotors 0 and 3 are in one place")));
    EXPECT_THAT(with([](Airframe& a) {
                    a.rotors[1] = a.rotors[0];
                    a.rotors[1].below_m = 0.1;
                    a.rotors[1].p_B_m.z() += 0.1;
                }),
                ThrowsMessage<InputError>(HasSubstr("rotors 0 and 1 are a coaxial pair")));
    EXPECT_THAT(with([](Airframe& a) { a.mass_kg = 0.2; }),
                ThrowsMessage<InputError>(HasSubstr("base")));
    EXPECT_THAT(with([](Airframe& a) { a.slider.mass_kg = 0.0; }),
                ThrowsMessage<InputError>(HasSubstr("carriage: mass_kg is 0")));
    EXPECT_THAT(with([](Airframe& a) {
                    a.inertia_kg_m2 = {0.05, 0.05, 0.2};
                }),
                ThrowsMessage<InputError>(HasSubstr("principal inertias")));
    // The whole could be a body, but not with this cup taken out of it.
    EXPECT_THAT(with([](Airframe& a) {
                    a.inertia_kg_m2 = {0.05, 0.03, 0.06};
                }),
                ThrowsMessage<InputError>(HasSubstr("base")));
    EXPECT_THAT(with([](Airframe& a) { a.mass_kg = std::numeric_limits<double>::quiet_NaN(); }),
                ThrowsMessage<InputError>(HasSubstr("nan")));
}

double slider_N(double position_m, double velocity_m_s) {
    return joint_force(slider_law(SliderParameters{}), position_m, velocity_m_s, 0.0, 1e-3).now;
}

TEST(SliderForce, SpringPreloadAndDamper) {
    EXPECT_DOUBLE_EQ(slider_N(0.0, 0.0), 5.0);
    EXPECT_DOUBLE_EQ(slider_N(-0.05, -0.2), 5.0 + 25.0 + 6.0);
}

TEST(SliderForce, StopsPushBackAndNeverPull) {
    const double stop_N = 2e4 * 0.001;
    EXPECT_DOUBLE_EQ(slider_N(0.001, 0.0), 5.0 - 0.5 - stop_N);
    EXPECT_DOUBLE_EQ(slider_N(0.001, 0.1), 5.0 - 0.5 - 3.0 - stop_N - 10.0);
    EXPECT_DOUBLE_EQ(slider_N(0.001, -1.0), 5.0 - 0.5 + 30.0);
    EXPECT_NEAR(slider_N(-0.091, 0.0), 5.0 + 45.5 + stop_N, 1e-9);
    EXPECT_DOUBLE_EQ(slider_N(-0.091, 1.0), 5.0 + 45.5 - 30.0);
}

TEST(HingeLaw, CentresAndEndsInABumper) {
    const CupMountParameters mount;
    const JointLaw hinge = hinge_law(mount);
    EXPECT_DOUBLE_EQ(joint_force(hinge, 0.5, 0.0, 0.0, 1e-3).now, -0.15);
    EXPECT_LT(joint_force(hinge, radians(mount.range_deg) + 0.01, 0.0, 0.0, 1e-3).now, -0.5);
}

template <class Struct>
void expect_sound(const ParameterTable<Struct>& table) {
    std::set<std::string_view> names;
    std::set<const void*> fields;
    Struct values;
    for (const auto& row : table) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_TRUE(fields.insert(row.of(values).address()).second) << row.name;
        EXPECT_GE(row.get(values), row.minimum) << row.name;
        EXPECT_LE(row.get(values), row.maximum) << row.name;
        EXPECT_FALSE(row.source.empty()) << row.name;
    }
    EXPECT_EQ(fields.size(), table.size());
}

TEST(Tables, RowsAreDistinctAndDefaultsAreAllowed) {
    expect_sound(rotor_table());
    expect_sound(slider_table());
    expect_sound(cup_mount_table());
    expect_sound(leg_table());
    expect_sound(battery_table());
    expect_sound(airframe_table());
    // One row a field: nothing of these structs is out of a vehicle file's reach.
    RotorParameters rotor;
    auto rows = bind(rotor_table(), rotor);
    rows.push_back({"voltage", "V", 0.0, 1e3, &rotor.nominal_voltage_V, "the battery's", ""});
    rows.push_back({"density", "-", 0.0, 1.0, &rotor.density_ratio, "the environment's", ""});
    test::expect_whole(rotor, rows, "rotor");
    test::expect_whole(slider_table(), "slider");
    test::expect_whole(cup_mount_table(), "cup");
    test::expect_whole(leg_table(), "legs");
    test::expect_whole(battery_table(), "battery");
}

}  // namespace
}  // namespace limpet::vehicle
