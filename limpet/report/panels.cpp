// SPDX-License-Identifier: Apache-2.0
#include "limpet/report/panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "limpet/core/frames.hpp"
#include "limpet/record/ros_frames.hpp"

namespace limpet {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPerHundred = 0.01;  // Pa -> hPa
constexpr double kToDegrees = 180.0 / kPi;

/// Where a curve comes from and what its numbers are multiplied by.
struct Source {
    std::size_t panel;
    std::string_view label;
    Trace trace;
    std::string_view topic;
    std::string_view column;
    double scale;
};

enum PanelIndex : std::size_t {
    kPressure,
    kPitch,
    kForce,
    kThrust,
    kDistance
};

constexpr std::array<Source, 8> kSources = {{
    {kPressure, "measured", Trace::measured, "/sensors/cup_pressure", "fluid_pressure",
     kPerHundred},
    {kPressure, "true", Trace::truth, "/cup", "pressure_Pa", kPerHundred},
    {kPitch, "true", Trace::truth, "/truth/vehicle", "pitch_rad", kToDegrees},
    {kForce, "measured", Trace::measured, "/sensors/force", "wrench.force.x", 1.0},
    {kForce, "true", Trace::truth, "/truth/vehicle", "slider_force_N", 1.0},
    {kThrust, "true", Trace::truth, "/truth/vehicle", "thrust_N", 1.0},
    {kDistance, "left", Trace::measured, "/sensors/range_left", "range", 1.0},
    {kDistance, "right", Trace::measured_2, "/sensors/range_right", "range", 1.0},
}};

/// Empty panels, in the order of the page.
std::array<Panel, 5> templates() {
    return {{
        {.title = "cup pressure", .unit = "hPa", .least_span = 100.0},
        {.title = "pitch", .unit = "deg", .least_span = 6.0},
        {.title = "force through the slider", .unit = "N", .least_span = 20.0},
        {.title = "total thrust", .unit = "N", .least_span = 10.0, .from_zero = true},
        {.title = "distance of the LiDARs to the wall",
         .unit = "m",
         .least_span = 0.5,
         .from_zero = true},
    }};
}

void append_inside(Curve& curve, const Window& window, double time_s, double value) {
    if (window.holds(time_s)) {
        curve.time_s.push_back(time_s);
        curve.values.push_back(std::isfinite(value) ? value : kNaN);
    }
}

Curve read(const Recording& recording, const Source& source, const Window& window) {
    Curve curve{std::string(source.label), source.trace, {}, {}};
    const Table* table = find_table(recording, source.topic);
    const Column* column = table == nullptr ? nullptr : table->find(source.column);
    for (std::size_t i = 0; column != nullptr && i < column->values.size(); ++i) {
        append_inside(curve, window, table->time_s[i], source.scale * column->values[i]);
    }
    return curve;
}

/// The autopilot's pitch, out of its attitude.
Curve estimated_pitch(const Recording& recording, const Window& window) {
    Curve curve{"estimated", Trace::estimated, {}, {}};
    const Table* table = find_table(recording, "/estimate/pose");
    if (table == nullptr) {
        return curve;
    }
    std::array<const Column*, 4> q{};
    constexpr std::array kNames = {"pose.orientation.w", "pose.orientation.x", "pose.orientation.y",
                                   "pose.orientation.z"};
    std::transform(kNames.begin(), kNames.end(), q.begin(),
                   [table](const char* name) { return table->find(name); });
    if (std::find(q.begin(), q.end(), nullptr) != q.end()) {
        return curve;
    }
    for (std::size_t i = 0; i < table->time_s.size(); ++i) {
        const Quaternion q_ros(q[0]->values[i], q[1]->values[i], q[2]->values[i], q[3]->values[i]);
        const Euler angles = euler_from_quaternion(ros::enu_flu_from_ned_frd(q_ros));
        append_inside(curve, window, table->time_s[i], degrees(angles.pitch_rad));
    }
    return curve;
}

/// The pressures at which guidance decided, as the recording tells.
std::vector<Level> pressure_levels(const Recording& recording) {
    std::vector<Level> levels;
    const auto limpet = recording.metadata.find("limpet");
    if (limpet == recording.metadata.end()) {
        return levels;
    }
    for (const auto& [key, label] :
         {std::pair{"land_pressure_Pa", "P_{land}"}, std::pair{"detach_pressure_Pa", "detach"}}) {
        const auto found = limpet->second.find(key);
        if (found != limpet->second.end()) {
            const double level_hPa = std::atof(found->second.c_str()) * kPerHundred;
            levels.push_back({fmt::format("{} {:g}", label, level_hPa), level_hPa});
        }
    }
    return levels;
}

bool has_points(const Curve& curve) {
    return std::any_of(curve.values.begin(), curve.values.end(),
                       [](double v) { return std::isfinite(v); });
}

bool has_cup(const Recording& recording) {
    return find_table(recording, "/sensors/cup_pressure") != nullptr ||
           find_table(recording, "/sensors/force") != nullptr;
}

bool of_cup(std::size_t panel) {
    return panel == kPressure || panel == kForce;
}

}  // namespace

std::vector<Panel> panels(const Recording& recording, const Window& window) {
    std::array<Panel, 5> all = templates();
    all[kPressure].levels = pressure_levels(recording);
    for (const Source& source : kSources) {
        if (of_cup(source.panel) && !has_cup(recording)) {
            continue;
        }
        all[source.panel].curves.push_back(read(recording, source, window));
    }
    auto& pitch = all[kPitch].curves;  // under the truth: it is drawn broader
    pitch.insert(pitch.begin(), estimated_pitch(recording, window));
    std::vector<Panel> shown;
    for (Panel& panel : all) {
        panel.curves.erase(std::remove_if(panel.curves.begin(), panel.curves.end(),
                                          [](const Curve& c) { return !has_points(c); }),
                           panel.curves.end());
        if (!panel.curves.empty()) {
            shown.push_back(std::move(panel));
        }
    }
    return shown;
}

std::vector<std::string> missing_topics(const Recording& recording) {
    std::vector<std::string> missing;
    const auto titles = templates();
    for (const Source& source : kSources) {
        const bool expected = !of_cup(source.panel) || has_cup(recording);
        if (expected && find_table(recording, source.topic) == nullptr) {
            missing.push_back(fmt::format("{} ({}): no {} in the recording",
                                          titles[source.panel].title, source.label, source.topic));
        }
    }
    return missing;
}

Curve thinned(const Curve& curve, const Window& window, std::size_t bins) {
    if (curve.values.size() <= 4 * bins) {
        return curve;
    }
    Curve thin{curve.label, curve.trace, {}, {}};
    const double per_s = static_cast<double>(bins) / window.span_s();
    const auto bin_of = [&](std::size_t i) {
        return std::floor((curve.time_s[i] - window.from_s) * per_s);
    };
    for (std::size_t first = 0; first < curve.values.size();) {
        std::size_t end = first;
        std::array<std::size_t, 4> kept = {first, first, first, first};
        bool gap = false;
        for (; end < curve.values.size() && bin_of(end) == bin_of(first); ++end) {
            gap = gap || std::isnan(curve.values[end]);
            kept[1] = curve.values[end] < curve.values[kept[1]] ? end : kept[1];
            kept[2] = curve.values[end] > curve.values[kept[2]] ? end : kept[2];
            kept[3] = end;
        }
        std::sort(kept.begin(), kept.end());
        // A stretch with a gap in it stays whole: gaps are rare, and comparisons with NaN are
        // false.
        for (std::size_t i = first; i < end; ++i) {
            if (gap || std::find(kept.begin(), kept.end(), i) != kept.end()) {
                thin.time_s.push_back(curve.time_s[i]);
                thin.values.push_back(curve.values[i]);
            }
        }
        first = end;
    }
    return thin;
}

Range axis_range(const Panel& panel) {
    double low = panel.from_zero ? 0.0 : std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    for (const Curve& curve : panel.curves) {
        for (const double value : curve.values) {
            low = std::fmin(low, value);
            high = std::fmax(high, value);
        }
    }
    for (const Level& level : panel.levels) {
        low = std::min(low, level.value);
        high = std::max(high, level.value);
    }
    const double lacking = std::max(0.0, panel.least_span - (high - low));
    if (panel.from_zero) {
        high += lacking;
    } else {
        low -= 0.5 * lacking;
        high += 0.5 * lacking;
    }
    constexpr double kAir = 0.07;
    const double air = kAir * (high - low);
    return {panel.from_zero ? std::min(0.0, low) : low - air, high + air};
}

}  // namespace limpet
