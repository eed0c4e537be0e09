// SPDX-License-Identifier: Apache-2.0
#include "limpet/plant/mujoco_model.hpp"

#include <fmt/format.h>

#include <cstring>
#include <deque>
#include <mutex>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/loaded/mujoco.hpp"
#include "limpet/plant/engines.hpp"

namespace limpet::plant {

namespace {

using loaded::mujoco;

/// Makes MuJoCo throw InternalError where it would print, write MUJOCO_LOG.TXT and end the process.
/// Its warnings stay silent: they are counted in mjData::warning, which the plant reads after every
/// step. Process-wide, as MuJoCo's hooks are; safe to call from any thread, any number of times.
void guard_mujoco() {
    [[maybe_unused]] static const bool installed = [] {
        *mujoco().mju_user_error = [](const char* message) {
            throw InternalError(std::string("MuJoCo: ") + message);
        };
        *mujoco().mju_user_warning = [](const char*) {};
        return true;
    }();
}

/// MuJoCo reads files only; its virtual file system holds one in memory.
mjModel* compile(const std::string& mjcf) {
    guard_mujoco();
    constexpr const char* kName = "model.xml";
    if (mjcf.empty()) {
        throw InputError("MJCF: the model is empty");
    }
    const auto files = std::make_unique<mjVFS>();
    mujoco().mj_defaultVFS(files.get());
    if (mujoco().mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(mjcf.size())) != 0) {
        throw InputError("MJCF: the model is too large");
    }
    std::memcpy(files->filedata[mujoco().mj_findFileVFS(files.get(), kName)], mjcf.data(),
                mjcf.size());
    char message[1000] = "";
    mjModel* model = mujoco().mj_loadXML(kName, files.get(), message, sizeof message);
    mujoco().mj_deleteVFS(files.get());
    if (model == nullptr) {
        throw InputError(fmt::format("MJCF: {}", message));
    }
    return model;
}

int find(const mjModel& model, mjtObj type, const char* what, const char* name) {
    const int id = mujoco().mj_name2id(&model, type, name);
    if (id < 0) {
        throw InputError(fmt::format("MJCF: there is no {} \"{}\"", what, name));
    }
    return id;
}

int find_joint(const mjModel& model, int body, mjtJoint type, const char* what) {
    const int joint = model.body_jntadr[body];
    if (joint < 0 || model.jnt_type[joint] != type) {
        throw InputError(fmt::format("MJCF: body \"{}\" needs a {} joint first",
                                     model.names + model.name_bodyadr[body], what));
    }
    return joint;
}

/// The model of a text, made once for all who request it: a campaign that varies neither vehicle
/// nor wall compiles once. Few are kept, so that one that varies a mass does not keep a model a
/// run.
std::shared_ptr<const MujocoModel> compiled(std::string mjcf, const vehicle::Airframe& airframe) {
    constexpr std::size_t kMost = 32;
    static std::mutex mutex;  // also over MuJoCo's compiler, which keeps globals
    struct Kept {
        std::string mjcf;
        vehicle::SliderParameters slider;  // its stops are not in the text
        std::shared_ptr<const MujocoModel> model;
    };
    static std::deque<Kept> kept;
    const std::lock_guard lock(mutex);
    for (const Kept& one : kept) {
        if (one.mjcf == mjcf && one.slider == airframe.slider) {
            return one.model;
        }
    }
    auto model = std::make_shared<const MujocoModel>(mjcf, airframe);
    if (kept.size() == kMost) {
        kept.pop_front();
    }
    kept.push_back({std::move(mjcf), airframe.slider, model});
    return model;
}

}  // namespace

MujocoModel::MujocoModel(const std::string& mjcf, const vehicle::Airframe& airframe)
    : model_(compile(mjcf), mujoco().mj_deleteModel), mechanism_(make_mechanism(airframe)) {
    mjModel& model = *model_;
    Places& at = places_;
    at.base_body = find(model, mjOBJ_BODY, "body", "base");
    const int free = find_joint(model, at.base_body, mjJNT_FREE, "free");
    at.base_position = model.jnt_qposadr[free];
    at.base_velocity = model.jnt_dofadr[free];
    at.has_cup = mujoco().mj_name2id(&model, mjOBJ_BODY, "cup") >= 0;
    if (at.has_cup) {
        at.cup_body = find(model, mjOBJ_BODY, "body", "cup");
        at.carriage_body = find(model, mjOBJ_BODY, "body", "carriage");
        at.lip_site = find(model, mjOBJ_SITE, "site", "lip");
        const int slider = find_joint(model, at.carriage_body, mjJNT_SLIDE, "slide");
        const int pitch = find_joint(model, at.cup_body, mjJNT_HINGE, "hinge");
        for (std::size_t k = 0; k < kJoints; ++k) {
            const int joint = k == 0 ? slider : pitch + static_cast<int>(k) - 1;
            at.joint_position[k] = model.jnt_qposadr[joint];
            at.joint_velocity[k] = model.jnt_dofadr[joint];
            model.jnt_limited[joint] = 0;
            model.jnt_stiffness[joint] = 0.0;
            model.dof_damping[at.joint_velocity[k]] = 0.0;
        }
    }
    model.opt.disableflags |=
        mjDSBL_SENSOR | mjDSBL_ACTUATION | mjDSBL_EQUALITY | mjDSBL_FRICTIONLOSS | mjDSBL_CLAMPCTRL;
}

const Engine kMujocoEngine = {"mujoco", "general rigid bodies, joints and contacts, by MuJoCo 2.2",
                              [](const vehicle::Airframe& airframe,
                                 const models::Scene& scene) -> std::shared_ptr<const PlantModel> {
                                  models::Scene bare = scene;
                                  bare.visuals = false;
                                  return compiled(write_mjcf(airframe, bare), airframe);
                              }};

}  // namespace limpet::plant
