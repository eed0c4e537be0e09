// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/mjcf_scene.hpp"

#include <cmath>

#include "limpet/models/drawing.hpp"
#include "limpet/models/finish.hpp"
#include "limpet/models/level_frame.hpp"
#include "limpet/models/model_text.hpp"

namespace limpet::models::mjcf {

namespace {

using namespace model_text;

void write_wall_material(pugi::xml_node asset, const Scene& scene) {
    switch (finish_of(scene.wall.surface)) {
        case Finish::concrete:
            add(asset, "texture", "name", "wall", "type", "2d", "builtin", "flat", "mark", "random",
                "random", "0.30", "rgb1", "0.74 0.73 0.70", "markrgb", "0.64 0.63 0.61", "width",
                "256", "height", "256");
            add(asset, "material", "name", "wall", "texture", "wall", "texuniform", "true",
                "texrepeat", "1 1", "specular", "0.05", "shininess", "0.05");
            break;
        case Finish::blocks:
            // One texture a block of 0.39 m by 0.19 m: its edge is the joint.
            add(asset, "texture", "name", "wall", "type", "2d", "builtin", "flat", "mark", "edge",
                "rgb1", "0.66 0.64 0.60", "markrgb", "0.45 0.44 0.42", "width", "64", "height",
                "32");
            add(asset, "material", "name", "wall", "texture", "wall", "texrepeat",
                text(std::round(scene.wall.half_width_m / 0.195),
                     std::round(scene.wall.half_height_m / 0.095)),
                "specular", "0.05", "shininess", "0.05");
            break;
        case Finish::gel_coat:
            add(asset, "material", "name", "wall", "rgba", "0.76 0.78 0.79 1", "specular", "0.7",
                "shininess", "0.8", "reflectance", "0.05");
            break;
        case Finish::steel:
            add(asset, "material", "name", "wall", "rgba", "0.55 0.58 0.62 1", "specular", "0.9",
                "shininess", "0.6", "reflectance", "0.05");
            break;
    }
}

void write_camera(pugi::xml_node world, const char* name, const Viewpoint& view) {
    const Vector3 back = (view.from - view.at).normalized();
    const Vector3 right = Vector3::UnitZ().cross(back).normalized();
    const Vector3 up = back.cross(right);
    add(world, "camera", "name", name, "pos", text(view.from), "fovy", text(view.fovy_deg),
        "xyaxes", text(right) + " " + text(up));
}

}  // namespace

void write_looks(pugi::xml_node root, const Scene& scene) {
    auto visual = add(root, "visual");
    add(visual, "global", "offwidth", "1920", "offheight", "1440");
    add(visual, "quality", "shadowsize", "4096", "offsamples", "8", "numslices", "48");
    add(visual, "headlight", "ambient", "0.42 0.42 0.43", "diffuse", "0.28 0.28 0.28", "specular",
        "0.1 0.1 0.1");
    add(visual, "map", "znear", "0.01", "zfar", "40", "shadowclip", "3");
    // Clip planes and shadows scale with the scene, not with how far the vehicle flies.
    add(root, "statistic", "extent", "1.5", "center", text(flu(scene.wall.p_WT_m)));

    auto asset = add(root, "asset");
    add(asset, "texture", "name", "sky", "type", "skybox", "builtin", "gradient", "rgb1",
        "0.93 0.95 0.97", "rgb2", "0.70 0.78 0.86", "width", "256", "height", "1536");
    add(asset, "texture", "name", "floor", "type", "2d", "builtin", "checker", "rgb1",
        "0.62 0.63 0.64", "rgb2", "0.57 0.58 0.59", "width", "256", "height", "256");
    add(asset, "material", "name", "floor", "texture", "floor", "texuniform", "true", "texrepeat",
        "1 1", "specular", "0.1", "shininess", "0.1");
    if (scene.wall.present) {
        write_wall_material(asset, scene);
    }
    for (const Paint paint : kPaints) {
        const PaintLook& paint_look = look(paint);
        const auto& c = paint_look.rgba;
        add(asset, "material", "name", std::string(paint_look.name), "rgba",
            text(c[0], c[1], c[2], c[3]), "specular", text(paint_look.specular), "shininess",
            text(paint_look.shininess));
    }
}

void write_surroundings(pugi::xml_node world, const Scene& scene) {
    auto ground = add(world, "geom", "name", "ground", "type", "plane", "size", "0 0 0.05", "pos",
                      text(0.0, 0.0, -scene.ground_z_W_m), "group", "0");
    if (scene.visuals) {
        set(ground, "material", "floor");
    }
    const WallScene& wall = scene.wall;
    if (!wall.present) {
        return;
    }
    const WallSolid solid = solid_of(wall);
    const Matrix3 R_WT = Quaternion(wall.R_WT).normalized().toRotationMatrix();
    const Vector3 half_m = 0.5 * solid.size_m;
    auto geom = add(world, "geom", "name", "wall", "pos",
                    text(flu(Vector3(wall.p_WT_m + R_WT * solid.p_TS_m))), "group", "0");
    Matrix3 R_TG;
    switch (solid.kind) {
        case WallSolid::Kind::box:
            // A texture lies in the box's x-y plane: its z looks out of the wall, its y up.
            R_TG << Vector3::UnitY(), -Vector3::UnitZ(), -Vector3::UnitX();
            set(geom, "type", "box", "size", text(half_m.y(), half_m.z(), half_m.x()));
            break;
        case WallSolid::Kind::cylinder:
            R_TG = Vector3(1.0, -1.0, -1.0).asDiagonal();
            set(geom, "type", "cylinder", "size", text(solid.size_m.x(), half_m.z()));
            break;
    }
    const Matrix3 R_WG = Vector3(1.0, -1.0, -1.0).asDiagonal() * R_WT * R_TG;
    set(geom, "quat", text(Quaternion(R_WG)));
    if (scene.visuals) {
        set(geom, "material", "wall");
    }
}

void write_lights_and_cameras(pugi::xml_node world, const Scene& scene) {
    const LevelFrame level = level_frame(scene.wall);
    const Vector3 sun = level.axes * Vector3(0.55, 0.35, -1.0).normalized();
    add(world, "light", "name", "sun", "directional", "true", "castshadow", "true", "pos",
        text(level.point(-2.2, -1.4, 4.0)), "dir", text(sun), "diffuse", "0.62 0.60 0.56",
        "specular", "0.3 0.3 0.3");
    add(world, "light", "name", "fill", "directional", "true", "castshadow", "false", "pos",
        text(level.point(-3.0, 3.0, 3.0)), "dir", text(Vector3(level.axes * Vector3(1, -1, -0.6))),
        "diffuse", "0.22 0.24 0.28", "specular", "0 0 0");
    write_camera(world, "side", side_view(scene.wall));
    write_camera(world, "quarter", quarter_view(scene.wall));
}

}  // namespace limpet::models::mjcf
