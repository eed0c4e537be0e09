// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/filmstrip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limpet/core/errors.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "limpet/draw/sketch.hpp"
#include "limpet/draw/stage.hpp"
#include "limpet/record/story.hpp"
#include "limpet/report/moments.hpp"

namespace limpet::report {
namespace {

constexpr int kFrameWidth_px = 640;
constexpr int kFrameHeight_px = 560;
constexpr int kGap_px = 16;
constexpr int kMargin_px = 32;
constexpr int kTitle_px = 84;
constexpr int kCaption_px = 84;
constexpr double kFont_px = 80.0 / 3.0;
constexpr double kTitleFont_px = 104.0 / 3.0;
constexpr double kSmallFont_px = 24.0;

/// The camera: from the vehicle's right, a little behind and above, so that the wall's face shows.
constexpr double kTowardsWall_rad = radians(11.0);
constexpr double kDown_rad = radians(-10.0);

/// From behind the vehicle to a little inside the wall, as the paper's pictures.
draw::View view_of(const draw::Pose& pose, const std::optional<draw::WallFace>& wall) {
    constexpr double kRear_m = 0.40, kInside_m = 0.10, kLeastWidth_m = 1.12;
    Vector3 ahead = wall ? Vector3(-wall->normal) : Vector3(pose.attitude * Vector3::UnitX());
    ahead.z() = 0.0;
    ahead.normalize();
    const Vector3 nose = pose.attitude * Vector3::UnitX();
    // A wall further off would make a speck of the vehicle: then the vehicle alone is shown.
    constexpr double kFar_m = 2.6, kNose_m = 0.55;
    const double to_wall_m = wall ? (wall->centre_m - pose.position_m).dot(ahead) : kFar_m;
    const double gap_m = to_wall_m > 0.0 && to_wall_m < kFar_m ? to_wall_m : kNose_m;
    const double rear_m = -kRear_m * std::max(0.55, std::abs(nose.dot(ahead)));
    const double width_m = std::max(gap_m + kInside_m - rear_m, kLeastWidth_m);
    draw::View view;
    view.target_m = pose.position_m + (gap_m + kInside_m - 0.5 * width_m) * ahead;
    view.target_m.z() += 0.1 * nose.z();
    view.azimuth_rad = std::atan2(ahead.y(), ahead.x()) + radians(90.0) - kTowardsWall_rad;
    view.elevation_rad = kDown_rad;
    const double aspect = static_cast<double>(kFrameWidth_px) / kFrameHeight_px;
    view.distance_m =
        0.5 * width_m / (aspect * std::tan(0.5 * draw::Stage::angle_of_sight_rad())) + 0.25;
    return view;
}

struct Sheet {
    draw::Canvas page;
    int columns = 1;

    explicit Sheet(std::size_t frames) {
        const int count = static_cast<int>(frames);
        columns = count > 4 ? (count + 1) / 2 : count;
        const int rows = (count + columns - 1) / columns;
        page.width_px = 2 * kMargin_px + columns * kFrameWidth_px + (columns - 1) * kGap_px;
        page.height_px = kTitle_px + rows * (kFrameHeight_px + kCaption_px) + kMargin_px / 2;
    }
    [[nodiscard]] int left_px(std::size_t frame) const {
        return kMargin_px + static_cast<int>(frame) % columns * (kFrameWidth_px + kGap_px);
    }
    [[nodiscard]] int top_px(std::size_t frame) const {
        return kTitle_px + static_cast<int>(frame) / columns * (kFrameHeight_px + kCaption_px);
    }
};

/// Into a page of so many pixels across.
void paste(const draw::Image& image, int left_px, int top_px, int across_px, std::string& page) {
    const std::ptrdiff_t bytes = 3 * image.width_px;
    for (int row = 0; row < image.height_px; ++row) {
        std::copy_n(image.rgb.begin() + bytes * row, bytes,
                    page.begin() + 3 * ((top_px + row) * across_px + left_px));
    }
}

/// The photographs go as raw pixels, the letters by gnuplot over them.
std::filesystem::path make_film(const record::Recording& recording, draw::Stage& stage,
                                const std::vector<Moment>& moments, const std::string& title,
                                const std::string& stem, const std::filesystem::path& folder) {
    const Sheet sheet(moments.size());
    const auto& [width_px, height_px] = sheet.page;
    draw::Sketch sketch(sheet.page, kFont_px);
    sketch.label(kMargin_px, 0.5 * kTitle_px, title, kTitleFont_px, draw::colours::kInk);
    std::string pixels(
        3u * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), '\xFF');
    for (std::size_t i = 0; i < moments.size(); ++i) {
        const double x = sheet.left_px(i) + 2.0, y = sheet.top_px(i) + kFrameHeight_px;
        sketch.label(x, y + 22.0, fmt::format("{}  {}", i + 1, moments[i].name), kFont_px,
                     draw::colours::kInk);
        sketch.label(x, y + 52.0, caption_at(recording, moments[i].time_s), kSmallFont_px,
                     "#6B7680");
        const draw::Pose pose = pose_at(recording, moments[i].time_s);
        paste(stage.photograph(pose, view_of(pose, stage.wall())), sheet.left_px(i),
              sheet.top_px(i), width_px, pixels);
    }
    sketch.frame({0.0, 0.0, static_cast<double>(width_px), static_cast<double>(height_px)});
    sketch.add("unset key\nunset tics\nunset border\nset xrange [-0.5:{0}-0.5]\n", width_px);
    sketch.add("set yrange [-0.5:{1}-0.5]\nplot DATA binary array=({0},{1}) flipy ", width_px,
               height_px);
    sketch.add("format='%uchar%uchar%uchar' using 1:2:3 with rgbimage\n");
    return draw::draw(sketch, pixels, stem, folder, false).front();
}

std::string title_of(const record::Recording& recording, const char* what) {
    const record::Summary facts = summary(recording);
    return fmt::format("{}: {}{}{}", facts.scenario.empty() ? "flight" : facts.scenario, what,
                       facts.seed.empty() ? "" : "  ·  seed ", facts.seed);
}

}  // namespace

draw::Pictures film(const record::Recording& recording, const std::filesystem::path& folder) {
    const mcap::Attachment* model = recording.attachment("model.xml");
    if (model == nullptr) {
        throw InputError(
            fmt::format("{}: no model.xml attached: nothing to draw", recording.path.string()));
    }
    if (recording.table("/truth/pose").time_s.empty()) {
        throw InputError(fmt::format("{}: no poses in /truth/pose", recording.path.string()));
    }
    const draw::gnuplot::TemporaryFolder work;
    draw::Stage stage(model->text, kFrameWidth_px, kFrameHeight_px);
    std::vector<std::filesystem::path> made;
    const auto make = [&](const std::vector<Moment>& moments, const char* what, const char* stem) {
        if (!moments.empty()) {
            made.push_back(
                make_film(recording, stage, moments, title_of(recording, what), stem, work.path()));
        }
    };
    make(perching_moments(recording), "perching", "perching_film");
    make(take_off_moments(recording), "take-off", "take_off_film");
    if (made.empty()) {
        make(flight_moments(recording), "flight", "flight_film");
    }
    return {draw::publish(made, folder), {}};
}

}  // namespace limpet::report
