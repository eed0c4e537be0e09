// SPDX-License-Identifier: Apache-2.0
#include "ros2/src/recording_topics.hpp"

#include <ros/ros.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "limpet/record/topics.hpp"
#include "ros/src/heard.hpp"

namespace limpet::ros {
namespace {

/// "sensor_msgs/msg/Imu" -> "sensor_msgs::msg::dds_::Imu_"
std::string wire_type(std::string_view type) {
    const std::size_t package = type.find('/');
    const std::size_t name = type.rfind('/');
    return std::string(type.substr(0, package)) +
           "::msg::dds_::" + std::string(type.substr(name + 1)) + "_";
}

class RecordingTopics final : public record::MessageSink {
public:
    void channel(const record::SinkChannel& channel) override {
        if (record::is_of_scene(channel.topic)) {
            return;  // those of ros/src/scene_topics.hpp
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
        topics_[channel.id] = writer;
    }

    void message(std::uint16_t channel, std::uint64_t /*time_ns*/, mcap::ByteView data) override {
        const auto topic = topics_.find(channel);
        if (topic == topics_.end()) {
            return;
        }
        ros2::Bytes bytes(data.begin(), data.end());
        shift(bytes);
        topic->second->write(bytes);
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
        const auto told = ros2::decode<Stamp>(bytes);
        const ros2::Bytes stamp =
            ros2::encode(Stamp{::ros::Time(told.value().stamp.toSec() + Heard::kClockStart_s)});
        std::copy(stamp.begin(), stamp.end(), bytes.begin());
    }

    std::map<std::string, std::shared_ptr<ros2::Writer>> writers_;
    std::map<std::uint16_t, std::shared_ptr<ros2::Writer>> topics_;  ///< of this flight
};

}  // namespace

std::unique_ptr<record::MessageSink> recording_topics() {
    return std::make_unique<RecordingTopics>();
}

}  // namespace limpet::ros
