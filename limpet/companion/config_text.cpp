// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "limpet/companion/config.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::companion {
namespace {

std::string_view words(ReadingSource source) {
    switch (source) {
        case ReadingSource::mavlink: return "over the sensors' wire";
        case ReadingSource::autopilot: return "over the autopilot's wire";
        case ReadingSource::serial: return "over serial ports";
    }
    throw InternalError("source of readings out of range");
}

std::string pose_text(const CompanionConfig& config) {
    if (config.pose_source == PoseSource::mavlink) {
        return "poses       ODOMETRY over the sensors' wire, north-east-down";
    }
    const devices::MocapAxes& axes = config.axes;
    return fmt::format(
        "poses       NatNet on {}{}, rigid body {}; {} up, x axis at {:g} deg from north, "
        "origin at ({:g}, {:g}, {:g}) m; nose at {:g} deg, pivot at ({:g}, {:g}, {:g}) m",
        to_text(config.pose_address),
        config.pose_command ? ", Motive at " + to_text(*config.pose_command) : "",
        config.rigid_body, axes.up == devices::UpAxis::y ? "y" : "z", axes.x_axis_yaw_deg,
        axes.p_WM_m.x(), axes.p_WM_m.y(), axes.p_WM_m.z(), axes.nose_yaw_deg, axes.p_BP_m.x(),
        axes.p_BP_m.y(), axes.p_BP_m.z());
}

}  // namespace

std::vector<std::string> describe(const CompanionConfig& config) {
    const CompanionLimits& limits = config.limits;
    const guidance::PerchingParameters& guidance = config.guidance;
    const bool tfmini = config.lidar_source == ReadingSource::serial;
    const bool line = config.mechanism == MechanismWire::line;
    const bool in_lines = config.load_source == ReadingSource::serial;
    std::vector<std::string> lines = {
        fmt::format("mission     {} with {}", config.mission, config.vehicle),
        fmt::format("autopilot   {}, system {}; {}", to_text(config.autopilot), config.system,
                    config.asks_for_mode ? "arms it and requests OFFBOARD"
                                         : "waits until an operator flies it to before the wall "
                                           "and chooses OFFBOARD"),
        pose_text(config),
        tfmini ? fmt::format("LiDARs      TFmini Plus, left {}, right {}",
                             to_text(config.lidar_left), to_text(config.lidar_right))
               : fmt::format("LiDARs      DISTANCE_SENSOR 0 left, 1 right {}",
                             words(config.lidar_source)),
        fmt::format("mechanism   {}; {} valve; force and pressure {}",
                    line ? "lines over " + to_text(config.mechanism_address)
                         : "DO_SET_ACTUATOR over the sensors' wire",
                    guidance.valve_fitted ? "with a" : "no",
                    in_lines ? "in its lines" : words(config.load_source))};
    if (config.sensors) {
        lines.push_back("sensors     " + to_text(*config.sensors));
    }
    lines.push_back("signing     " + (config.signing_key_file.empty()
                                          ? "none: who reaches the wires may command"
                                          : "key of " + config.signing_key_file.string()));
    lines.push_back(config.real_time_priority == 0
                        ? "loop        at ordinary priority, as its file wants"
                        : fmt::format("loop        requests SCHED_FIFO {} and locked memory",
                                      config.real_time_priority));
    lines.push_back(
        fmt::format("speeds      docks at {:g} m/s from {:g} m, {} attempts, retreats at {:g} m/s",
                    guidance.dock_speed_m_s, guidance.pre_distance_m, guidance.attempts,
                    guidance.retreat_speed_m_s));
    lines.push_back(fmt::format(
        "hands back  pose older than {:g} s, autopilot's pose {:g} s, silence {:g} s, "
        "a tick {:g} s late, another mode, disarmed, Ctrl-C",
        limits.pose_limit_s, limits.estimate_limit_s, limits.silence_limit_s, limits.late_limit_s));
    return lines;
}

}  // namespace limpet::companion
