// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mujoco_model.hpp"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "limpet/core/errors.hpp"
#include "plants.hpp"

namespace limpet::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// MuJoCo's own mass matrix in the initial configuration; its first six rows belong to the base.
Eigen::MatrixXd mass_matrix(const mjModel& model) {
    const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(&model), mj_deleteData);
    mj_forward(&model, data.get());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> full(model.nv, model.nv);
    mj_fullM(&model, full.data(), data->qM);
    return full;
}

TEST(MujocoModel, HasTheStatedMassCentreAndInertia) {
    vehicle::Airframe skewed;
    skewed.cup.joint_z_m = 0.06;
    for (const vehicle::Airframe& airframe :
         {vehicle::Airframe{}, skewed, test::plain_multirotor()}) {
        const Eigen::MatrixXd mass = mass_matrix(test::compile(airframe)->get());
        const Matrix3 translation = mass.block<3, 3>(0, 0);
        const Matrix3 coupling = mass.block<3, 3>(0, 3);
        const Matrix3 rotation = mass.block<3, 3>(3, 3);
        EXPECT_LT((translation - 3.2 * Matrix3::Identity()).norm(), 1e-12);
        EXPECT_LT(coupling.norm(), 1e-12) << "the centre of mass is the origin of B";
        EXPECT_LT((rotation - Matrix3(Vector3(0.05, 0.10, 0.14).asDiagonal())).norm(), 1e-12);
    }
}

TEST(MujocoModel, PicturesAddNoPhysics) {
    models::Scene plain = test::wall_ahead();
    models::Scene pretty = plain;
    pretty.visuals = true;
    for (const vehicle::Airframe& airframe : {vehicle::Airframe{}, test::plain_multirotor()}) {
        const auto bare = test::compile(airframe, plain);
        for (const char* surface :
             {"porous_concrete", "cinder_block", "turbine_blade", "smooth_metal", "unheard_of"}) {
            pretty.wall.surface = surface;
            const auto dressed = test::compile(airframe, pretty);
            EXPECT_EQ(mass_matrix(bare->get()), mass_matrix(dressed->get())) << surface;
            EXPECT_GT(dressed->get().ngeom, bare->get().ngeom + 20);
            MujocoPlant first(bare);
            MujocoPlant second(dressed);
            for (int i = 0; i < 100; ++i) {
                first.step({});
                second.step({});
            }
            EXPECT_EQ(first.save().values, second.save().values);
            EXPECT_EQ(second.ray(Vector3::Zero(), Vector3::UnitX()).value(), 1.5);
        }
    }
}

TEST(MujocoModel, NamesWhatOthersLookFor) {
    models::Scene scene = test::wall_ahead();
    scene.visuals = true;
    const auto model = test::compile(vehicle::Airframe{}, scene);
    const auto has = [&model](mjtObj type, const char* name) {
        return mj_name2id(&model->get(), type, name) >= 0;
    };
    for (const char* name : {"base", "carriage", "cup"}) {
        EXPECT_TRUE(has(mjOBJ_BODY, name)) << name;
    }
    for (const char* name : {"slider", "cup_pitch", "cup_yaw"}) {
        EXPECT_TRUE(has(mjOBJ_JOINT, name)) << name;
    }
    for (const char* name :
         {"leg_left", "leg_right", "rotor_0", "rotor_1", "rotor_2", "rotor_3", "wall", "ground"}) {
        EXPECT_TRUE(has(mjOBJ_GEOM, name)) << name;
    }
    for (const char* name : {"side", "quarter"}) {
        EXPECT_TRUE(has(mjOBJ_CAMERA, name)) << name;
    }
}

TEST(MujocoModel, RefusesWhatItCannotUse) {
    const auto load = [](const char* text) { return [text] { MujocoModel(text, {}); }; };
    EXPECT_THAT(load(""), ThrowsMessage<InputError>(HasSubstr("MJCF")));
    EXPECT_THAT(load("<mujoco><worldbody>"), ThrowsMessage<InputError>(HasSubstr("MJCF")));
    EXPECT_THAT(load("<mujoco><nonsense/></mujoco>"),
                ThrowsMessage<InputError>(HasSubstr("nonsense")));
    EXPECT_THAT(load("<mujoco/>"), ThrowsMessage<InputError>(HasSubstr("body \"base\"")));
    constexpr const char* kHinged =
        "<mujoco><worldbody><body name='base'><joint type='hinge'/><geom size='1'/></body>"
        "</worldbody></mujoco>";
    EXPECT_THAT(load(kHinged), ThrowsMessage<InputError>(HasSubstr("needs a free joint")));
    constexpr const char* kCupAlone =
        "<mujoco><worldbody><body name='base'><freejoint/><geom size='1'/>"
        "<body name='cup'><joint/><geom size='1'/></body></body></worldbody></mujoco>";
    EXPECT_THAT(load(kCupAlone), ThrowsMessage<InputError>(HasSubstr("body \"carriage\"")));
}

}  // namespace
}  // namespace limpet::plant
