// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/suction_cup_topics.hpp"

#include <fmt/format.h>

#include <gazebo/common/Console.hh>
#include <gazebo/physics/World.hh>
#include <optional>
#include <set>
#include <string_view>

#include "adapters/gazebo/transport_messages.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::gazebo11 {
namespace {

gazebo::msgs::Any pressure_message(const CupStatus& status) {
    return number_message(status.pressure_Pa);
}

gazebo::msgs::GzString state_message(const CupStatus& status) {
    return text_message(to_string(status.phase));
}

std::optional<bool> switch_of(const std::string& text) {
    if (text == "on" || text == "1" || text == "true" || text == "open") {
        return true;
    }
    if (text == "off" || text == "0" || text == "false" || text == "shut") {
        return false;
    }
    return std::nullopt;
}

/// Names of the cups of this server; plugins of spawned models come and go.
std::mutex names_mutex;
std::set<std::string> names;

std::string take_name(const std::string& name) {
    const std::lock_guard lock(names_mutex);
    if (!names.insert(name).second) {
        throw InputError(fmt::format(
            "<plugin name>: another cup is {} already, allowed a name of its own", name));
    }
    return name + "/";
}

}  // namespace

SuctionCupTopics::SuctionCupTopics(gazebo::physics::WorldPtr world, const std::string& name,
                                   const CupCommands& start, bool valve_fitted, double rate_Hz)
    : start_(start),
      valve_fitted_(valve_fitted),
      prefix_(take_name(name)),
      period_s_(1.0 / rate_Hz),
      commands_(start),
      node_(new gazebo::transport::Node()) {
    node_->Init(world->Name());
    const std::string topic = "~/" + prefix_;
    pressure_ = node_->Advertise<gazebo::msgs::Any>(topic + "pressure");
    state_ = node_->Advertise<gazebo::msgs::GzString>(topic + "state");
    event_ = node_->Advertise<gazebo::msgs::GzString>(topic + "event");
    response_ = node_->Advertise<gazebo::msgs::Response>("~/response");
    pump_ = node_->Subscribe(topic + "pump", &SuctionCupTopics::on_pump, this);
    valve_ = node_->Subscribe(topic + "valve", &SuctionCupTopics::on_valve, this);
    request_ = node_->Subscribe("~/request", &SuctionCupTopics::on_request, this);
}

SuctionCupTopics::~SuctionCupTopics() {
    node_->Fini();  // no message comes in from here on
    const std::lock_guard lock(names_mutex);
    names.erase(prefix_.substr(0, prefix_.size() - 1));
}

CupCommands SuctionCupTopics::commands() const {
    const std::lock_guard lock(mutex_);
    return commands_;
}

void SuctionCupTopics::command(const CupCommands& commands) {
    const std::lock_guard lock(mutex_);
    commands_ = commands;
}

void SuctionCupTopics::reset() {
    const std::lock_guard lock(mutex_);
    commands_ = start_;
    next_s_ = 0.0;
}

bool SuctionCupTopics::publish(const CupStatus& status, double time_s) {
    bool changed = false;
    {
        const std::lock_guard lock(mutex_);
        changed = status.phase != status_.phase;
        status_ = status;
    }
    const bool now = changed || time_s >= next_s_ || time_s < next_s_ - period_s_;
    if (now) {
        next_s_ = time_s + period_s_;
        pressure_->Publish(pressure_message(status));
        state_->Publish(state_message(status));
    }
    return now;
}

void SuctionCupTopics::publish(const Event& event) {
    event_->Publish(text_message(
        fmt::format("{:.3f} {}: {}", event.time_s, to_string(event.name), event.reason)));
}

bool SuctionCupTopics::turn(const std::string& what, bool on) {
    if ((what != "pump" && what != "valve") || (what == "valve" && on && !valve_fitted_)) {
        return false;
    }
    const std::lock_guard lock(mutex_);
    (what == "pump" ? commands_.pump_on : commands_.valve_open) = on;
    return true;
}

void SuctionCupTopics::on_pump(const IntPtr& message) {
    static_cast<void>(turn("pump", message->data() != 0));
}

void SuctionCupTopics::on_valve(const IntPtr& message) {
    if (!turn("valve", message->data() != 0)) {
        gzwarn << "limpet: " << prefix_ << "valve: no valve is fitted (suction.valve_fitted)\n";
    }
}

bool SuctionCupTopics::answer(const gazebo::msgs::Request& request, const std::string& what,
                              gazebo::msgs::Response& response) {
    const auto pack = [&](const auto& message) {
        response.set_type(message.GetTypeName());
        return message.SerializeToString(response.mutable_serialized_data());
    };
    std::unique_lock lock(mutex_);
    const CupStatus status = status_;
    lock.unlock();
    if (what == "pressure") {
        return pack(pressure_message(status));
    }
    if (what == "state") {
        return pack(state_message(status));
    }
    const std::optional<bool> wanted = switch_of(request.data());
    return wanted && turn(what, *wanted);
}

void SuctionCupTopics::on_request(const RequestPtr& request) {
    if (request->request().rfind(prefix_, 0) != 0) {
        return;
    }
    gazebo::msgs::Response response;
    response.set_id(request->id());
    response.set_request(request->request());
    const bool done = answer(*request, request->request().substr(prefix_.size()), response);
    response.set_response(done ? "success" : "error");
    response_->Publish(response);
}

}  // namespace limpet::gazebo11
