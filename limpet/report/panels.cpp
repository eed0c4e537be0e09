// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "limpet/core/frames.hpp"
#include "limpet/draw/colours.hpp"
#include "limpet/record/ros_frames.hpp"
#include "limpet/report/figures.hpp"

namespace limpet::report {
namespace {

constexpr double kPanel_px = 150.0;
constexpr double kStrip_px = 60.0;  ///< of what explains the panel above it

enum PanelIndex : std::size_t {
    kPressure,
    kPitch,
    kPitchError,
    kForce,
    kSlider,
    kThrust,
    kDistance,
    kSpeed
};

/// How a curve looks: what was measured, what was true.
struct Pen {
    const char* name;
    const char* colour;
    double width;
};
constexpr Pen kMeasured = {"measured", draw::colours::kBlue, 1.8};
constexpr Pen kTrue = {"true", draw::colours::kDarkBlue, 1.6};
constexpr Pen kEstimated = {"estimated", draw::colours::kPeach, 2.8};
constexpr Pen kSetPoint = {"set-point", draw::colours::kFaint, 2.6};

/// Where a curve comes from and what its numbers are multiplied by.
struct Source {
    PanelIndex panel;
    Pen pen;
    const char* topic;
    const char* column;
    double scale = 1.0;
};

constexpr std::array<Source, 9> kSources = {{
    {kPressure, kMeasured, "/sensors/cup_pressure", "fluid_pressure", hectopascals(1.0)},
    {kPressure, kTrue, "/cup", "pressure_Pa", hectopascals(1.0)},
    {kPitch, kTrue, "/truth/vehicle", "pitch_rad", degrees(1.0)},
    {kForce, kMeasured, "/sensors/force", "wrench.force.x"},
    {kForce, kTrue, "/truth/vehicle", "slider_force_N"},
    {kSlider, kTrue, "/truth/vehicle", "slider_position_m", 1e3},
    {kThrust, kTrue, "/truth/vehicle", "thrust_N"},
    {kDistance, {"left", draw::colours::kBlue, 1.8}, "/sensors/range_left", "range"},
    {kDistance, {"right", draw::colours::kOrange, 1.2}, "/sensors/range_right", "range"},
}};

/// Empty panels, in the order of the page.
std::array<draw::ChartPanel, 8> templates() {
    return {{
        {.y_label = "cup pressure  [hPa]", .least_span = 100.0, .height_px = kPanel_px},
        {.y_label = "pitch  [deg]", .least_span = 6.0, .height_px = kPanel_px},
        {.y_label = "pitch, estimated less true  [deg]", .least_span = 0.5, .height_px = kStrip_px},
        {.y_label = "force through the slider  [N]", .least_span = 20.0, .height_px = kPanel_px},
        {.y_label = "slider, 0 at its outer stop  [mm]",
         .least_span = 10.0,
         .height_px = kStrip_px},
        {.y_label = "total thrust  [N]",
         .least_span = 10.0,
         .from_zero = true,
         .height_px = kPanel_px},
        {.y_label = "distance of the LiDARs to the wall  [m]",
         .least_span = 0.5,
         .from_zero = true,
         .height_px = kPanel_px},
        {.y_label = "speed ahead  [m/s]", .least_span = 0.5, .height_px = kPanel_px},
    }};
}

/// Columns of a topic, read by row.
class Columns {
public:
    Columns(const record::Recording& recording, const char* topic,
            const std::vector<const char*>& names)
        : table_(find_table(recording, topic)) {
        for (const char* name : names) {
            columns_.push_back(table_ == nullptr ? nullptr : table_->find(name));
        }
        if (std::find(columns_.begin(), columns_.end(), nullptr) != columns_.end()) {
            table_ = nullptr;
        }
    }
    /// None when a column is not there.
    [[nodiscard]] std::size_t rows() const { return table_ == nullptr ? 0 : table_->time_s.size(); }
    [[nodiscard]] double time_s(std::size_t row) const { return table_->time_s[row]; }
    [[nodiscard]] double at(std::size_t row, std::size_t column) const {
        return columns_[column]->values[row];
    }
    /// By the nearest sample; NaN without any.
    [[nodiscard]] double near(double time_s, std::size_t column) const {
        return rows() == 0 ? kNaN : at(nearest_row(*table_, time_s), column);
    }

private:
    const record::Table* table_;
    std::vector<const record::Column*> columns_;
};

/// @param value  of a row
template <class Value>
draw::ChartSeries read(const Pen& pen, const Columns& columns, const record::Window& window,
                       const Value& value) {
    draw::ChartSeries series{.name = pen.name, .colour = pen.colour, .width = pen.width};
    for (std::size_t i = 0; i < columns.rows(); ++i) {
        if (window.holds(columns.time_s(i))) {
            const double y = value(i);
            series.x.push_back(columns.time_s(i));
            series.y.push_back(std::isfinite(y) ? y : kNaN);
        }
    }
    return series;
}

/// The autopilot's pitch, out of its attitude.
draw::ChartSeries estimated_pitch(const record::Recording& recording,
                                  const record::Window& window) {
    const Columns q(
        recording, "/estimate/pose",
        {"pose.orientation.w", "pose.orientation.x", "pose.orientation.y", "pose.orientation.z"});
    return read(kEstimated, q, window, [&q](std::size_t i) {
        const Quaternion q_ros(q.at(i, 0), q.at(i, 1), q.at(i, 2), q.at(i, 3));
        return degrees(euler_from_quaternion(record::ros::enu_flu_from_ned_frd(q_ros)).pitch_rad);
    });
}

/// A curve less another, which is read between its points; where that one is not there, nothing.
draw::ChartSeries less(draw::ChartSeries series, const draw::ChartSeries& other) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
        while (next < other.x.size() && other.x[next] < series.x[i]) {
            ++next;
        }
        double there = kNaN;
        if (next < other.x.size() && other.x[next] == series.x[i]) {
            there = other.y[next];
        } else if (next > 0 && next < other.x.size()) {
            const double share =
                (series.x[i] - other.x[next - 1]) / (other.x[next] - other.x[next - 1]);
            there = other.y[next - 1] + share * (other.y[next] - other.y[next - 1]);
        }
        series.y[i] -= there;
    }
    return series;
}

double ahead(double north, double east, double yaw_rad) {
    return north * std::cos(yaw_rad) + east * std::sin(yaw_rad);
}

/// Guidance's set-points of pitch, distance and speed, each in its own mode; what a
/// mode does not use was recorded as NaN, and the feed-forward of a position is no set-point of
/// speed.
std::array<std::pair<PanelIndex, draw::ChartSeries>, 3> set_points(
    const record::Recording& recording, const record::Window& window) {
    constexpr double kVelocity = 2.0;  // limpet_msgs/msg/Setpoint
    const Columns set_points(recording, "/setpoint",
                             {"mode", "pitch_rad", "yaw_rad", "velocity_north_m_s",
                              "velocity_east_m_s", "position_north_m", "position_east_m"});
    const Columns left(recording, "/sensors/range_left", {"range"});
    const Columns right(recording, "/sensors/range_right", {"range"});
    const Columns pose(recording, "/estimate/pose", {"pose.position.y", "pose.position.x"});
    const auto series = [&](const auto& value) {
        draw::ChartSeries found = read(kSetPoint, set_points, window, value);
        found.mark = draw::ChartSeries::Mark::dashes;
        return found;
    };
    return {{{kPitch, series([&](std::size_t i) { return degrees(set_points.at(i, 1)); })},
             {kDistance, series([&](std::size_t i) {
                  const double t = set_points.time_s(i);
                  const double too_far_m =
                      ahead(set_points.at(i, 5) - pose.near(t, 0),
                            set_points.at(i, 6) - pose.near(t, 1), set_points.at(i, 2));
                  return 0.5 * (left.near(t, 0) + right.near(t, 0)) - too_far_m;
              })},
             {kSpeed, series([&](std::size_t i) {
                  return set_points.at(i, 0) == kVelocity
                             ? ahead(set_points.at(i, 3), set_points.at(i, 4), set_points.at(i, 2))
                             : kNaN;
              })}}};
}

/// The pressures at which guidance decided, as recorded.
std::vector<draw::ChartLine> pressure_levels(const record::Recording& recording) {
    std::vector<draw::ChartLine> levels;
    const auto limpet = recording.metadata.find("limpet");
    for (const auto& [key, label] :
         {std::pair{"land_pressure_Pa", "P_land"}, std::pair{"detach_pressure_Pa", "detach"}}) {
        if (limpet != recording.metadata.end() && limpet->second.count(key) > 0) {
            const double level_hPa = hectopascals(std::atof(limpet->second.at(key).c_str()));
            levels.push_back({level_hPa, fmt::format("{} {:g}", label, level_hPa)});
        }
    }
    return levels;
}

/// Whether anything ever pulled: on a pendulum nothing does.
bool thrust_is_there(const record::Recording& recording) {
    const Columns thrust(recording, "/truth/vehicle", {"thrust_N"});
    constexpr double kLeast_N = 0.01;
    for (std::size_t i = 0; i < thrust.rows(); ++i) {
        if (std::abs(thrust.at(i, 0)) > kLeast_N) {
            return true;
        }
    }
    return thrust.rows() == 0;
}

/// What only a vehicle with a cup has, and motors only where they turn.
bool expected(const record::Recording& recording, PanelIndex panel) {
    if (panel == kThrust) {
        return thrust_is_there(recording);
    }
    return (panel != kPressure && panel != kForce && panel != kSlider) ||
           find_table(recording, "/sensors/cup_pressure") != nullptr ||
           find_table(recording, "/sensors/force") != nullptr;
}

bool has_points(const draw::ChartSeries& series) {
    return std::any_of(series.y.begin(), series.y.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

std::vector<draw::ChartPanel> panels(const record::Recording& recording,
                                     const record::Window& window) {
    std::array<draw::ChartPanel, 8> all = templates();
    const auto add = [&all](PanelIndex panel, draw::ChartSeries series) {
        if (has_points(series)) {
            all[panel].series.push_back(std::move(series));
        }
    };
    all[kPressure].levels = pressure_levels(recording);
    for (const Source& source : kSources) {
        const Columns column(recording, source.topic, {source.column});
        if (expected(recording, source.panel)) {
            add(source.panel, read(source.pen, column, window,
                                   [&](std::size_t i) { return source.scale * column.at(i, 0); }));
        }
    }
    // Over the truth it could not be seen: its error is drawn.
    const draw::ChartSeries believed = estimated_pitch(recording, window);
    if (all[kPitch].series.empty()) {
        add(kPitch, believed);
    } else {
        add(kPitchError, less(believed, all[kPitch].series.front()));
    }
    const Columns v(recording, "/truth/vehicle",
                    {"velocity_north_m_s", "velocity_east_m_s", "yaw_rad"});
    add(kSpeed, read(kTrue, v, window,
                     [&v](std::size_t i) { return ahead(v.at(i, 0), v.at(i, 1), v.at(i, 2)); }));
    for (auto& [panel, series] : set_points(recording, window)) {
        add(panel, series);
    }
    std::vector<draw::ChartPanel> shown;
    for (std::size_t i = 0; i < all.size(); ++i) {
        draw::ChartPanel& panel = all[i];
        const bool strip = i == kPitchError || i == kSlider;
        if (strip && panel.series.size() == 1) {
            panel.series.front().name.clear();  // its axis has the name
        }
        if (!panel.series.empty()) {
            panel.x_range = draw::Range{window.from_s, window.to_s};
            panel.x_numbers = false;
            shown.push_back(std::move(panel));
        }
    }
    if (!shown.empty()) {
        shown.back().x_numbers = true;
        shown.back().x_label = "time  [s]";
    }
    return shown;
}

std::vector<std::string> missing_topics(const record::Recording& recording) {
    std::vector<std::string> missing;
    for (const Source& source : kSources) {
        if (expected(recording, source.panel) && find_table(recording, source.topic) == nullptr) {
            const std::string label = templates()[source.panel].y_label;
            missing.push_back(fmt::format("{} ({}): no {} in the recording",
                                          label.substr(0, label.find("  [")), source.pen.name,
                                          source.topic));
        }
    }
    return missing;
}

}  // namespace limpet::report
