// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "limpet/core/errors.hpp"
#include "limpet/core/one_line.hpp"
#include "limpet/draw/offscreen.hpp"
#include "limpet/draw/picture_model.hpp"
#include "limpet/loaded/mujoco.hpp"

namespace limpet::draw {
namespace {

using loaded::mujoco;

constexpr int kSamples = 4;
constexpr double kAngleOfSight_deg = 28.0;
constexpr double kFarthest_m = 1e5;
constexpr float kBlur = 0.30F;  // how much a turning propeller hides

/// One line for all that is not there.
void require_libraries() {
    std::string missing;
    for (void (*const load)() : {+[] { (void)mujoco(); }, &require_egl}) {
        try {
            load();
        } catch (const NotInstalled& problem) {
            missing += (missing.empty() ? "" : "; ") + std::string(problem.what());
        }
    }
    if (!missing.empty()) {
        throw NotInstalled(missing);
    }
}

struct DeleteModel {
    void operator()(mjModel* model) const { mujoco().mj_deleteModel(model); }
};
using MujocoModel = std::unique_ptr<mjModel, DeleteModel>;

/// Files that MuJoCo finds in memory.
class Files {
public:
    Files() { mujoco().mj_defaultVFS(files_.get()); }
    ~Files() { mujoco().mj_deleteVFS(files_.get()); }
    Files(const Files&) = delete;
    Files& operator=(const Files&) = delete;

    [[nodiscard]] mjVFS* get() const { return files_.get(); }
    /// @return whether it was taken
    [[nodiscard]] bool add(const char* name, const std::string& text) const {
        if (mujoco().mj_makeEmptyFileVFS(get(), name, static_cast<int>(text.size())) != 0) {
            return false;
        }
        std::memcpy(files_->filedata[mujoco().mj_findFileVFS(get(), name)], text.data(),
                    text.size());
        return true;
    }

private:
    std::unique_ptr<mjVFS> files_ = std::make_unique<mjVFS>();
};

/// The model.xml of a recording, compiled: what a picture needs of it (picture_model.hpp).
/// @throws InputError as picture_model, or with MuJoCo's words
MujocoModel compile_mjcf(const std::string& mjcf) {
    constexpr const char* kName = "model.xml";
    const Files files;
    if (!files.add(kName, picture_model(mjcf))) {
        throw InputError("model.xml: too large");
    }
    char message[1000] = "";
    MujocoModel model(mujoco().mj_loadXML(kName, files.get(), message, sizeof message));
    if (!model) {
        throw InputError(fmt::format("model.xml: {}", one_line(message)));
    }
    return model;
}

using Pixels = std::vector<std::uint8_t>;  // three a pixel, rows from bottom to top

/// The model is the user's: what MuJoCo finds in it is bad input.
void throw_error(const char* message) {
    throw InputError(std::string("MuJoCo: ") + message);
}
void keep_silent(const char*) {}

/// MuJoCo's hooks belong to the process: these are set as long as a stage exists.
class ErrorHooks {
public:
    ErrorHooks() : error_(*mujoco().mju_user_error), warning_(*mujoco().mju_user_warning) {
        *mujoco().mju_user_error = throw_error;
        *mujoco().mju_user_warning = keep_silent;
    }
    ~ErrorHooks() {
        *mujoco().mju_user_error = error_;
        *mujoco().mju_user_warning = warning_;
    }
    ErrorHooks(const ErrorHooks&) = delete;
    ErrorHooks& operator=(const ErrorHooks&) = delete;

private:
    void (*error_)(const char*);
    void (*warning_)(const char*);
};

int base_address(const mjModel& model) {
    const int body = mujoco().mj_name2id(&model, mjOBJ_BODY, "base");
    const int joint = body < 0 ? -1 : model.body_jntadr[body];
    if (joint < 0 || model.jnt_type[joint] != mjJNT_FREE) {
        throw InputError("model.xml: there is no body \"base\" with a free joint");
    }
    return model.jnt_qposadr[joint];
}

/// Whether a picture of it can be drawn.
bool is_somewhere(const Pose& pose) {
    const auto near = [](const Vector3& p_m) {
        return p_m.allFinite() && p_m.cwiseAbs().maxCoeff() <= kFarthest_m;
    };
    return near(pose.position_m) && (!pose.payload_m || near(*pose.payload_m)) &&
           pose.attitude.coeffs().allFinite() && pose.attitude.norm() > 1e-6 &&
           near({pose.slider_m, pose.cup_pitch_rad, pose.cup_yaw_rad});
}

Image shrunk(const Pixels& large, int width_px, int height_px, int by) {
    Image image{width_px, height_px, {}};
    image.rgb.resize(3u * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
    const int large_width = by * width_px;
    auto out = image.rgb.begin();
    for (int row = height_px - 1; row >= 0; --row) {  // OpenGL begins at the bottom
        for (int column = 0; column < width_px; ++column) {
            for (int channel = 0; channel < 3; ++channel) {
                int sum = 0;
                for (int i = 0; i < by * by; ++i) {
                    const int y = by * row + i / by;
                    const int x = by * column + i % by;
                    sum += large[static_cast<std::size_t>(3 * (y * large_width + x) + channel)];
                }
                *out++ = static_cast<std::uint8_t>(sum / (by * by));
            }
        }
    }
    return image;
}

}  // namespace

struct Stage::Parts {
    ErrorHooks hooks;
    OffscreenContext screen;
    MujocoModel model;
    std::unique_ptr<mjData, decltype(&::mj_deleteData)> data{nullptr, mujoco().mj_deleteData};
    double* base;  ///< place and attitude, in qpos
    mjvScene scene;
    mjrContext renderer;
    mjvOption option;
    int width_px;
    int height_px;
    int oversampling;  ///< on top of multisampling

    Parts(const std::string& mjcf, int width, int height, int samples)
        : model(compile_mjcf(mjcf)), width_px(width), height_px(height), oversampling(samples) {
        const int base_at = base_address(*model);
        model->vis.global.offwidth = oversampling * width;
        model->vis.global.offheight = oversampling * height;
        model->vis.global.fovy = static_cast<float>(kAngleOfSight_deg);
        model->vis.quality.offsamples = kSamples;
        data.reset(mujoco().mj_makeData(model.get()));
        base = data->qpos + base_at;
        mujoco().mjv_defaultOption(&option);
        mujoco().mjv_defaultScene(&scene);
        mujoco().mjr_defaultContext(&renderer);
        mujoco().mjv_makeScene(model.get(), &scene, 1000);
        make_renderer();
    }
    ~Parts() {
        if (screen.use()) {  // else it took what it held along
            mujoco().mjr_freeContext(&renderer);
        }
        mujoco().mjv_freeScene(&scene);
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

    /// MuJoCo looks for OpenGL by itself, under names that only the -dev packages bring.
    void make_renderer() {
        try {
            mujoco().mjr_makeContext(model.get(), &renderer, mjFONTSCALE_100);
        } catch (const InputError& problem) {
            mujoco().mjv_freeScene(&scene);
            throw NotInstalled(fmt::format(
                "cannot draw: {}; needed: apt-get install libegl-dev libgl-dev", problem.what()));
        }
        mujoco().mjr_setBuffer(mjFB_OFFSCREEN, &renderer);
        require(renderer.currentBuffer == mjFB_OFFSCREEN, "MuJoCo has a buffer to draw into");
    }

    void set_joint(const char* name, double value) {
        const int id = mujoco().mj_name2id(model.get(), mjOBJ_JOINT, name);
        if (id >= 0) {
            data->qpos[model->jnt_qposadr[id]] = value;
        }
    }

    void show_material(const char* name, bool shown, float alpha) const {
        const int id = mujoco().mj_name2id(model.get(), mjOBJ_MATERIAL, name);
        if (id >= 0) {
            model->mat_rgba[4 * id + 3] = shown ? alpha : 0.0F;
        }
    }

    void set_payload(const Pose& pose) {
        const int body = mujoco().mj_name2id(model.get(), mjOBJ_BODY, "payload");
        const int cable = mujoco().mj_name2id(model.get(), mjOBJ_TENDON, "cable");
        if (pose.payload_m && body >= 0 && model->body_mocapid[body] >= 0) {
            std::copy_n(pose.payload_m->data(), 3, data->mocap_pos + 3 * model->body_mocapid[body]);
        }
        if (cable >= 0) {
            model->tendon_rgba[4 * cable + 3] = pose.payload_m && pose.cable_holds ? 1.0F : 0.0F;
        }
    }

    void set(const Pose& pose) {
        const Quaternion& q = pose.attitude;
        const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
        std::copy_n(pose.position_m.data(), 3, base);
        std::copy_n(wxyz, 4, base + 3);
        set_joint("slider", pose.slider_m);
        set_joint("cup_pitch", pose.cup_pitch_rad);
        set_joint("cup_yaw", pose.cup_yaw_rad);
        set_payload(pose);
        mujoco().mj_kinematics(model.get(), data.get());
        mujoco().mj_comPos(model.get(), data.get());
        mujoco().mj_tendon(model.get(), data.get());
        mujoco().mj_camlight(model.get(), data.get());
    }

    [[nodiscard]] Pixels render(mjvCamera& camera, bool shadows) {
        mujoco().mjv_updateScene(model.get(), data.get(), &option, nullptr, &camera, mjCAT_ALL,
                                 &scene);
        scene.flags[mjRND_SHADOW] = shadows ? 1 : 0;
        const mjrRect all{0, 0, oversampling * width_px, oversampling * height_px};
        mujoco().mjr_render(all, &scene, &renderer);
        Pixels pixels(3u * static_cast<std::size_t>(all.width) *
                      static_cast<std::size_t>(all.height));
        mujoco().mjr_readPixels(pixels.data(), nullptr, all, &renderer);
        return pixels;
    }
};

Stage::Stage(const std::string& mjcf, int width_px, int height_px, int oversampling) {
    require_libraries();
    parts_ = std::make_unique<Parts>(mjcf, width_px, height_px, oversampling);
}

Stage::~Stage() = default;

double Stage::angle_of_sight_rad() {
    return radians(kAngleOfSight_deg);
}

std::optional<WallFace> Stage::wall() const {
    const mjModel& model = *parts_->model;
    const int geom = mujoco().mj_name2id(&model, mjOBJ_GEOM, "wall");
    if (geom < 0 || model.geom_type[geom] != mjGEOM_BOX) {
        return std::nullopt;
    }
    mujoco().mj_kinematics(&model, parts_->data.get());
    const double* rotation = parts_->data->geom_xmat + 9 * geom;
    WallFace face;
    face.normal = {rotation[2], rotation[5], rotation[8]};
    face.centre_m = Eigen::Map<const Vector3>(parts_->data->geom_xpos + 3 * geom);
    face.centre_m += model.geom_size[3 * geom + 2] * face.normal;
    return face;
}

Image Stage::photograph(const Pose& pose, const View& view) {
    if (!is_somewhere(pose)) {
        throw InputError(
            fmt::format("cannot draw: a pose must be finite numbers, within {:g} m, with "
                        "an attitude",
                        kFarthest_m));
    }
    Parts& p = *parts_;
    if (!p.screen.use()) {
        throw InputError("cannot draw: OpenGL's context was lost");
    }
    p.set(pose);
    mjvCamera camera;
    mujoco().mjv_defaultCamera(&camera);
    camera.type = mjCAMERA_FREE;
    std::copy_n(view.target_m.data(), 3, camera.lookat);
    camera.azimuth = degrees(view.azimuth_rad);
    camera.elevation = degrees(view.elevation_rad);
    camera.distance = view.distance_m;
    p.show_material("blade", !pose.rotors_turn, 1.0F);
    p.show_material("propeller", false, 0.0F);
    Pixels picture = p.render(camera, true);
    if (pose.rotors_turn) {
        // A disc that blurs a propeller would cast the shadow of a solid one: it is put on top by
        // what it changes in a picture without shadows.
        const Pixels without = p.render(camera, false);
        p.show_material("propeller", true, kBlur);
        const Pixels with = p.render(camera, false);
        for (std::size_t i = 0; i < picture.size(); ++i) {
            picture[i] =
                static_cast<std::uint8_t>(std::clamp(picture[i] + with[i] - without[i], 0, 255));
        }
    }
    return shrunk(picture, p.width_px, p.height_px, p.oversampling);
}

}  // namespace limpet::draw
