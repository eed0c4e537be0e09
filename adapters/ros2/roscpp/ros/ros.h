// SPDX-License-Identifier: Apache-2.0
#pragma once

// The part of roscpp's interface that Limpet's nodes use (adapters/ros/src), on ROS 2's wire
// (adapters/ros2/dds/node.hpp): they are written once and compiled for both. What differs between
// the two: names of interfaces are ROS 1's, bytes and names on the wire ROS 2's; a parameter of
// another node is a topic of that name that stays (std_msgs/String); a connection's manners follow
// from its type, profile_of().

#include <ros/callback_queue.h>
#include <ros/time.h>

#include <algorithm>
#include <atomic>
#include <boost/function.hpp>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "adapters/ros2/dds/node.hpp"

namespace XmlRpc {

/// A parameter's value: a text, a list or a map of them. Numbers and switches are texts here; who
/// reads them checks them (limpet/scenario/yaml_reader.hpp).
class XmlRpcValue {
public:
    enum Type {
        TypeInvalid,
        TypeBoolean,
        TypeInt,
        TypeDouble,
        TypeString,
        TypeArray,
        TypeStruct,
    };
    using Members = std::map<std::string, XmlRpcValue>;

    XmlRpcValue() = default;
    XmlRpcValue(std::string text) : type_(TypeString), text_(std::move(text)) {}
    XmlRpcValue(double number) : type_(TypeDouble), text_(std::to_string(number)) {}

    [[nodiscard]] Type getType() const { return type_; }
    [[nodiscard]] int size() const { return static_cast<int>(items_.size()); }
    void setSize(int size) {
        type_ = TypeArray;
        items_.resize(static_cast<std::size_t>(size));
    }
    XmlRpcValue& operator[](int at) {  // grows, as XmlRpc's does
        setSize(std::max(size(), at + 1));
        return items_[static_cast<std::size_t>(at)];
    }
    XmlRpcValue& operator[](const std::string& key) {
        type_ = TypeStruct;
        return members_[key];
    }
    /// Of a map; what was nothing becomes an empty one.
    Members::iterator begin() {
        type_ = type_ == TypeInvalid ? TypeStruct : type_;
        return members_.begin();
    }
    Members::iterator end() { return members_.end(); }

    explicit operator std::string() const { return text_; }
    // Of types that no value has here.
    explicit operator bool() const { return text_ == "true"; }
    explicit operator int() const { return std::stoi(text_); }
    explicit operator double() const { return std::stod(text_); }

    friend bool operator==(const XmlRpcValue&, const XmlRpcValue&) = default;

private:
    Type type_ = TypeInvalid;
    std::string text_;
    std::vector<XmlRpcValue> items_;
    Members members_;
};

}  // namespace XmlRpc

namespace ros {

/// @throws limpet::InputError for arguments that are none of ROS 2's
void init(int argc, char** argv, const std::string& name);
/// Until Ctrl-C, SIGTERM or shutdown().
[[nodiscard]] bool ok();
void shutdown();
/// Makes calls and timers due, in this thread, while ok().
void spin();

namespace this_node {
[[nodiscard]] const std::string& getName();
}

namespace param {
/// @return whether there is such a one: of this node all its own (this_node::getName()), of others
/// their values
[[nodiscard]] bool get(const std::string& name, XmlRpc::XmlRpcValue& value);
void set(const std::string& name, const XmlRpc::XmlRpcValue& value);
}  // namespace param

namespace service {
/// Whether a client of this node has found a server of it.
[[nodiscard]] bool exists(const std::string& name, bool print_failure_reason);
}  // namespace service

namespace service_traits {
template <class Service>
[[nodiscard]] const char* datatype(const Service&) {
    return Service::Request::kType;
}
template <class Service>
[[nodiscard]] const char* md5sum(const Service&) {
    return "none, ROS 2 has no sums";
}
}  // namespace service_traits

namespace detail {

[[nodiscard]] limpet::ros2::Node& node();
[[nodiscard]] CallbackQueue& global_queue();
/// As MAVROS has them: measurements, estimates and set-points are sent once, all else arrives.
[[nodiscard]] limpet::ros2::Profile profile_of(const std::string& type, std::uint32_t queue);
/// Its client, by which service::exists() knows.
[[nodiscard]] std::shared_ptr<limpet::ros2::Client> client(const std::string& service,
                                                           const std::string& request_type,
                                                           const std::string& response_type);
/// Logs once for a topic that a message there does not fit its type.
void report_unsound(const std::string& topic, const std::string& type);

/// Numbered as rcl_interfaces/Log has them.
enum class Level : std::uint8_t {
    info = 20,
    warn = 30,
    error = 40
};
struct Place {
    const char* file;
    const char* function;
    int line;
};
/// A line of the node's log, formatted as by printf: to standard output, from a warning on to
/// standard error, and to /rosout.
[[gnu::format(printf, 3, 4)]] void print(Level level, const Place& place, const char* format, ...);

struct TimerState {
    double period_s = 0.0;
    double due_s = -1.0;  ///< < 0: not begun
    double last_s = -1.0;
    boost::function<void()> call;
};
void add_timer(const std::shared_ptr<TimerState>& timer);

}  // namespace detail

class Publisher {
public:
    Publisher() = default;
    explicit Publisher(std::unique_ptr<limpet::ros2::Writer> writer) : writer_(std::move(writer)) {}
    template <class Message>
    void publish(const Message& message) const {
        writer_->write(limpet::ros2::encode(message));
    }

private:
    std::shared_ptr<limpet::ros2::Writer> writer_;
};

struct Subscriber {
    limpet::ros2::Handle handle;
};
struct ServiceServer {
    limpet::ros2::Handle handle;
};
struct TimerEvent {};
struct Timer {
    std::shared_ptr<detail::TimerState> state;  ///< gone with it
};

class ServiceClient {
public:
    ServiceClient() = default;
    explicit ServiceClient(std::shared_ptr<limpet::ros2::Client> client)
        : client_(std::move(client)) {}
    /// @return whether an answer came, within two seconds
    template <class Service>
    [[nodiscard]] bool call(Service& service) const {
        constexpr double kPatience_s = 2.0;
        const auto bytes = client_->call(limpet::ros2::encode(service.request), kPatience_s);
        const auto response =
            bytes ? limpet::ros2::decode<typename Service::Response>(*bytes) : std::nullopt;
        if (response) {
            service.response = *response;
        }
        return response.has_value();
    }

private:
    std::shared_ptr<limpet::ros2::Client> client_;
};

class NodeHandle {
public:
    /// @param space  "~": its names are the node's own
    explicit NodeHandle(std::string space = "") : space_(std::move(space)) {}
    void setCallbackQueue(CallbackQueue* queue) { queue_ = queue; }

    template <class Message>
    [[nodiscard]] Publisher advertise(const std::string& topic, std::uint32_t queue,
                                      bool latch = false) const {
        return Publisher(detail::node().advertise(
            resolve(topic), Message::kType,
            latch ? limpet::ros2::kLatched : detail::profile_of(Message::kType, queue)));
    }

    /// @param call  takes a Message
    template <class Message, class Call>
    [[nodiscard]] Subscriber subscribe(const std::string& topic, std::uint32_t queue,
                                       Call call) const {
        const std::string name = resolve(topic);
        const auto waiting = std::make_shared<std::atomic<std::uint32_t>>(0);
        return {detail::node().subscribe(
            name, Message::kType, detail::profile_of(Message::kType, queue),
            [=, calls = this->queue()](const limpet::ros2::Bytes& bytes) {
                const auto message = limpet::ros2::decode<Message>(bytes);
                if (!message) {
                    detail::report_unsound(name, Message::kType);
                } else if (*waiting < queue) {
                    ++*waiting;
                    calls->add([call, waiting, kept = *message] {
                        --*waiting;
                        call(kept);
                    });
                }
            })};
    }

    template <class Request, class Response>
    [[nodiscard]] ServiceServer advertiseService(
        const std::string& service, boost::function<bool(Request&, Response&)> call) const {
        return serveLater<Request>(
            service, Response::kType,
            [call](Request& request, const limpet::ros2::Node::Reply& reply) {
                Response response;
                if (call(request, response)) {
                    reply(limpet::ros2::encode(response));
                }
            });
    }
    /// One that replies when it likes, of this process's threads in any: roscpp has none of these.
    /// @param call  (Request&, reply)
    template <class Request, class Call>
    [[nodiscard]] ServiceServer serveLater(const std::string& service,
                                           const std::string& response_type, Call call) const {
        const std::string name = resolve(service);
        return {detail::node().serve(name, Request::kType, response_type,
                                     [=, calls = queue()](const limpet::ros2::Bytes& bytes,
                                                          const limpet::ros2::Node::Reply& reply) {
                                         const auto request = limpet::ros2::decode<Request>(bytes);
                                         if (!request) {
                                             detail::report_unsound(name, Request::kType);
                                             return;
                                         }
                                         calls->add([call, reply, kept = *request]() mutable {
                                             call(kept, reply);
                                         });
                                     })};
    }
    template <class Object, class Request, class Response>
    [[nodiscard]] ServiceServer advertiseService(const std::string& service,
                                                 bool (Object::*call)(Request&, Response&),
                                                 Object* object) const {
        return advertiseService(service, boost::function<bool(Request&, Response&)>(
                                             [object, call](Request& request, Response& response) {
                                                 return (object->*call)(request, response);
                                             }));
    }

    template <class Service>
    [[nodiscard]] ServiceClient serviceClient(const std::string& service) const {
        return ServiceClient(
            detail::client(resolve(service), Service::Request::kType, Service::Response::kType));
    }

    /// In the time of the node, by spin().
    [[nodiscard]] Timer createTimer(const Duration& period,
                                    boost::function<void(const TimerEvent&)> call) const {
        auto state = std::make_shared<detail::TimerState>(
            detail::TimerState{.period_s = period.toSec(), .call = [call] { call(TimerEvent{}); }});
        detail::add_timer(state);
        return {std::move(state)};
    }

private:
    [[nodiscard]] std::string resolve(const std::string& name) const {
        return detail::node().settings().resolve(space_ + name);
    }
    [[nodiscard]] CallbackQueue* queue() const {
        return queue_ != nullptr ? queue_ : &detail::global_queue();
    }

    std::string space_;
    CallbackQueue* queue_ = nullptr;
};

}  // namespace ros

// As roscpp's, for its users' sake; to standard output and error, and to /rosout.
#define ROS_PRINT(level, ...) \
    ::ros::detail::print(level, {__FILE__, __func__, __LINE__}, __VA_ARGS__)
#define ROS_INFO(...) ROS_PRINT(::ros::detail::Level::info, __VA_ARGS__)
#define ROS_INFO_ONCE(...)                                         \
    do {                                                           \
        static const bool printed = (ROS_INFO(__VA_ARGS__), true); \
        static_cast<void>(printed);                                \
    } while (false)
#define ROS_WARN(...) ROS_PRINT(::ros::detail::Level::warn, __VA_ARGS__)
#define ROS_ERROR(...) ROS_PRINT(::ros::detail::Level::error, __VA_ARGS__)
#define ROS_WARN_THROTTLE(period_s, ...)                                                       \
    do {                                                                                       \
        static double last_s = -1e9;                                                           \
        const double wall_s =                                                                  \
            std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()) \
                .count();                                                                      \
        if (wall_s - last_s > (period_s)) {                                                    \
            last_s = wall_s;                                                                   \
            ROS_WARN(__VA_ARGS__);                                                             \
        }                                                                                      \
    } while (false)
