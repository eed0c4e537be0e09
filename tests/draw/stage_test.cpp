// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/stage.hpp"

#include <gmock/gmock.h>

#include <cstdio>
#include <cstdlib>

#include "../support/flights.hpp"
#include "../support/png.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/draw/offscreen.hpp"

namespace limpet::draw {
namespace {

using testing::HasSubstr;
using testing::Property;
using testing::Throws;

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;

models::Scene scene() {
    models::Scene scene;
    scene.wall.p_WT_m = {3.0, 0.0, -1.5};
    return scene;
}

/// From the right of a vehicle 1.5 m up.
View view() {
    return {.target_m = {2.5, 0.0, 1.5},
            .azimuth_rad = radians(80.0),
            .elevation_rad = radians(-10.0),
            .distance_m = 2.5};
}

Pose pose() {
    Pose pose;
    pose.position_m = {2.4, 0.0, 1.5};
    return pose;
}

TEST(Stage, photographs_the_vehicle_in_its_colours) {
    Stage stage(write_mjcf(vehicle::Airframe{}, scene()), kWidth_px, kHeight_px);
    const Image image = stage.photograph(pose(), view());
    ASSERT_EQ(image.rgb.size(), 3u * kWidth_px * kHeight_px);
    EXPECT_GT(test::distinct_colours(image), 200u);
    int orange = 0;  // the cup's rubber
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        orange += image.rgb[i] > 120 && image.rgb[i] > 2 * image.rgb[i + 2] ? 1 : 0;
    }
    EXPECT_GT(orange, 20);
}

TEST(Stage, has_its_sky_above) {
    Stage stage(write_mjcf(vehicle::Airframe{}, scene()), kWidth_px, kHeight_px);
    const Image image = stage.photograph(pose(), view());
    const std::size_t bottom = image.rgb.size() - 3u * kWidth_px;
    EXPECT_GT(image.rgb[2], image.rgb[0]) << "sky is blue";
    EXPECT_LT(std::abs(image.rgb[bottom + 2] - image.rgb[bottom]), 8) << "the floor is grey";
}

TEST(Stage, sees_every_part_move) {
    Stage stage(write_mjcf(vehicle::Airframe{}, scene()), kWidth_px, kHeight_px);
    const Image still = stage.photograph(pose(), view());
    EXPECT_EQ(test::difference(still, stage.photograph(pose(), view()), 1), 0.0)
        << "it stands still";
    Pose moved = pose();
    moved.position_m.x() -= 0.2;
    EXPECT_GT(test::difference(still, stage.photograph(moved, view())), 0.02);
    Pose pitched = pose();
    pitched.attitude = Eigen::AngleAxisd(radians(-40.0), Vector3::UnitY());
    EXPECT_GT(test::difference(still, stage.photograph(pitched, view())), 0.02);
    Pose pressed = pose();
    pressed.slider_m = -0.08;
    EXPECT_GT(test::difference(still, stage.photograph(pressed, view())), 0.001);
    Pose bent = pose();
    bent.cup_pitch_rad = radians(-60.0);
    EXPECT_GT(test::difference(still, stage.photograph(bent, view())), 0.0005);
    Pose flying = pose();
    flying.rotors_turn = true;
    EXPECT_GT(test::difference(still, stage.photograph(flying, view())), 0.005);
}

TEST(Stage, sees_what_hangs_on_the_cable_and_that_it_parts) {
    vehicle::Airframe airframe;
    airframe.payload.mass_kg = 0.2;
    Stage stage(write_mjcf(airframe, scene()), kWidth_px, kHeight_px);
    Pose hangs = pose();
    hangs.payload_m = Vector3(2.4, 0.0, 1.1);
    const Image hanging = stage.photograph(hangs, view());
    Pose swung = hangs;
    swung.payload_m = Vector3(2.7, 0.0, 1.15);
    EXPECT_GT(test::difference(hanging, stage.photograph(swung, view())), 0.002);
    Pose parted = hangs;
    parted.cable_holds = false;
    EXPECT_GT(test::difference(hanging, stage.photograph(parted, view())), 0.0);
    EXPECT_LT(test::difference(hanging, stage.photograph(parted, view())), 0.01);
}

TEST(Stage, knows_its_wall) {
    models::Scene turned = scene();
    turned.wall.R_WT = quaternion_from_euler({.yaw_rad = radians(90.0)}).toRotationMatrix();
    const Stage stage(write_mjcf(vehicle::Airframe{}, turned), kWidth_px, kHeight_px);
    const auto face = stage.wall();
    ASSERT_TRUE(face.has_value());
    EXPECT_LT((face->centre_m - Vector3(3.0, 0.0, 1.5)).norm(), 1e-6);
    EXPECT_LT((face->normal - Vector3(0.0, 1.0, 0.0)).norm(), 1e-6)
        << "x of T is east, out is west";
}

TEST(Stage, stands_beside_another_one) {
    Stage first(write_mjcf(vehicle::Airframe{}, scene()), kWidth_px, kHeight_px);
    const Image before = first.photograph(pose(), view());
    { const Stage second(write_mjcf(vehicle::Airframe{}, scene()), 32, 32); }
    EXPECT_EQ(test::difference(before, first.photograph(pose(), view()), 1), 0.0);
}

TEST(Stage, does_without_wall_and_cup) {
    models::Scene open;
    open.wall.present = false;
    vehicle::Airframe plain;
    plain.has_cup = false;
    Stage stage(write_mjcf(plain, open), kWidth_px, kHeight_px);
    EXPECT_FALSE(stage.wall().has_value());
    EXPECT_GT(test::distinct_colours(stage.photograph(pose(), view())), 100u);
}

TEST(Stage, refuses_what_is_no_model) {
    EXPECT_THAT([] { Stage("<mujoco><worldbody><geom/></worldbody></mujoco>", 32, 32); },
                Throws<InputError>(Property(&InputError::what, HasSubstr("model.xml"))));
    EXPECT_THROW(Stage("", 32, 32), InputError);
    EXPECT_THAT([] { Stage("<mujoco/>", 32, 32); },
                Throws<InputError>(Property(&InputError::what, HasSubstr("base"))));
}

TEST(OffscreenDeathTest, says_what_to_install_when_nothing_can_draw) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto draw = [] {
        setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
        try {
            const OffscreenContext context;
        } catch (const InputError& problem) {
            std::fprintf(stderr, "%s\n", problem.what());
            std::exit(2);
        }
        std::exit(0);
    };
    EXPECT_EXIT(draw(), testing::ExitedWithCode(2), "apt-get install libegl1 libgl1-mesa-dri");
}

}  // namespace
}  // namespace limpet::draw
