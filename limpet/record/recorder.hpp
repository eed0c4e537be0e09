// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/core/rotor_list.hpp"
#include "limpet/core/signals/consistency.hpp"
#include "limpet/core/signals/estimate.hpp"
#include "limpet/core/signals/event.hpp"
#include "limpet/core/signals/readings.hpp"
#include "limpet/core/signals/rotor_command.hpp"
#include "limpet/core/signals/setpoint.hpp"
#include "limpet/core/signals/truth.hpp"
#include "limpet/record/message_writer.hpp"
#include "limpet/record/scene.hpp"
#include "limpet/record/topics.hpp"

namespace limpet::record {

/// A channel of plain numbers, of a sensor that no topic in topics.hpp is for.
struct ColumnChannel {
    std::string_view topic;                     ///< "/sensors/NAME"
    std::string_view type;                      ///< "limpet_msgs/msg/Name"
    std::span<const std::string_view> columns;  ///< with their units
};

/// What a Range message says of its sensor besides the reading.
struct RangeSensor {
    double field_of_view_rad = radians(3.6);  ///< Source: TFmini Plus data sheet
    double minimum_m = 0.1;                   ///< Source: TFmini Plus data sheet
    double maximum_m = 12.0;                  ///< Source: TFmini Plus data sheet
};

/// What a recording says of itself. Nothing in it may depend on the wall clock or the machine.
struct RecordingInfo {
    std::string scenario;
    std::optional<std::uint64_t> seed = {};  ///< of a simulation
    std::string version;                     ///< of limpet
    /// Numbers that a reader of the recording needs: {"land_pressure_Pa", "88000"}.
    mcap::StringMap numbers = {};
    std::vector<mcap::Attachment> attachments;  ///< "scenario.yaml", "model.xml"
    RangeSensor range_sensor;
    std::size_t rotors = 4;  ///< so many numbers in a field that has one for each, <= kMaxRotors
    std::vector<ColumnChannel> columns = {};
    std::optional<Scene> scene = {};  ///< with it the recording shows itself in three dimensions
    MessageSink* mirror = nullptr;    ///< takes the same messages; lives as long
    bool compress = true;             ///< zstd; without, a reader has less to do
    std::vector<std::string> topics = {};  ///< that are recorded; none: all of them
};

/// Writes a flight as MCAP: topics.hpp lists the channels. Log times are simulated nanoseconds from
/// 0, so that the same flight gives the same bytes. Our signals become ROS 2 messages in CDR, whose
/// fields stand in msg/: ROS's own in its frames (ros_frames.hpp), limpet_msgs
/// as they are. A text has at most 256 characters, else InternalError: texts are names and reasons.
///
/// The file grows as PATH.part and becomes PATH in finish(); PATH.part of a run that died is
/// readable (limpet/mcap/writer.hpp). Between constructor and finish() nothing is allocated.
class Recorder {
public:
    /// Writes metadata "limpet" (scenario, seed, version), attachments, schemas and channels, which
    /// thereby survive whatever happens later.
    /// @throws InputError if the file cannot be written
    Recorder(const std::filesystem::path& path, const RecordingInfo& info);

    // A sample is recorded at its own time, that of the measurement [s], >= 0.
    void imu(const Sample<ImuReading>& sample);
    /// An invalid reading is +infinity (REP 117: nothing within range).
    void range_left(const Sample<RangeReading>& sample);
    void range_right(const Sample<RangeReading>& sample);
    void force(const Sample<ForceReading>& sample);
    void cup_pressure(const Sample<PressureReading>& sample);
    void motion_capture(const Sample<PoseReading>& sample);
    void barometer(const Sample<BarometerReading>& sample);
    void magnetometer(const Sample<MagnetometerReading>& sample);
    void gps(const Sample<GpsReading>& sample);
    void battery(const Sample<BatteryReading>& sample);
    /// All of these whose sample is newer than in `last`, which then holds them.
    void new_readings(const Readings& readings, Readings& last);

    /// Into RecordingInfo::columns[channel], when it is newer than the last one there.
    template <class T>
    void columns(std::size_t channel, const Sample<T>& sample, std::span<const double> numbers) {
        if (sample.newer_than(columns_[channel].last_s)) {
            write_columns(columns_[channel], sample.time_s, numbers);
        }
    }

    /// Five messages: pose, twist, vehicle, cup, wrench of the cup; and where the bodies are.
    void truth(const Truth& truth);
    /// Arrows, beams and path, if there is a scene.
    void scene(const Truth& truth, const Readings& readings, const Setpoint& setpoint);
    void estimate(const Estimate& estimate);
    void consistency(const Consistency& consistency);
    void setpoint(double time_s, const Setpoint& setpoint);
    void guidance(double time_s, std::string_view state, int attempt);
    void rotor_command(double time_s, const RotorCommand& command);
    void event(const Event& event);

    /// Attaches "summary.json", writes the index and gives the file its name.
    /// @throws InputError if the disk does not take it
    void finish(const std::string& summary_json);

    [[nodiscard]] const std::filesystem::path& path() const { return writer_.file().path(); }

private:
    struct Columns {
        std::uint16_t channel = 0;
        double last_s = -std::numeric_limits<double>::infinity();
    };
    /// As many as the definitions say; 0 where there is none.
    [[nodiscard]] std::span<const double> each_rotor(const RotorList<double>& numbers) const;
    void write_columns(Columns& to, double time_s, std::span<const double> numbers);

    // A message is a stamp and fields, in the order of their definition.
    template <class... Fields>
    void write(Topic topic, double time_s, const Fields&... fields);
    void range(Topic topic, std::string_view frame, const Sample<RangeReading>& sample);
    void pressure(Topic topic, double time_s, std::string_view frame, double pressure_Pa);
    /// In "map".
    void pose(Topic topic, double time_s, const Vector3& p_WB_m, const Quaternion& q_WB);
    /// In "base_link", both parts, as nav_msgs/Odometry has it.
    void twist(Topic topic, double time_s, const Quaternion& q_WB, const Vector3& v_WB_W_m_s,
               const Vector3& w_WB_B_rad_s);
    /// @param wrench  in a forward-right-down frame called `frame` when turned to forward-left-up
    void wrench(Topic topic, double time_s, std::string_view frame, const Wrench& wrench);

    MessageWriter writer_;
    RangeSensor range_sensor_;
    std::size_t rotors_;
    std::array<std::uint16_t, kTopics.size()> channels_{};
    std::vector<Columns> columns_;
    std::optional<SceneWriter> scene_;
};

}  // namespace limpet::record
