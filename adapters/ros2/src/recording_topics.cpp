// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/src/recording_topics.hpp"

#include <ros/ros.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "adapters/ros/src/received.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/schema.hpp"
#include "limpet/record/topics.hpp"

namespace limpet::ros {
namespace {

/// "sensor_msgs/msg/Imu" -> "sensor_msgs::msg::dds_::Imu_"
std::string wire_type(std::string_view type) {
    const std::size_t package = type.find('/');
    const std::size_t name = type.rfind('/');
    return std::string(type.substr(0, package)) +
           "::msg::dds_::" + std::string(type.substr(name + 1)) + "_";
}

/// An array of a recording that is a sequence in ROS 2: of rotors, which are as many as a vehicle
/// has.
struct Rotors {
    std::size_t at_bytes = 0;  ///< where it begins
    std::uint8_t count = 0;
};
std::optional<Rotors> rotors_of(const record::SinkChannel& channel) {
    if (!channel.type.starts_with("limpet_msgs/")) {
        return std::nullopt;
    }
    const auto types =
        record::parse_ros2msg(std::string(channel.type), std::string(channel.schema));
    Rotors rotors;
    bool eights = true;
    for (const record::Field& field : types.front().fields) {
        if (field.shape == record::Field::Shape::fixed_array) {
            require(eights, "stamps and float64 alone stand before rotors");
            rotors.count = static_cast<std::uint8_t>(field.count);
            return rotors;
        }
        rotors.at_bytes += sizeof(double);
        eights = eights && (field.primitive == record::Primitive::float64 ||
                            field.primitive == record::Primitive::time);
    }
    return std::nullopt;
}
/// Puts the count before them. It takes eight bytes, with what aligns: the rest stays aligned.
void make_sequence(ros2::Bytes& bytes, const Rotors& rotors) {
    const std::array<std::uint8_t, sizeof(double)> count{rotors.count};
    bytes.insert(
        bytes.begin() + static_cast<std::ptrdiff_t>(ros2::kEncapsulation_bytes + rotors.at_bytes),
        count.begin(), count.end());
}

class RecordingTopics final : public record::MessageSink {
public:
    void channel(const record::SinkChannel& channel) override {
        if (record::is_of_scene(channel.topic)) {
            return;  // those of adapters/ros/src/scene_topics.hpp
        }
        const std::string name = "limpet" + std::string(channel.topic);
        ros2::Node& node = ::ros::detail::node();
        const std::string type = wire_type(channel.type);
        constexpr std::uint32_t kDepth = 100;
        std::shared_ptr<ros2::Writer>& writer = writers_[name];  // the flight before had it too
        if (!writer) {
            writer = node.advertise(node.settings().resolve(name), type,
                                    ::ros::detail::profile_of(type, kDepth));
        }
        topics_[channel.id] = {writer, rotors_of(channel)};
    }

    void message(std::uint16_t channel, std::uint64_t /*time_ns*/, mcap::ByteView data) override {
        const auto topic = topics_.find(channel);
        if (topic == topics_.end()) {
            return;
        }
        ros2::Bytes bytes(data.begin(), data.end());
        shift(bytes);
        if (topic->second.rotors) {
            make_sequence(bytes, *topic->second.rotors);
        }
        topic->second.writer->write(bytes);
    }

private:
    /// What a message begins with.
    struct Stamp {
        ::ros::Time stamp;
        template <class Self, class Visit>
        static void visit(Self& self, Visit&& each) {
            each(self.stamp);
        }
    };

    /// From the flight's time to /clock's.
    static void shift(ros2::Bytes& bytes) {
        const auto flight = ros2::decode<Stamp>(bytes);
        const ros2::Bytes stamp = ros2::encode(
            Stamp{::ros::Time(flight.value().stamp.toSec() + Received::kClockStart_s)});
        std::copy(stamp.begin(), stamp.end(), bytes.begin());
    }

    std::map<std::string, std::shared_ptr<ros2::Writer>> writers_;
    struct Topic {
        std::shared_ptr<ros2::Writer> writer;
        std::optional<Rotors> rotors;
    };
    std::map<std::uint16_t, Topic> topics_;  ///< of this flight
};

}  // namespace

std::unique_ptr<record::MessageSink> recording_topics() {
    return std::make_unique<RecordingTopics>();
}

}  // namespace limpet::ros
