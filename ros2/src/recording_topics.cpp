// SPDX-License-Identifier: Apache-2.0
#include "ros/src/recording_topics.hpp"

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
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

/// Time zero of a flight, on /clock.
double flight_start_s() {
    Heard heard({}, false);
    static_cast<void>(heard.tick(0.0));
    return heard.clock_s();
}

class RecordingTopics final : public record::MessageSink {
public:
    void channel(const record::SinkChannel& channel) override {
        using record::is_of_scene;
        if (channel.topic == record::kMarkersTopic) {
            return;  // arrows and beams: their stamps lie deep inside, and RViz has its own
        }
        const bool stays =
            channel.topic == record::kDescriptionTopic || channel.topic == record::kStandingTopic;
        // Of viewers, under the names that they look for.
        const std::string name =
            (is_of_scene(channel.topic) ? "" : "limpet") + std::string(channel.topic);
        ros2::Node& node = ::ros::detail::node();
        const std::string type = wire_type(channel.type);
        constexpr std::uint32_t kAsTf2 = 100;
        topics_[channel.id] = {
            .writer = node.advertise(
                node.settings().resolve(is_of_scene(channel.topic) ? name.substr(1) : name), type,
                stays ? ros2::kLatched : ::ros::detail::profile_of(type, kAsTf2)),
            .kind = channel.topic == record::kDescriptionTopic ? Kind::timeless
                    : is_of_scene(channel.topic)               ? Kind::transforms
                                                               : Kind::stamped};
    }

    void message(std::uint16_t channel, std::uint64_t /*time_ns*/, mcap::ByteView data) override {
        const auto topic = topics_.find(channel);
        if (topic == topics_.end()) {
            return;
        }
        ros2::Bytes bytes(data.begin(), data.end());
        switch (topic->second.kind) {
            case Kind::timeless: break;
            case Kind::stamped: shift(bytes); break;
            case Kind::transforms: shift_transforms(bytes); break;
        }
        topic->second.writer->write(bytes);
    }

private:
    enum class Kind {
        stamped,     ///< begins with its stamp
        transforms,  ///< a TFMessage
        timeless,
    };
    struct Topic {
        std::unique_ptr<ros2::Writer> writer;
        Kind kind = Kind::stamped;
    };
    struct Stamp {
        ::ros::Time stamp;
        template <class Self, class Visit>
        static void visit(Self& self, Visit&& each) {
            each(self.stamp);
        }
    };

    [[nodiscard]] ::ros::Time on_clock(const ::ros::Time& flight) const {
        return ::ros::Time(flight.toSec() + start_s_);
    }
    void shift(ros2::Bytes& bytes) const {
        const auto told = ros2::decode<Stamp>(bytes);
        const ros2::Bytes stamp = ros2::encode(Stamp{on_clock(told.value().stamp)});
        std::copy(stamp.begin(), stamp.end(), bytes.begin());
    }
    void shift_transforms(ros2::Bytes& bytes) const {
        auto transforms = ros2::decode<tf2_msgs::TFMessage>(bytes).value();
        for (auto& transform : transforms.transforms) {
            transform.header.stamp = on_clock(transform.header.stamp);
        }
        bytes = ros2::encode(transforms);
    }

    double start_s_ = flight_start_s();
    std::map<std::uint16_t, Topic> topics_;
};

}  // namespace

std::unique_ptr<record::MessageSink> recording_topics() {
    return std::make_unique<RecordingTopics>();
}

}  // namespace limpet::ros
