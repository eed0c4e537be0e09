// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/autopilot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

#include "limpet/core/frames.hpp"
#include "limpet/px4/stand_in.hpp"

namespace limpet::px4 {

using mavlink::HilStatus;
using mavlink::OffboardState;

namespace {

/// Space in the wire is waited for no longer: a jammed one must not make guidance late.
constexpr std::chrono::milliseconds kRoom{5};

std::string_view version_1() {
    static const std::string text = fmt::format("the autopilot speaks {}", mavlink::kVersion1);
    return text;
}

/// Before take-off: so far from motion capture an estimate is of another place.
constexpr double kApart_m = 1.0;
constexpr double kApart_rad = radians(30.0);

bool is_stand_in(const mavlink::AutopilotVersion& version) {
    return std::equal(kStandInMark.begin(), kStandInMark.end(),
                      version.flight_custom_version.begin());
}

/// PX4 has major, minor, patch and the kind of release, a byte each from the top.
std::string version_text(std::uint32_t version) {
    constexpr std::uint32_t kByte = 0xFF;
    const std::uint32_t kind = version & kByte;
    const char* suffix = kind == kByte ? ""
                         : kind >= 192 ? "-rc"
                         : kind >= 128 ? "-beta"
                         : kind >= 64  ? "-alpha"
                                       : "-dev";
    return fmt::format("{}.{}.{}{}", version >> 24U, version >> 16U & kByte, version >> 8U & kByte,
                       suffix);
}

}  // namespace

Px4Autopilot::Px4Autopilot(mavlink::Link& hil, mavlink::Link& offboard, Px4Options options)
    : hil_link_(hil),
      offboard_link_(offboard),
      options_(std::move(options)),
      hil_(hil, options_.hil),
      offboard_(options_.offboard) {}

void Px4Autopilot::hear(const mavlink::Frame& frame) {
    offboard_.hear(frame, clock_s());
    if (const auto odometry = mavlink::decode<mavlink::Odometry>(frame)) {
        odometry_usec_ = odometry->time_usec;
    }
    if (offboard_.report().texts != texts_) {
        texts_ = offboard_.report().texts;
        if (options_.on_text) {
            options_.on_text(offboard_.report().text);
        }
    }
}

/// Whether its clock is ours, and its estimate has come.
bool Px4Autopilot::in_step() const {
    return options_.hil.timing == mavlink::HilTiming::lockstep && odometry_usec_ > 0;
}

/// A fresh estimate for guidance costs system calls: at twice its rate, not at the IMU's. On a busy
/// machine PX4's telemetry may lag behind its own lockstep; then it is given a moment, so that
/// guidance never flies on an estimate that is old by accident.
void Px4Autopilot::listen() {
    constexpr double kInterval_s = 0.01;
    constexpr double kLag_s = 0.05;
    constexpr std::chrono::milliseconds kMoment{50};
    if (&offboard_link_ == &hil_link_ || clock_s() - listened_s_ < kInterval_s) {
        return;
    }
    listened_s_ = clock_s();
    for (int k = 0; k < mavlink::kFramesAtOnce; ++k) {
        const auto frame = offboard_link_.receive();
        if (!frame) {
            break;
        }
        hear(*frame);
    }
    if (in_step() && clock_s() - 1e-6 * static_cast<double>(odometry_usec_) > kLag_s) {
        const auto begin = std::chrono::steady_clock::now();
        if (const auto frame = offboard_link_.receive(kMoment)) {
            hear(*frame);
        }
        listening_s_ +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
}

Estimate Px4Autopilot::estimate(double time_s) {
    listen();
    Estimate estimate = offboard_.estimate(clock_s());
    estimate.time_s = time_s;
    if (in_step()) {
        estimate.age_s = std::max(0.0, clock_s() - 1e-6 * static_cast<double>(odometry_usec_));
    }
    estimate.valid = estimate.valid && !tracker_silent(time_s) && !awaits_origin() && !elsewhere();
    return estimate;
}

/// Whether a tracker aided it and does so no more.
bool Px4Autopilot::tracker_silent(double time_s) const {
    return readings_.motion_capture.ever() &&
           !readings_.motion_capture.fresh(time_s, options_.aiding_limit_s);
}

bool Px4Autopilot::awaits_origin() const {
    return options_.flies && offboard_.awaits_origin(clock_s());
}

/// Before the first take-off: its pose is another than the one that it was sent. A bias, a frame or
/// a height of its own, and a tracker that it does not use, look like this. By GPS its origin is
/// another one, and its estimate is off by metres.
bool Px4Autopilot::elsewhere() const {
    const bool by_gps = std::isinf(options_.aiding_limit_s);
    if (flew_ || !options_.flies || by_gps || !readings_.motion_capture.ever()) {
        return false;
    }
    const Estimate estimate = offboard_.estimate(clock_s());
    const PoseReading& pose = readings_.motion_capture.value;
    return estimate.valid && ((estimate.p_WB_m - pose.p_WB_m).norm() > kApart_m ||
                              estimate.q_WB.angularDistance(pose.q_WB) > kApart_rad);
}

/// Set to MAVLink 1 alone, it is there and seems silent.
bool Px4Autopilot::speaks_version_1() const {
    const bool on_hil = hil_.count().answers == 0 && hil_link_.count().refusals.version_1 > 0;
    const bool on_offboard = options_.flies &&
                             offboard_.state(clock_s()) == OffboardState::silent &&
                             offboard_link_.count().refusals.version_1 > 0;
    return on_hil || on_offboard;
}

/// The built-in autopilot behind PX4's wire has no other parameters than its own, and those of its
/// estimator mean another filter.
void Px4Autopilot::report_differences() {
    if (compared_ || !options_.flies || !offboard_.compared(clock_s())) {
        return;
    }
    compared_ = true;
    std::vector<mavlink::ParameterDifference> found = offboard_.differences(clock_s());
    const auto& version = offboard_.report().version;
    if (version && is_stand_in(*version)) {
        std::erase_if(found, [](const mavlink::ParameterDifference& difference) {
            return !difference.value || difference.expected.name.starts_with("EKF2_");
        });
    }
    if (!found.empty() && options_.on_difference) {
        options_.on_difference(found);
    }
}

/// Set-points and sensors.
void Px4Autopilot::send(const Setpoint& setpoint) {
    // Two wires of one autopilot: what goes in a step goes at once, and wakes it up once.
    const bool apart = &offboard_link_ != &hil_link_;
    if (options_.flies) {
        if (apart) {
            offboard_link_.cork();
        }
        report_differences();
        if (awaits_origin() || elsewhere()) {
            offboard_.attend(offboard_link_, clock_s());
        } else {
            offboard_.update(offboard_link_, setpoint, clock_s());
        }
    }
    hil_.send(readings_, clock_usec_, [&] {
        if (apart) {
            (void)offboard_link_.uncork(kRoom);
        }
    });
}

Mover Px4Autopilot::mover() {
    const bool armed = offboard_.report().armed;
    flew_ = flew_ || armed;
    return armed ? Mover::rotors : flew_ ? Mover::nothing : Mover::hand;
}

/// As it was received, stamped by the flight's clock.
Estimate Px4Autopilot::heard_estimate(double time_s) const {
    Estimate estimate = offboard_.estimate(clock_s());
    estimate.time_s += time_s - clock_s();
    return estimate;
}

void Px4Autopilot::tell(const Readings& readings, const Setpoint& setpoint, double time_s) {
    readings_ = readings;
    readings_.motion_capture =
        awaits_origin() ? Sample<PoseReading>()
                        : watch_.trusted(readings.motion_capture, heard_estimate(time_s), mover());
    clock_usec_ += static_cast<std::uint64_t>(std::llround(1e6 / options_.control_rate_Hz));
    send(setpoint);
}

RotorCommand Px4Autopilot::command() {
    status_ = hil_.receive([this](const mavlink::Frame& frame) {
        // Until the clocks are in step, when something is received is a matter of the machine: its
        // greetings are left alone.
        if (options_.hil.timing == mavlink::HilTiming::real_time || hil_.count().answers > 0) {
            hear(frame);
        }
    });
    switch (status_) {
        case mavlink::HilStatus::waiting:
        case mavlink::HilStatus::answered: break;
        case mavlink::HilStatus::silent:
            failure_ = hil_.count().answers > 0 ? "the autopilot answers no longer"
                       : speaks_version_1()
                           ? version_1()
                           : "the autopilot connected, and has not answered HIL_SENSOR in "
                             "the time that it is waited for";
            break;
        case mavlink::HilStatus::gone: failure_ = "the autopilot closed the link"; break;
        case mavlink::HilStatus::interrupted: break;  // who set the stop ends the flight
    }
    if (options_.only_px4 && !failure_) {
        look_who();
    }
    if (options_.flies && !failure_) {
        if (offboard_.state(clock_s()) == mavlink::OffboardState::taken_away) {
            failure_ = "the autopilot left the mode OFFBOARD";
        }
    }
    return hil_.command();
}

/// Before it flies: it is armed two seconds after its estimate is first received, at the soonest.
void Px4Autopilot::look_who() {
    constexpr double kPatience_s = 1.5;
    const auto& version = offboard_.report().version;
    received_since_s_ =
        received_since_s_ < 0.0 && odometry_usec_ > 0 ? clock_s() : received_since_s_;
    if (version && is_stand_in(*version)) {
        failure_ = "the stand-in answered, and a PX4 is required";
    } else if (!version && received_since_s_ >= 0.0 &&
               clock_s() - received_since_s_ > kPatience_s) {
        failure_ = "it does not report what it is (AUTOPILOT_VERSION), and a PX4 is required";
    }
}

std::optional<autopilot::AutopilotIdentity> Px4Autopilot::identity() const {
    const mavlink::AutopilotReport& report = offboard_.report();
    if (!report.version) {
        return std::nullopt;
    }
    autopilot::AutopilotIdentity identity{
        .name = "stand-in",
        .version = version_text(report.version->flight_sw_version),
        .git_hash = {},
        .airframe = report.airframe,
        .system = options_.offboard.target_system};
    if (!is_stand_in(*report.version)) {
        std::uint64_t digits = 0;
        std::memcpy(&digits, report.version->flight_custom_version.data(), sizeof(digits));
        identity.name = "PX4";
        digits >>= 24U;  // below it, PX4 has its vendor's version
        identity.git_hash = digits == 0 ? "" : fmt::format("{:010x}", digits);
    }
    return identity;
}

std::string Px4Autopilot::obstacle() const {
    if (failure_) {
        return std::string(*failure_);
    }
    if (speaks_version_1()) {
        return std::string(version_1());
    }
    if (status_ == mavlink::HilStatus::waiting) {
        return "the autopilot boots: it has not answered HIL_SENSOR yet";
    }
    if (!options_.flies) {
        return {};
    }
    const Estimate estimate = offboard_.estimate(clock_s());
    if (awaits_origin() && estimate.valid) {
        return "the autopilot's origin has no latitude and longitude yet";
    }
    if (elsewhere() && estimate.valid) {
        const PoseReading& pose = readings_.motion_capture.value;
        return fmt::format(
            "the autopilot's pose is {:.0f} m and {:.0f} deg from the motion capture that it is "
            "sent",
            (estimate.p_WB_m - pose.p_WB_m).norm(),
            degrees(estimate.q_WB.angularDistance(pose.q_WB)));
    }
    return offboard_.obstacle(clock_s());
}

}  // namespace limpet::px4
