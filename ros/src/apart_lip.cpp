// SPDX-License-Identifier: Apache-2.0
#include "ros/src/apart_lip.hpp"

#include <cmath>

namespace limpet::ros {
namespace {

/// Farther from the wall than this the lip is told of kFar_Hz times a second; while it hangs there
/// attached kAttached_Hz times.
constexpr double kNear_m = 0.05;
constexpr int kFar_Hz = 100;
constexpr int kAttached_Hz = 250;

Tick tick_of(double time_s) {
    return static_cast<Tick>(std::floor(time_s * kTicksPerSecond + 1e-6));
}

/// The instant of a tick that may seal: pressed hardest while the lip lies still. One that lets go
/// counts above all.
bool tells_more(const suction::LipContact& contact, double press_N, const LipReport& than) {
    if (than.contact.let_go != suction::LetGo::no) {
        return false;
    }
    if (contact.let_go != suction::LetGo::no) {
        return true;
    }
    if (contact.touches != than.contact.touches) {
        return contact.touches;
    }
    if (contact.lies_still != than.contact.lies_still) {
        return contact.lies_still;
    }
    return press_N > than.press_N;
}

}  // namespace

void ApartLip::hear(const LipAnswer& answer) {
    if (answer.contact < next_) {
        answer_ = answer;
    }
}

std::optional<LipReport> ApartLip::take_report() {
    std::optional<LipReport> report;
    std::swap(report, due_);
    return report;
}

void ApartLip::collect(const suction::LipContact& contact, double press_N, CupPhase phase,
                       double time_s) {
    const Tick tick = tick_of(time_s);
    if (anything_ && tick != tick_) {
        const bool quiet =
            phase == CupPhase::attached && gathered_.contact.let_go == suction::LetGo::no;
        const bool due_now =
            near_ ? !quiet || due(tick_, kAttached_Hz) : due(tick_, kFar_Hz) || contact.touches;
        if (due_now || tick < tick_) {
            gathered_.number = next_++;
            gathered_.time_s = seconds(tick_);
            due_ = gathered_;
            anything_ = false;
        }
    }
    if (!anything_ || tells_more(contact, press_N, gathered_)) {
        gathered_.contact = contact;
        gathered_.press_N = press_N;
    }
    anything_ = true;
    tick_ = tick;
    near_ = phase != CupPhase::free || std::abs(contact.gap_m) < kNear_m;
}

/// What was told, where it knows of all that happened here. Lifting off and touching are seen here.
std::optional<Event> ApartLip::obey(suction::CupState& state, double time_s) {
    state.mean_pressure_Pa = answer_.mean_pressure_Pa;
    state.status.pressure_Pa = answer_.pressure_Pa;
    state.status.pump_running = answer_.pump_running;
    state.status.valve_open = answer_.valve_open;
    if (answer_.contact < barrier_ || state.status.phase == CupPhase::free) {
        return std::nullopt;
    }
    const CupPhase before = state.status.phase;
    state.status.seal_threshold_N = answer_.seal_threshold_N;
    state.status.phase = suction::is_sealed(answer_.phase) ? answer_.phase : CupPhase::touching;
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
    const suction::LipNow lip = feel_lip(model, state, surface, cup, input);
    const suction::LipContact& contact = lip.contact;
    const bool lets_go = contact.let_go != suction::LetGo::no;
    if (state.status.phase == CupPhase::free && contact.touches) {
        begin_touch(state);
        barrier_ = next_;
    }
    gathered_.touch = static_cast<std::uint32_t>(state.touches);
    if (lets_go) {
        if (const auto event = let_go(state, contact, input.time_s)) {
            output.event = event;
        }
    }
    output.wrench_W = load_cup(model, state, surface, cup, input, lip);
    collect(contact, input.press_N, state.status.phase, input.time_s);
    if (lets_go) {
        barrier_ = next_;  // the number under which this will be told
    }
    return output;
}

}  // namespace limpet::ros
