// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "adapters/ros2/dds/codec.hpp"
#include "adapters/ros2/dds/settings.hpp"

namespace limpet::ros2 {

/// Quality of service, as far as ROS 2's profiles differ in it; history is "keep last".
struct Profile {
    bool reliable = true;
    bool transient_local = false;  ///< who comes later still gets the last `depth`
    int depth = 10;

    friend bool operator==(const Profile&, const Profile&) = default;
};
// ROS 2's own, by its names.
inline constexpr Profile kSensorData{.reliable = false, .depth = 5};
inline constexpr Profile kServices{.reliable = true, .depth = 10};
inline constexpr Profile kLatched{.reliable = true, .transient_local = true, .depth = 1};

class Writer {
public:
    virtual ~Writer() = default;
    /// @param bytes  of encode(), or a message of a recording
    virtual void write(const Bytes& bytes) = 0;
};

class Client {
public:
    virtual ~Client() = default;
    /// Whether there is somebody to answer.
    [[nodiscard]] virtual bool is_served() const = 0;
    /// Waits for the answer, `patience_s` at most; at once nothing when nobody serves.
    [[nodiscard]] virtual std::optional<Bytes> call(const Bytes& request, double patience_s) = 0;
};

/// Keeps a subscription or a service; gone with it.
using Handle = std::shared_ptr<void>;

/// A node of ROS 2 on the wire: one DDS participant (Fast DDS) whose topics, types, services and
/// ros_discovery_info are named and laid out as rmw_fastrtps has them, so that nodes of rclcpp and
/// the ros2 command line see one of their own. Messages are bytes here (codec.hpp).
///
/// Names are absolute, types as interfaces.py writes them ("std_msgs::msg::dds_::String_"). What is
/// called back comes on DDS's threads, one sample after the other for each subscription.
class Node {
public:
    /// @throws InputError when DDS gives no participant
    explicit Node(const NodeSettings& settings);
    ~Node();
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    [[nodiscard]] const NodeSettings& settings() const;

    [[nodiscard]] std::unique_ptr<Writer> advertise(const std::string& topic,
                                                    const std::string& type,
                                                    const Profile& profile);
    [[nodiscard]] Handle subscribe(const std::string& topic, const std::string& type,
                                   const Profile& profile, std::function<void(Bytes)> receive);
    using Reply = std::function<void(const Bytes&)>;
    /// @param serve  may reply later, from another thread
    [[nodiscard]] Handle serve(const std::string& service, const std::string& request_type,
                               const std::string& response_type,
                               std::function<void(Bytes, Reply)> serve);
    [[nodiscard]] std::unique_ptr<Client> client(const std::string& service,
                                                 const std::string& request_type,
                                                 const std::string& response_type);

    struct Inside;

private:
    std::shared_ptr<Inside> inside_;
};

}  // namespace limpet::ros2
