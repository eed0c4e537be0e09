// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros/src/apart_lip.hpp"

#include <cmath>
#include <tuple>
#include <utility>

namespace limpet::ros {
namespace {

/// Farther from the wall than this the lip is reported kFar_Hz times a second; while it is attached
/// kAttached_Hz times.
constexpr double kNear_m = 0.05;
constexpr int kFar_Hz = 100;
constexpr int kAttached_Hz = 250;

Tick tick_of(double time_s) {
    return static_cast<Tick>(std::floor(time_s * kTicksPerSecond + 1e-6));
}

/// The instant of a tick that may seal: pressed hardest while the lip lies still. The first that
/// lets go counts above all.
bool tells_more(const limpet_ros::CupContact& now, const limpet_ros::CupContact& than) {
    constexpr auto kHolds = limpet_ros::CupContact::HOLDS;
    const auto rank = [](const limpet_ros::CupContact& c) {
        return std::tuple(c.let_go != kHolds, c.touches, c.lies_still, c.press_N);
    };
    return than.let_go == kHolds && rank(now) > rank(than);
}

}  // namespace

void ApartLip::receive(const limpet_ros::CupState& answer) {
    if (answer.contact < next_) {
        answer_ = answer;
    }
}

std::optional<limpet_ros::CupContact> ApartLip::take_report() {
    return std::exchange(due_, std::nullopt);
}

void ApartLip::collect(const limpet_ros::CupContact& now, CupPhase phase, double time_s) {
    const Tick tick = tick_of(time_s);
    gathered_.touch = now.touch;
    if (anything_ && tick != tick_) {
        const bool quiet =
            phase == CupPhase::attached && gathered_.let_go == limpet_ros::CupContact::HOLDS;
        const bool due_now =
            near_ ? !quiet || due(tick_, kAttached_Hz) : due(tick_, kFar_Hz) || now.touches != 0;
        if (due_now || tick < tick_) {
            gathered_.number = next_++;
            gathered_.header.stamp = ros_time(seconds(tick_));
            due_ = gathered_;
            anything_ = false;
        }
    }
    if (!anything_ || tells_more(now, gathered_)) {
        gathered_ = now;
    }
    anything_ = true;
    tick_ = tick;
    near_ = phase != CupPhase::free || std::abs(now.gap_m) < kNear_m;
}

/// Applies the latest answer where it follows the latest report. Lifting off and touching are found
/// here.
std::optional<Event> ApartLip::obey(suction::CupState& state, double time_s) {
    state.mean_pressure_Pa = answer_.mean_pressure_Pa;
    state.status.pressure_Pa = answer_.pressure_Pa;
    state.status.pump_running = answer_.pump_running != 0;
    state.status.valve_open = answer_.valve_open != 0;
    if (answer_.contact < barrier_ || state.status.phase == CupPhase::free) {
        return std::nullopt;
    }
    const CupPhase before = state.status.phase;
    state.status.seal_threshold_N = answer_.seal_threshold_N;
    const auto phase = static_cast<CupPhase>(answer_.phase);
    state.status.phase = suction::is_sealed(phase) ? phase : CupPhase::touching;
    if (suction::is_sealed(state.status.phase) && !suction::is_sealed(before)) {
        state.let_go_said = false;
    }
    if (state.status.phase == CupPhase::attached && before != CupPhase::attached) {
        return make_event(time_s, "cup", EventName::attached,
                          "pressure below the attachment threshold",
                          {{"pressure_Pa", state.mean_pressure_Pa},
                           {"seal_threshold_N", answer_.seal_threshold_N}});
    }
    return std::nullopt;
}

suction::CupOutput ApartLip::step(const suction::CupModel& model, suction::CupState& state,
                                  const suction::Surface& surface, const Kinematics& cup,
                                  const suction::CupInput& input) {
    suction::CupOutput output;
    output.event = obey(state, input.time_s);
    suction::LipNow lip = feel_lip(model, state, surface, cup, input);
    const bool lets_go = lip.contact.let_go != suction::LetGo::no;
    if (state.status.phase == CupPhase::free && lip.contact.touches) {
        begin_touch(state);
        barrier_ = next_;
    }
    limpet_ros::CupContact now = contact_message(lip.contact);
    now.touch = static_cast<std::uint32_t>(state.touches);
    if (lets_go) {
        if (const auto event = let_go(state, lip.contact, input.time_s)) {
            output.event = event;
        }
    }
    output.wrench_W = load_cup(model, state, surface, input, lip);
    collect(now, state.status.phase, input.time_s);
    if (lets_go) {
        barrier_ = next_;  // the number of the report of this
    }
    return output;
}

}  // namespace limpet::ros
