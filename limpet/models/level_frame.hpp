// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/models/model_writer.hpp"

namespace limpet::models {

/// Level axes at the wall in a model's world (north-west-up): x towards the wall, y along it to the
/// left, z up. Cameras and lights stand in it.
struct LevelFrame {
    Vector3 origin = Vector3::Zero();
    Matrix3 axes = Matrix3::Identity();  ///< columns: x, y, z

    [[nodiscard]] Vector3 point(double x, double y, double z) const {
        return origin + axes * Vector3(x, y, z);
    }
};
[[nodiscard]] LevelFrame level_frame(const WallScene& wall);

/// From where a picture of the whole manoeuvre is taken, and towards what; in the model's world.
struct Viewpoint {
    Vector3 from = Vector3::Zero();
    Vector3 at = Vector3::Zero();
    double fovy_deg = 40.0;
};
/// Along the wall.
[[nodiscard]] Viewpoint side_view(const WallScene& wall);
/// From behind the vehicle's shoulder.
[[nodiscard]] Viewpoint quarter_view(const WallScene& wall);
/// From further behind: what starts over 2 m before the wall is in it too.
[[nodiscard]] Viewpoint overview(const WallScene& wall);

}  // namespace limpet::models
