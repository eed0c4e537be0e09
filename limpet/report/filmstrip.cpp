// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/filmstrip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "limpet/draw/sketch.hpp"
#include "limpet/draw/stage.hpp"
#include "limpet/draw/video.hpp"
#include "limpet/record/story.hpp"

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
constexpr double kTowardsWall_rad = radians(24.0);  // less would smear the wall
constexpr double kDown_rad = radians(-10.0);

/// Into the wall, level; where the nose points when there is none.
Vector3 ahead_of(const draw::Pose& pose, const std::optional<draw::WallFace>& wall) {
    Vector3 ahead = wall ? Vector3(-wall->normal) : Vector3(pose.attitude * Vector3::UnitX());
    ahead.z() = 0.0;
    return ahead.normalized();
}

/// What is to be seen along the way ahead, from the first pose's place: from behind the vehicles to
/// a little inside the wall, as in the paper's pictures.
struct Extent {
    double rear_m = 1e9, front_m = -1e9, low_m = 1e9, high_m = -1e9;

    void show(const draw::Pose& pose, const Vector3& origin_m, const Vector3& ahead,
              const std::optional<draw::WallFace>& wall) {
        constexpr double kRear_m = 0.40, kInside_m = 0.10;
        // A wall further off would make a speck of the vehicle: then the vehicle alone is shown.
        constexpr double kFar_m = 2.6, kNose_m = 0.55;
        const Vector3 nose = pose.attitude * Vector3::UnitX();
        const double at_m = (pose.position_m - origin_m).dot(ahead);
        const double to_wall_m = wall ? (wall->centre_m - pose.position_m).dot(ahead) : kFar_m;
        const double gap_m = to_wall_m > 0.0 && to_wall_m < kFar_m ? to_wall_m : kNose_m;
        rear_m = std::min(rear_m, at_m - kRear_m * std::max(0.55, std::abs(nose.dot(ahead))));
        front_m = std::max(front_m, at_m + gap_m + kInside_m);
        low_m = std::min(low_m, pose.position_m.z() + 0.1 * nose.z());
        if (pose.payload_m && pose.cable_holds) {
            low_m = std::min(low_m, pose.payload_m->z());
        }
        high_m = std::max(high_m, pose.position_m.z() + 0.1 * nose.z());
    }
};

/// One camera for all poses.
draw::View view_of(const std::vector<draw::Pose>& poses,
                   const std::optional<draw::WallFace>& wall) {
    constexpr double kLeastWidth_m = 1.12;
    const Vector3 origin_m = poses.front().position_m, ahead = ahead_of(poses.front(), wall);
    const double aspect = static_cast<double>(kFrameWidth_px) / kFrameHeight_px;
    Extent extent;
    Vector3 mean_m = Vector3::Zero();
    for (const draw::Pose& pose : poses) {
        extent.show(pose, origin_m, ahead, wall);
        mean_m += pose.position_m / static_cast<double>(poses.size());
    }
    const double width_m = std::max({extent.front_m - extent.rear_m, kLeastWidth_m,
                                     aspect * (extent.high_m - extent.low_m + 0.9)});
    draw::View view;
    const double along_m = 0.5 * (extent.front_m + extent.rear_m) - (mean_m - origin_m).dot(ahead);
    view.target_m = mean_m + along_m * ahead;
    view.target_m.z() = 0.5 * (extent.low_m + extent.high_m);
    view.azimuth_rad = std::atan2(ahead.y(), ahead.x()) + radians(90.0) - kTowardsWall_rad;
    view.elevation_rad = kDown_rad;
    view.distance_m =
        0.5 * width_m / (aspect * std::tan(0.5 * draw::Stage::angle_of_sight_rad())) + 0.25;
    return view;
}

/// The cameras of a stretch of the flight: one that stands, where it can see all of it.
class Camera {
public:
    Camera(const record::Recording& recording, const std::vector<Moment>& moments,
           std::optional<draw::WallFace> wall)
        : wall_(std::move(wall)) {
        constexpr double kFarthest_m = 6.5;  // from it a vehicle is a speck
        constexpr int kLooks = 50;
        const double from_s = moments.front().time_s, to_s = moments.back().time_s;
        std::vector<draw::Pose> poses;
        for (int i = 0; i <= kLooks; ++i) {
            poses.push_back(pose_at(recording, from_s + (to_s - from_s) * i / kLooks));
        }
        const draw::View view = view_of(poses, wall_);
        if (view.distance_m < kFarthest_m) {
            standing_ = view;
        }
    }
    [[nodiscard]] draw::View at(const draw::Pose& pose) const {
        return standing_ ? *standing_ : view_of({pose}, wall_);
    }

private:
    std::optional<draw::WallFace> wall_;
    std::optional<draw::View> standing_;
};

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
                                const std::string& stem, const std::filesystem::path& folder,
                                const Work& work) {
    const Camera camera(recording, moments, stage.wall());
    const Sheet sheet(moments.size());
    const auto& [width_px, height_px] = sheet.page;
    draw::Sketch sketch(sheet.page, kFont_px);
    sketch.label(kMargin_px, 0.5 * kTitle_px, title, kTitleFont_px, draw::colours::kInk);
    std::string pixels(
        3u * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), '\xFF');
    for (std::size_t i = 0; i < moments.size(); ++i) {
        work.say(fmt::format("{}: picture {} of {}", stem, i + 1, moments.size()));
        const double x = sheet.left_px(i) + 2.0, y = sheet.top_px(i) + kFrameHeight_px;
        sketch.label(x, y + 22.0, fmt::format("{}  {}", i + 1, moments[i].name), kFont_px,
                     draw::colours::kInk);
        sketch.label(x, y + 52.0, caption_at(recording, moments[i].time_s), kSmallFont_px,
                     "#6B7680");
        const draw::Pose pose = pose_at(recording, moments[i].time_s);
        paste(stage.photograph(pose, camera.at(pose)), sheet.left_px(i), sheet.top_px(i), width_px,
              pixels);
    }
    sketch.frame({0.0, 0.0, static_cast<double>(width_px), static_cast<double>(height_px)});
    sketch.add("unset key\nunset tics\nunset border\nset xrange [-0.5:{0}-0.5]\n", width_px);
    sketch.add("set yrange [-0.5:{1}-0.5]\nplot DATA binary array=({0},{1}) flipy ", width_px,
               height_px);
    sketch.add("format='%uchar%uchar%uchar' using 1:2:3 with rgbimage\n");
    return draw::draw(sketch, pixels, stem, folder, false).front();
}

constexpr int kFrames_Hz = 25;

/// The stretch between the first picture and the last, as a film shows it.
/// @throws InputError where it is too long for a film: half an hour takes as long to draw
record::Window window_of_video(const record::Recording& recording,
                               const std::vector<Moment>& moments) {
    constexpr double kAround_s = 0.5, kLongest_s = 1800.0;
    const record::Window whole = whole_flight(recording);
    const record::Window window{std::max(moments.front().time_s - kAround_s, whole.from_s),
                                std::min(moments.back().time_s + kAround_s, whole.to_s)};
    if (!(window.span_s() <= kLongest_s)) {
        throw InputError(fmt::format("{}: a video of {:.6g} s, must be at most {} s long",
                                     recording.path.string(), window.span_s(), kLongest_s));
    }
    return window;
}

std::filesystem::path make_video(const record::Recording& recording,
                                 const std::vector<Moment>& moments,
                                 const std::filesystem::path& file, const Work& work) {
    draw::Stage stage(recording.attachment("model.xml")->text, kFrameWidth_px, kFrameHeight_px, 1);
    const Camera camera(recording, moments, stage.wall());
    const record::Window window = window_of_video(recording, moments);
    const int frames = static_cast<int>(std::lround(window.span_s() * kFrames_Hz)) + 1;
    draw::Video video(file, kFrameWidth_px, kFrameHeight_px, kFrames_Hz);
    for (int i = 0; i < frames; ++i) {
        work.say(fmt::format("{}: frame {} of {}", file.filename().string(), i + 1, frames));
        const draw::Pose pose =
            pose_at(recording, window.from_s + static_cast<double>(i) / kFrames_Hz);
        video.add(stage.photograph(pose, camera.at(pose)));
    }
    video.finish();
    return file;
}

std::string title_of(const record::Recording& recording, const char* what) {
    const record::Summary facts = summary(recording);
    return fmt::format("{}: {}{}{}", facts.scenario.empty() ? "flight" : facts.scenario, what,
                       facts.seed.empty() ? "" : "  ·  seed ", facts.seed);
}

}  // namespace

draw::Pictures film(const record::Recording& recording, const std::filesystem::path& folder,
                    const Work& work, const std::string& video) {
    const mcap::Attachment* model = recording.attachment("model.xml");
    if (model == nullptr) {
        throw InputError(
            fmt::format("{}: no model.xml attached: nothing to draw", recording.path.string()));
    }
    if (recording.table("/truth/pose").time_s.empty()) {
        throw InputError(fmt::format("{}: no poses in /truth/pose", recording.path.string()));
    }
    struct Strip {
        std::vector<Moment> moments;
        const char* what;
        const char* stem;
    };
    std::vector<Strip> strips = {{perching_moments(recording), "perching", "perching_film"},
                                 {take_off_moments(recording), "take-off", "take_off_film"}};
    const auto is_empty = [](const Strip& strip) { return strip.moments.empty(); };
    strips.erase(std::remove_if(strips.begin(), strips.end(), is_empty), strips.end());
    if (strips.empty()) {
        strips.push_back({flight_moments(recording), "flight", "flight_film"});
    }
    if (!video.empty()) {  // before the first picture is drawn
        draw::require_ffmpeg();
        for (const Strip& strip : strips) {
            (void)window_of_video(recording, strip.moments);
        }
    }
    const draw::gnuplot::TemporaryFolder scratch;
    auto stage = std::make_unique<draw::Stage>(model->text, kFrameWidth_px, kFrameHeight_px);
    std::vector<std::filesystem::path> made;
    for (const auto& [moments, what, stem] : strips) {
        made.push_back(make_film(recording, *stage, moments, title_of(recording, what), stem,
                                 scratch.path(), work));
    }
    stage.reset();  // one renderer at a time
    if (!video.empty()) {
        for (const Strip& strip : strips) {
            made.push_back(make_video(recording, strip.moments,
                                      scratch.path() / fmt::format("{}.{}", strip.stem, video),
                                      work));
        }
    }
    work.say();
    return {draw::publish(made, folder), {}};
}

}  // namespace limpet::report
