// SPDX-License-Identifier: Apache-2.0
#include <rcl_interfaces/Log.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "adapters/ros2/dds/parameters.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/yaml_reader.hpp"

namespace ros {
namespace {

namespace ros2 = limpet::ros2;
using limpet::scenario::YamlNode;
using XmlRpc::XmlRpcValue;

std::atomic<bool> over{false};

void end(int /*signal*/) {
    over = true;
}

/// As rcl has /rosout: late subscribers receive earlier lines.
constexpr ros2::Profile kLog{.reliable = true, .transient_local = true, .depth = 1000};

/// A process is a node, as in ROS 1. Used by its main thread, but for what mutex guards.
struct Core {
    explicit Core(const ros2::NodeSettings& settings)
        : node(settings),
          name(settings.full_name()),
          parameters(serve_parameters(node)),
          log(node.advertise(settings.resolve("/rosout"), rcl_interfaces::Log::kType, kLog)) {}

    ros2::Node node;
    std::string name;
    std::vector<ros2::Handle> parameters;
    std::unique_ptr<ros2::Writer> log;
    CallbackQueue queue;
    std::vector<std::weak_ptr<detail::TimerState>> timers;

    bool simulated = false;
    std::atomic<std::int64_t> clock_ns{0};
    ros2::Handle clock;

    std::map<std::string, std::unique_ptr<ros2::Writer>> published;  ///< by a parameter's name
    std::map<std::string, ros2::Handle> subscribed;                  ///< by a parameter's name
    std::mutex mutex;                                            ///< of what DDS's threads touch
    std::map<std::string, std::weak_ptr<ros2::Client>> clients;  ///< by their services
    std::map<std::string, std::string> received;                 ///< of parameters
    std::set<std::string> unsound;                               ///< topics
};
std::unique_ptr<Core> core;

XmlRpcValue value_of(const YamlNode& node) {
    XmlRpcValue value;
    switch (node.kind) {
        case YamlNode::Kind::null: value = std::string(); break;
        case YamlNode::Kind::scalar: value = node.text; break;
        case YamlNode::Kind::list:
            value.setSize(static_cast<int>(node.children.size()));
            for (std::size_t i = 0; i < node.children.size(); ++i) {
                value[static_cast<int>(i)] = value_of(node.children[i]);
            }
            break;
        case YamlNode::Kind::map:
            value.begin();
            for (const YamlNode& child : node.children) {
                value[child.key] = value_of(child);
            }
            break;
    }
    return value;
}

nlohmann::json json_of(XmlRpcValue value) {
    switch (value.getType()) {
        case XmlRpcValue::TypeArray: {
            auto all = nlohmann::json::array();
            for (int i = 0; i < value.size(); ++i) {
                all.push_back(json_of(value[i]));
            }
            return all;
        }
        case XmlRpcValue::TypeStruct: {
            auto all = nlohmann::json::object();
            for (auto& [key, member] : value) {
                all[key] = json_of(member);
            }
            return all;
        }
        default: return static_cast<std::string>(value);
    }
}

void run_timers(double now_s) {
    std::erase_if(core->timers, [](const auto& timer) { return timer.expired(); });
    for (const auto& weak : core->timers) {
        const auto timer = weak.lock();
        // From now on, also when time has gone back.
        if (timer->due_s < 0.0 || now_s < timer->last_s) {
            timer->due_s = now_s + timer->period_s;
        }
        timer->last_s = now_s;
        if (now_s >= timer->due_s) {
            timer->due_s = std::max(timer->due_s + timer->period_s, now_s);
            timer->call();
        }
    }
}

/// Until the next timer is due [s]; in simulated time the clock wakes it.
double idle_s(double now_s) {
    double idle = 0.1;
    for (const auto& weak : core->timers) {
        const auto timer = weak.lock();
        if (timer && !core->simulated) {
            idle = std::min(idle, timer->due_s < 0.0 ? 0.0 : timer->due_s - now_s);
        }
    }
    return std::max(idle, 0.0);
}

void receive_clock() {
    core->simulated = true;
    core->clock = core->node.subscribe(
        core->node.settings().resolve("/clock"), rosgraph_msgs::Clock::kType,
        {.reliable = false, .depth = 1}, [](const ros2::Bytes& bytes) {
            if (const auto received = ros2::decode<rosgraph_msgs::Clock>(bytes)) {
                core->clock_ns = std::llround(received->clock.toSec() * 1e9);
                core->queue.poke();
            }
        });
}

}  // namespace

Time Time::now() {
    if (core->simulated) {
        return Time(1e-9 * static_cast<double>(core->clock_ns.load()));
    }
    return Time(
        std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count());
}

void init(int argc, char** argv, const std::string& name) {
    ros2::NodeSettings settings = ros2::read_settings(name, {argv + 1, argv + argc});
    bool simulated = false;
    limpet::scenario::read_given(settings.parameters, "use_sim_time", simulated);
    core = std::make_unique<Core>(settings);
    std::signal(SIGINT, end);
    std::signal(SIGTERM, end);
    if (simulated) {
        receive_clock();
    }
}

bool ok() {
    return !over;
}

void shutdown() {
    core.reset();
}

void spin() {
    while (ok()) {
        const double now_s = Time::now().toSec();
        core->queue.call_available(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(idle_s(now_s))));
        if (!core->simulated || core->clock_ns > 0) {
            run_timers(Time::now().toSec());
        }
    }
}

const std::string& this_node::getName() {
    return core->name;
}

bool param::get(const std::string& name, XmlRpcValue& value) {
    if (name == core->name) {
        YamlNode own = core->node.settings().parameters;  // use_sim_time is ROS's parameter
        std::erase_if(own.children, [](const YamlNode& one) { return one.key == "use_sim_time"; });
        value = value_of(own);
        return true;
    }
    if (!core->subscribed.contains(name)) {
        core->subscribed[name] = core->node.subscribe(
            name, std_msgs::String::kType, ros2::kLatched, [name](const ros2::Bytes& bytes) {
                if (const auto message = ros2::decode<std_msgs::String>(bytes)) {
                    const std::lock_guard lock(core->mutex);
                    core->received[name] = message->data;
                }
            });
    }
    std::string text;
    {
        const std::lock_guard lock(core->mutex);
        text = core->received[name];
    }
    if (text.empty()) {
        return false;
    }
    try {
        value = value_of(limpet::scenario::parse_yaml(text, name));
        return true;
    } catch (const limpet::InputError&) {  // it is another program's
        return false;
    }
}

void param::set(const std::string& name, const XmlRpcValue& value) {
    auto& writer = core->published[name];
    if (!writer) {
        writer = core->node.advertise(name, std_msgs::String::kType, ros2::kLatched);
    }
    std_msgs::String message;
    message.data = json_of(value).dump();
    writer->write(ros2::encode(message));
}

ros2::Node& detail::node() {
    return core->node;
}

CallbackQueue& detail::global_queue() {
    return core->queue;
}

bool service::exists(const std::string& name, bool /*print_failure_reason*/) {
    const std::lock_guard lock(core->mutex);
    const auto found = core->clients.find(core->node.settings().resolve(name));
    const auto client = found != core->clients.end() ? found->second.lock() : nullptr;
    return client && client->is_served();
}

std::shared_ptr<ros2::Client> detail::client(const std::string& service,
                                             const std::string& request_type,
                                             const std::string& response_type) {
    std::shared_ptr<ros2::Client> made = core->node.client(service, request_type, response_type);
    const std::lock_guard lock(core->mutex);
    core->clients[service] = made;
    return made;
}

ros2::Profile detail::profile_of(const std::string& type, std::uint32_t queue) {
    const auto is = [&type](const char* begin) { return type.starts_with(begin); };
    const bool measured = is("sensor_msgs::") && !is("sensor_msgs::msg::dds_::JointState_");
    const bool once = measured || is("geometry_msgs::") || is("rosgraph_msgs::") ||
                      is("mavros_msgs::msg::dds_::PositionTarget_") ||
                      is("mavros_msgs::msg::dds_::AttitudeTarget_");
    constexpr std::uint32_t kMost = 100;
    return once ? ros2::kSensorData
                : ros2::Profile{.depth = static_cast<int>(std::clamp(queue, 1U, kMost))};
}

void detail::report_unsound(const std::string& topic, const std::string& type) {
    const std::lock_guard lock(core->mutex);
    if (core->unsound.insert(topic).second) {
        ROS_WARN("%s: what came is no %s: left unread", topic.c_str(), type.c_str());
    }
}

void detail::print(Level level, const Place& place, const char* format, ...) {
    std::va_list values, again;
    va_start(values, format);
    va_copy(again, values);
    const int size = std::max(std::vsnprintf(nullptr, 0, format, values), 0);
    std::string text(static_cast<std::size_t>(size) + 1, '\0');
    std::vsnprintf(text.data(), text.size(), format, again);
    va_end(again);
    va_end(values);
    text.pop_back();
    std::fprintf(level < Level::warn ? stdout : stderr, "%s\n", text.c_str());
    if (core) {
        rcl_interfaces::Log log;
        log.stamp =
            Time(std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
                     .count());
        log.level = static_cast<std::uint8_t>(level);
        log.name = core->name.substr(1);
        std::replace(log.name.begin(), log.name.end(), '/', '.');
        log.msg = text;
        log.file = place.file;
        log.function = place.function;
        log.line = static_cast<std::uint32_t>(place.line);
        core->log->write(ros2::encode(log));
    }
}

void detail::add_timer(const std::shared_ptr<TimerState>& timer) {
    core->timers.push_back(timer);
}

}  // namespace ros
