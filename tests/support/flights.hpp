// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "limpet/models/model_writer.hpp"
#include "limpet/record/recorder.hpp"
#include "limpet/record/recording.hpp"

/// Flights that never flew: drawn by formulas, so that a test knows every number.
namespace limpet::test {

/// A folder of a test's own, gone with it.
class Folder {
public:
    Folder() {
        std::string name =
            (std::filesystem::temp_directory_path() / "limpet_report.XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline double smoothstep(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// One attempt of the paper's manoeuvre on concrete, from the pre-position on; without a seal it
/// ends in the retreat. Times are those since it began.
struct Attempt {
    static constexpr double kWall_m = 3.0;    ///< north of the origin
    static constexpr double kHeight_m = 1.5;  ///< of the vehicle over the origin
    static constexpr double kPre_m = kWall_m - 1.705;
    static constexpr double kTouch_m = kWall_m - 0.50;
    static constexpr double kApproach_s = 2.6;
    static constexpr double kImpact_s = 3.9;
    static constexpr double kDecision_s = 4.4;
    static constexpr double kPerched_s = 10.6;
    static constexpr double kMotorsOn_s = 17.6;
    static constexpr double kLevel_s = 24.1;
    static constexpr double kReleased_s = 25.06;
    static constexpr double kBack_s = 27.8;
    static constexpr double kEnd_s = 28.5;
    static constexpr double kFailedEnd_s = 8.0;
    static constexpr double kPitch_deg = 66.5;

    bool sealed = true;
    double begin_s = 0.0;  ///< when it began

    [[nodiscard]] double pitch_rad(double t) const {
        const double lean =
            -4.0 * smoothstep((t - kApproach_s) / 0.3) * smoothstep((kImpact_s + 0.1 - t) / 0.3);
        const double up = smoothstep((t - kDecision_s) / 5.0);
        const double down = 1.0 - smoothstep((t - kMotorsOn_s - 1.0) / 5.0);
        return radians(lean + (sealed ? kPitch_deg * up * down : 0.0));
    }
    [[nodiscard]] static double slider_m(double t) {
        const double u = (t - kImpact_s) / 0.22;
        return u > 0.0 && u < 1.0 ? -0.06 * std::sin(kPi * u) : 0.0;
    }
    [[nodiscard]] double slider_force_N(double t) const {
        const double u = (t - kImpact_s) / 0.22;
        const double pressed = u > 0.0 && u < 1.0 ? -42.0 * std::sin(kPi * u) : 0.0;
        const double rebound = u > 1.0 ? 45.0 * std::exp(-(u - 1.0) / 0.3) : 0.0;
        const double hang = 10.0 * smoothstep((t - kDecision_s) / 5.0) *
                            (1.0 - smoothstep((t - kMotorsOn_s) / 6.0));
        return pressed + (sealed ? rebound + hang : 0.0);
    }
    [[nodiscard]] double pressure_Pa(double t) const {
        constexpr double kVacuum_Pa = 65000.0, kDrop_Pa = kAtmosphere_Pa - kVacuum_Pa;
        if (!sealed || t < kImpact_s) {
            return kAtmosphere_Pa;
        }
        return t < kLevel_s ? kVacuum_Pa + kDrop_Pa * std::exp(-(t - kImpact_s) / 0.33)
                            : kAtmosphere_Pa - kDrop_Pa * std::exp(-(t - kLevel_s) / 0.40);
    }
    [[nodiscard]] double thrust_N(double t) const {
        const double off = smoothstep((t - kDecision_s - 5.0) / 1.0);
        const double on = smoothstep((t - kMotorsOn_s) / 1.0);
        return 3.2 * kGravity_m_s2 * std::cos(pitch_rad(t)) * (sealed ? 1.0 - off + on : 1.0);
    }
    [[nodiscard]] bool attached(double t) const {
        return sealed && t > kImpact_s && t < kReleased_s;
    }

    [[nodiscard]] Truth truth(double t) const {
        Truth truth;
        truth.time_s = t + begin_s;
        const double pitch = pitch_rad(t);
        truth.slider.position_m = slider_m(t);
        truth.slider.force_N = slider_force_N(t);
        truth.base.q_WF = quaternion_from_euler({.pitch_rad = pitch});
        truth.cup.q_WF = attached(t) ? Quaternion::Identity() : truth.base.q_WF;
        const double out = smoothstep((t - kApproach_s) / (kImpact_s - kApproach_s));
        const double back = sealed ? smoothstep((t - kReleased_s) / (kBack_s - kReleased_s))
                                   : smoothstep((t - kDecision_s) / 2.5);
        truth.base.p_WF_m = {kPre_m + (kTouch_m - kPre_m) * out * (1.0 - back), 0.0, -kHeight_m};
        if (attached(t)) {
            const double arm_m = 0.46 + truth.slider.position_m;
            truth.base.p_WF_m.x() = kWall_m - 0.04 - arm_m * std::cos(pitch);
            truth.base.p_WF_m.z() = -kHeight_m + arm_m * std::sin(pitch);
        }
        truth.cup_status.pressure_Pa = pressure_Pa(t);
        truth.thrust_N = thrust_N(t);
        truth.rotor_speed_rad_s = RotorList<double>(4, std::sqrt(truth.thrust_N / 4.0 / 2.5e-5));
        return truth;
    }
};

/// An event of guidance or the cup.
struct Note {
    double t = 0.0;
    EventName event = EventName::aborted;
    const char* station = "guidance";
    const char* state = nullptr;  ///< the state that begins; nullptr for none
};

inline std::vector<Note> story_of(const Attempt& attempt) {
    using A = Attempt;
    std::vector<Note> notes = {
        {2.0, EventName::pre_positioned, "guidance", "aligning"},
        {A::kApproach_s, EventName::approach_started, "guidance", "approaching"},
        {A::kImpact_s, EventName::impact, "guidance", "holding"},
    };
    if (!attempt.sealed) {
        notes.push_back({A::kImpact_s + 0.22, EventName::contact_lost, "cup"});
        notes.push_back({A::kDecision_s, EventName::hold_over});
        notes.push_back({A::kDecision_s, EventName::retreat_started, "guidance", "retreating"});
        return notes;
    }
    const std::vector<Note> success = {
        {A::kImpact_s + 0.17, EventName::attached, "cup"},
        {A::kDecision_s, EventName::hold_over},
        {A::kDecision_s, EventName::landing_started, "guidance", "pitching_up"},
        {A::kPerched_s, EventName::perched},
        {A::kPerched_s, EventName::motors_off, "guidance", "resting"},
        {A::kMotorsOn_s, EventName::motors_on, "guidance", "pitching_down"},
        {A::kLevel_s, EventName::level},
        {A::kLevel_s, EventName::pump_off, "guidance", "releasing"},
        {A::kReleased_s, EventName::pressure_released, "guidance", "backing_off"},
        {A::kReleased_s + 0.06, EventName::detached, "cup"},
        {A::kBack_s, EventName::backed_off, "guidance", "finished"},
    };
    notes.insert(notes.end(), success.begin(), success.end());
    return notes;
}

struct RecordedFlight {
    double to_s = Attempt::kEnd_s;  ///< nothing is recorded from there on
    bool failed_first = false;      ///< an attempt without a seal comes before
    bool cup = true;
    bool model = true;
    bool finish = true;
};

inline record::RecordingInfo recording_info(const RecordedFlight& what) {
    record::RecordingInfo info{.scenario = what.cup ? "perch_concrete" : "hover",
                               .seed = 7,
                               .version = "test",
                               .numbers = {},
                               .attachments = {},
                               .range_sensor = {}};
    if (what.cup) {
        info.numbers = {{"land_pressure_Pa", "87000"}, {"detach_pressure_Pa", "97000"}};
    }
    if (what.model) {
        models::Scene scene;
        scene.wall.p_WT_m = {Attempt::kWall_m, 0.0, -Attempt::kHeight_m};
        vehicle::Airframe airframe;
        airframe.has_cup = what.cup;
        info.attachments.push_back({.name = "model.xml",
                                    .media_type = "application/xml",
                                    .text = write_mjcf(airframe, scene),
                                    .log_time_ns = 0});
    }
    return info;
}

/// The sensors' error at a time: a ripple of this shape, sized by each sensor.
inline double ripple(double t) {
    return std::sin(140.0 * t);
}

/// Everything that is sampled, at one instant.
inline void record_sample(record::Recorder& recorder, const Attempt& attempt, double t, bool cup) {
    const Truth truth = attempt.truth(t);
    const double time_s = truth.time_s;
    recorder.truth(truth);
    Estimate estimate;
    estimate.time_s = time_s;
    estimate.q_WB =
        quaternion_from_euler({.pitch_rad = attempt.pitch_rad(t) + radians(0.3) * ripple(t)});
    recorder.estimate(estimate);
    const double range_m = Attempt::kWall_m - truth.base.p_WF_m.x() - 0.205;
    const bool seen = attempt.pitch_rad(t) < radians(50.0);
    recorder.range_left({time_s, {range_m + 0.005 * ripple(t), seen}});
    recorder.range_right({time_s, {range_m - 0.005 * ripple(t), seen}});
    if (cup) {
        recorder.force({time_s, {truth.slider.force_N + 0.4 * ripple(t)}});
        recorder.cup_pressure({time_s, {truth.cup_status.pressure_Pa + 120.0 * ripple(t)}});
    }
}

inline void record_attempt(record::Recorder& recorder, const Attempt& attempt,
                           const RecordedFlight& what, double end_s) {
    constexpr double kStep_s = 0.004;
    const std::vector<Note> notes = story_of(attempt);
    auto note = notes.begin();
    if (what.cup) {
        recorder.guidance(attempt.begin_s, "pre_positioning", 1);
    }
    for (int i = 0; i * kStep_s < end_s; ++i) {
        const double t = i * kStep_s;
        for (; what.cup && note != notes.end() && note->t <= t; ++note) {
            recorder.event(make_event(note->t + attempt.begin_s, note->station, note->event));
            if (note->state != nullptr) {
                recorder.guidance(note->t + attempt.begin_s, note->state, 1);
            }
        }
        record_sample(recorder, attempt, t, what.cup);
    }
}

/// Writes a recording.
/// @return its file: PATH, or PATH.part when it was not finished
inline std::filesystem::path write_flight(const std::filesystem::path& path,
                                          const RecordedFlight& what = {}) {
    record::Recorder recorder(path, recording_info(what));
    Attempt attempt;
    if (what.failed_first) {
        record_attempt(recorder, {.sealed = false}, what, Attempt::kFailedEnd_s);
        attempt.begin_s = Attempt::kFailedEnd_s;
    }
    record_attempt(recorder, attempt, what, what.to_s);
    if (!what.finish) {
        return std::filesystem::path(path) += ".part";
    }
    recorder.finish(what.cup ? R"({"outcome": "released", "reason": "back at the pre-position"})"
                             : R"({"outcome": "released", "reason": "hovered as asked"})");
    return path;
}

/// The same, read back.
inline record::Recording fly(const RecordedFlight& what = {}) {
    const Folder folder;
    return record::read_recording(write_flight(folder.path() / "flight.mcap", what));
}

/// A flight whose file ends in the middle.
inline record::Recording fly_and_cut(double share) {
    const Folder folder;
    const auto path = write_flight(folder.path() / "flight.mcap");
    const auto size = static_cast<double>(std::filesystem::file_size(path));
    std::filesystem::resize_file(path, static_cast<std::uintmax_t>(share * size));
    return record::read_recording(path);
}

}  // namespace limpet::test
