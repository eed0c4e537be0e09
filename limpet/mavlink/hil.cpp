// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/hil.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::mavlink {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;

/// So that Ctrl-C is noticed.
constexpr milliseconds kSlice{100};
/// Until the first answer: long enough for one to come, short enough to go on booting.
constexpr milliseconds kBootWait{4};
/// Half a period at 250 Hz: the motors are then for these sensors, not for the last ones.
constexpr milliseconds kRealTimeWait{2};
/// One that has not answered by then is not booting but slow: it must not be left far behind, or
/// who receives what when would depend on the machine. Source: px4.md "Simulator link", first
/// answer to 22 to 34
constexpr std::size_t kBootSensors = 50;
constexpr milliseconds kSlowBootWait{50};
/// It has answered earlier sensors just now: the answer to these is on its way.
constexpr milliseconds kCatchUpWait{1000};

}  // namespace

Hil::Hil(Link& link, const HilOptions& options) : link_(link), options_(options) {}

void Hil::send(const Readings& readings, std::uint64_t time_usec,
               const std::function<void()>& hand_over) {
    if (sends_ == 0) {
        generation_ = link_.generation();
        began_ = Clock::now();
    }
    if (began_anew(readings, last_)) {
        last_ = {};
    }
    link_.cork();
    if (readings.gps.newer_than(last_.gps)) {
        (void)link_.send(
            hil_gps(readings.gps.value, options_.origin, options_.utc_start_us + time_usec));
    }
    if (options_.motion_capture && readings.motion_capture.newer_than(last_.motion_capture)) {
        (void)link_.send(odometry(readings.motion_capture.value, time_usec));
    }
    const HilSensor sensor = hil_sensor(readings, last_, time_usec);
    last_ = readings;
    (void)link_.send(sensor);
    Sent& sent = sent_[sends_ % sent_.size()];
    const Sent& before = sent_[(sends_ + sent_.size() - 1) % sent_.size()];
    sent = {.time_usec = time_usec, .at = Clock::now(), .gone = {}};
    if (options_.timing == HilTiming::real_time && sends_ > 0) {
        const double meant_s = 1e-6 * static_cast<double>(time_usec - before.time_usec);
        const double took_s = duration<double>(sent.at - before.at).count();
        count_.send_jitter.add(std::abs(took_s - meant_s));
    }
    if (hand_over) {
        hand_over();
    }
    if (link_.uncork() == wire::TransferStatus::done) {
        ++count_.sensors_sent;
    }
    sent.gone = Clock::now();
    ++sends_;
}

const Hil::Sent* Hil::sent_at(std::uint64_t time_usec) const {
    const auto found = std::find_if(sent_.begin(), sent_.end(), [&](const Sent& sent) {
        return sent.time_usec == time_usec && time_usec != 0;
    });
    return found == sent_.end() ? nullptr : &*found;
}

bool Hil::take(const Frame& frame, const Others& others) {
    const auto controls = decode<HilActuatorControls>(frame);
    if (!controls) {
        others(frame);
        return false;
    }
    const Clock::time_point now = Clock::now();
    const Sent* question = sent_at(controls->time_usec);
    if (question == nullptr && options_.timing == HilTiming::lockstep) {
        ++count_.strays;  // a clock that is not ours
        return false;
    }
    if (question != nullptr) {
        count_.round_trip.add(duration<double>(now - question->at).count());
    }
    command_ = rotor_command(*controls);
    answered_usec_ = controls->time_usec;
    answered_at_ = now;
    ++count_.answers;
    return true;
}

milliseconds Hil::patience() const {
    if (answered_ever_) {
        return options_.answer_limit;
    }
    if (count_.answers > 0) {
        return std::min(options_.answer_limit, kCatchUpWait);
    }
    return sends_ > kBootSensors ? kSlowBootWait : kBootWait;
}

std::optional<HilStatus> Hil::ended() const {
    if (options_.stop != nullptr && *options_.stop) {
        return HilStatus::interrupted;
    }
    return link_.generation() != generation_ ? std::optional(HilStatus::gone) : std::nullopt;
}

/// Of one that has never answered.
HilStatus Hil::unanswered() const {
    return Clock::now() - began_ > options_.boot_limit ? HilStatus::silent : HilStatus::waiting;
}

HilStatus Hil::in_lockstep(const Others& others) {
    const std::uint64_t time_usec = question().time_usec;
    const Clock::time_point begin = Clock::now();
    // An answer that is there already has waited for us.
    Clock::duration ours = begin - question().gone;
    Clock::duration left{};
    while (answered_usec_ != time_usec) {
        if (const auto frame = link_.receive(std::min<Clock::duration>(kSlice, left))) {
            take(*frame, others);
        } else {
            ours = {};
        }
        if (const auto over = ended()) {
            return *over;
        }
        left = begin + patience() - Clock::now();
        if (left <= Clock::duration::zero()) {
            break;
        }
    }
    count_.waited_s += duration<double>(Clock::now() - question().at - ours).count();
    if (answered_usec_ == time_usec) {
        answered_ever_ = true;
        return HilStatus::answered;
    }
    if (!answered_ever_) {
        return unanswered();
    }
    ++count_.unanswered;
    return HilStatus::silent;
}

HilStatus Hil::in_real_time(const Others& others) {
    const std::uint64_t time_usec = question().time_usec;
    const Clock::time_point end = question().at + kRealTimeWait;
    bool settled = false;
    for (int k = 0; k < kFramesAtOnce; ++k) {
        const auto left = settled ? Clock::duration::zero() : end - Clock::now();
        const auto frame = link_.receive(std::max(Clock::duration::zero(), left));
        if (!frame) {
            break;
        }
        const bool answer = take(*frame, others);
        answered_ever_ = answer || answered_ever_;
        // a board with a clock of its own answers no one question
        settled = settled ||
                  (answer && (answered_usec_ == time_usec || sent_at(answered_usec_) == nullptr));
    }
    if (const auto over = ended()) {
        return *over;
    }
    if (!answered_ever_) {
        return unanswered();
    }
    const bool stale =
        duration<double>(Clock::now() - answered_at_).count() > options_.stale_limit_s;
    return stale ? HilStatus::silent : HilStatus::answered;
}

HilStatus Hil::receive(const Others& others) {
    return options_.timing == HilTiming::lockstep ? in_lockstep(others) : in_real_time(others);
}

}  // namespace limpet::mavlink
