// SPDX-License-Identifier: Apache-2.0
#include "ros/src/node_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>

#include "limpet/core/errors.hpp"

namespace limpet::ros {

using XmlRpc::XmlRpcValue;

void NodeParameters::fail(const std::string& name, const std::string& why) const {
    throw InputError(fmt::format("{}: {}", node_.resolveName(name), why));
}

const XmlRpcValue* NodeParameters::find(const std::string& name) {
    known_.push_back(node_.resolveName(name));
    value_.clear();
    return node_.getParam(name, value_) ? &value_ : nullptr;
}

std::string NodeParameters::text(const std::string& name, const std::string& otherwise) {
    const XmlRpcValue* value = find(name);
    if (value == nullptr) {
        return otherwise;
    }
    if (value->getType() != XmlRpcValue::TypeString) {
        fail(name, "must be a text");
    }
    return static_cast<std::string>(value_);
}

bool NodeParameters::flag(const std::string& name, bool otherwise) {
    const XmlRpcValue* value = find(name);
    if (value == nullptr) {
        return otherwise;
    }
    if (value->getType() != XmlRpcValue::TypeBoolean) {
        fail(name, "must be true or false");
    }
    return static_cast<bool>(value_);
}

double NodeParameters::number(const std::string& name, double otherwise, double minimum,
                              double maximum) {
    const XmlRpcValue* value = find(name);
    if (value == nullptr) {
        return otherwise;
    }
    const bool whole = value->getType() == XmlRpcValue::TypeInt;
    if (!whole && value->getType() != XmlRpcValue::TypeDouble) {
        fail(name, fmt::format("must be a number, allowed {:g}..{:g}", minimum, maximum));
    }
    const double number =
        whole ? static_cast<double>(static_cast<int>(value_)) : static_cast<double>(value_);
    if (!(number >= minimum && number <= maximum)) {
        fail(name,
             fmt::format("{:g} is out of range, allowed {:g}..{:g}", number, minimum, maximum));
    }
    return number;
}

XmlRpcValue flight_value(const SetupArguments& flight) {
    XmlRpcValue value;
    value["scenario"] = flight.scenario;
    value["vehicle"] = flight.vehicle;
    value["surface"] = flight.surface;
    value["mission"] = flight.mission;
    value["seed"] = flight.seed ? std::to_string(*flight.seed) : std::string();  // 64 bits
    value["set"].setSize(0);
    for (std::size_t i = 0; i < flight.set.size(); ++i) {
        value["set"][static_cast<int>(i)] = flight.set[i];
    }
    return value;
}

std::optional<SetupArguments> flight_from(const XmlRpcValue& value) {
    if (value.getType() != XmlRpcValue::TypeStruct) {
        return std::nullopt;
    }
    XmlRpcValue flight = value;  // its reading members are not const
    bool sound = true;
    const auto text = [&](const char* key) -> std::string {
        const bool is_text =
            flight.hasMember(key) && flight[key].getType() == XmlRpcValue::TypeString;
        sound = sound && is_text;
        return is_text ? static_cast<std::string>(flight[key]) : std::string();
    };
    SetupArguments found;
    found.scenario = text("scenario");
    found.vehicle = text("vehicle");
    found.surface = text("surface");
    found.mission = text("mission");
    if (const std::string seed = text("seed"); !seed.empty()) {
        std::uint64_t number = 0;
        const char* const end = seed.data() + seed.size();
        const auto result = std::from_chars(seed.data(), end, number);
        sound = sound && result.ec == std::errc{} && result.ptr == end;
        found.seed = number;
    }
    sound = sound && flight.hasMember("set") && flight["set"].getType() == XmlRpcValue::TypeArray;
    for (int i = 0; sound && i < flight["set"].size(); ++i) {
        sound = flight["set"][i].getType() == XmlRpcValue::TypeString;
        if (sound) {
            found.set.push_back(static_cast<std::string>(flight["set"][i]));
        }
    }
    return sound ? std::optional(found) : std::nullopt;
}

void tell_flight(SetupArguments flight) {
    if (std::filesystem::is_regular_file(flight.scenario)) {
        flight.scenario = std::filesystem::absolute(flight.scenario).string();
    }
    ::ros::param::set(kFlightParameter, flight_value(flight));
}

SetupArguments NodeParameters::setup() {
    SetupArguments own = own_setup();
    if (!flag("as_vehicle", false)) {
        return own;
    }
    const bool differs = !own.scenario.empty() || !own.vehicle.empty() || !own.surface.empty();
    if (differs || own.seed) {
        fail("as_vehicle", "true, allowed without ~scenario, ~vehicle, ~surface and ~seed only");
    }
    XmlRpcValue value;
    std::optional<SetupArguments> flight;
    while (!flight) {
        if (!::ros::ok()) {
            throw InputError(
                fmt::format("{}: no vehicle has told what it flies", kFlightParameter));
        }
        if (::ros::param::get(kFlightParameter, value)) {
            flight = flight_from(value);
        }
        if (!flight) {
            ROS_INFO_ONCE("waits for the vehicle to tell what it flies (%s)", kFlightParameter);
            ::ros::WallDuration(0.1).sleep();
        }
    }
    flight->mission = own.mission.empty() ? flight->mission : own.mission;
    flight->set.insert(flight->set.end(), own.set.begin(), own.set.end());
    return *flight;
}

SetupArguments NodeParameters::own_setup() {
    SetupArguments arguments;
    arguments.scenario = text("scenario");
    arguments.vehicle = text("vehicle");
    arguments.surface = text("surface");
    arguments.mission = text("mission");
    constexpr double kNone = -1.0;
    constexpr double kMost = 2147483647.0;  // what a ROS parameter can hold
    const double seed = number("seed", kNone, kNone, kMost);
    if (seed >= 0.0) {
        arguments.seed = static_cast<std::uint64_t>(seed);
    }
    const XmlRpcValue* set = find("set");
    if (set == nullptr) {
        return arguments;
    }
    if (set->getType() == XmlRpcValue::TypeString) {
        arguments.set = split_settings(static_cast<std::string>(value_));
        return arguments;
    }
    if (set->getType() != XmlRpcValue::TypeArray) {
        fail("set", "must be a list of KEY=VALUE, or one text with ; between them");
    }
    for (int i = 0; i < value_.size(); ++i) {
        if (value_[i].getType() != XmlRpcValue::TypeString) {
            fail("set", "must be a list of texts KEY=VALUE");
        }
        arguments.set.push_back(static_cast<std::string>(value_[i]));
    }
    return arguments;
}

void NodeParameters::refuse_others() const {
    std::vector<std::string> names;
    const std::string prefix = node_.getNamespace() + "/";
    if (!::ros::param::getParamNames(names)) {
        return;
    }
    for (const std::string& name : names) {
        const bool ours = name.compare(0, prefix.size(), prefix) == 0;
        if (ours && std::find(known_.begin(), known_.end(), name) == known_.end()) {
            std::string allowed;
            for (const std::string& other : known_) {
                allowed += (allowed.empty() ? "" : ", ") + other.substr(prefix.size());
            }
            throw InputError(fmt::format("{}: no such parameter, allowed {}", name, allowed));
        }
    }
}

int run_node(int argc, char** argv, const char* name, void (*node)()) {
    constexpr int kBadInput = 2;
    constexpr int kBroken = 70;
    (void)std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a log is read while it is written
    try {
        ::ros::init(argc, argv, name);
        node();
        return 0;
    } catch (const InputError& error) {
        std::fprintf(stderr, "limpet: %s\n", error.what());
        return kBadInput;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "limpet: this should not have happened: %s\n", error.what());
        return kBroken;
    }
}

}  // namespace limpet::ros
