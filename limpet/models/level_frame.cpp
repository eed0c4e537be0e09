// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/level_frame.hpp"

#include "limpet/models/model_text.hpp"

namespace limpet::models {

using model_text::flu;

LevelFrame level_frame(const WallScene& wall) {
    Vector3 x = flu(Vector3(wall.R_WT.col(0)));
    x.z() = 0.0;
    x = x.norm() > 1e-6 ? Vector3(x.normalized()) : Vector3(Vector3::UnitX());
    Matrix3 axes;
    axes.col(0) = x;
    axes.col(1) = Vector3::UnitZ().cross(x);
    axes.col(2) = Vector3::UnitZ();
    return {flu(wall.p_WT_m), axes};
}

Viewpoint side_view(const WallScene& wall) {
    const LevelFrame level = level_frame(wall);
    // From the pre-position, 1.5 m off, to behind the wall's face.
    const double beside_m = -(wall.half_width_m + 1.2);
    return {level.point(-1.0, beside_m, 0.1), level.point(-1.0, 0.0, -0.05), 36.0};
}

Viewpoint quarter_view(const WallScene& wall) {
    const LevelFrame level = level_frame(wall);
    return {level.point(-2.3, -1.7, 0.8), level.point(-0.5, 0.0, -0.05), 40.0};
}

Viewpoint overview(const WallScene& wall) {
    const LevelFrame level = level_frame(wall);
    return {level.point(-4.3, -1.9, 1.0), level.point(-0.9, 0.0, -0.15), 34.0};
}

}  // namespace limpet::models
