// SPDX-License-Identifier: Apache-2.0
#include "limpet/live/live.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/record/topics.hpp"

namespace limpet::live {
namespace {

constexpr std::size_t kMostRequests = 100;           // not yet answered
constexpr std::uint64_t kTimeEvery_ns = 20'000'000;  // a viewer's clock steps as it draws

std::string_view view_of(mcap::ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// @throws InputError unless it is one: its lowest bits might be another's
std::uint32_t id_in(const nlohmann::json& given) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (!given.is_number_unsigned() || given.get<std::uint64_t>() > kMost) {
        throw InputError(
            fmt::format("{} is no id; a whole number, allowed 0..{}", given.dump(), kMost));
    }
    return given.get<std::uint32_t>();
}

template <std::size_t n>
std::string_view view_of(const std::array<char, n>& bytes) {
    return {bytes.data(), n};
}

}  // namespace

serve::ServerOptions server_for_viewers(std::uint16_t port) {
    serve::ServerOptions options;
    options.port = port;
    options.token = serve::make_token();
    // Foxglove's page, and the two programs, whose pages are files; the lab's.
    options.origins = {"https://app.foxglove.dev", "file://", "http://127.0.0.1:*",
                       "http://localhost:*"};
    return options;
}

Live::Live(LiveOptions options) : options_(std::move(options)), server_(options_.server) {
    server_.websocket("/", {kSubprotocols.begin(), kSubprotocols.end()}, *this);
    server_.start();
}

Live::~Live() {
    server_.stop();
}

void Live::channel(const record::SinkChannel& channel) {
    const std::lock_guard lock(guards_all_);
    if (channel.id < channels_.size() && channels_[channel.id].topic == channel.topic) {
        latches_[channel.id] = {.holds = latches_[channel.id].holds,
                                .rare = latches_[channel.id].rare};
        next_time_ns_ = 0;  // another flight begins
        return;
    }
    require(channel.id == channels_.size(), "channels come in their order, from 0");
    channels_.push_back({channel.id, std::string(channel.topic), std::string(channel.type),
                         std::string(channel.encoding), std::string(channel.schema_encoding),
                         std::string(channel.schema)});
    const bool holds = channel.topic == record::kDescriptionTopic ||
                       channel.topic == record::kStandingTopic ||
                       channel.topic == record::kMarkersTopic;
    latches_.push_back({.holds = holds,
                        .rare = channel.topic == record::kDescriptionTopic ||
                                channel.topic == record::kStandingTopic ||
                                channel.topic == record::info(record::Topic::events).name});
    for (auto& [session, viewer] : viewers_) {
        viewer.subscriptions.emplace_back();
        viewer.session->send_text(advertise({&channels_.back(), 1}));
    }
}

void Live::attachment(const mcap::Attachment& attachment) {
    if (attachment.media_type == record::kMeshMediaType) {
        const std::lock_guard lock(guards_all_);
        meshes_[attachment.name] = attachment.text;
    }
}

void Live::message(std::uint16_t channel, std::uint64_t time_ns, mcap::ByteView data) {
    Latch& latch = latches_[channel];
    if (!latch.holds && !has_viewers_) {
        return;
    }
    const std::lock_guard lock(guards_all_);
    if (latch.holds) {
        std::optional<Kept>& kept = latch.first ? latch.latest : latch.first;
        if (!kept) {
            kept.emplace();
        }
        kept->time_ns = time_ns;
        kept->bytes.assign(data.begin(), data.end());
    }
    // What stands still comes once; arrows and beams of the scene come after the wall, and again.
    const bool keep = latch.rare || (latch.holds && !latch.latest);
    const bool time = time_ns >= next_time_ns_;
    if (time) {
        next_time_ns_ = time_ns + kTimeEvery_ns;
    }
    for (auto& [session, viewer] : viewers_) {
        if (time) {
            viewer.session->stream({view_of(time_message(time_ns))});
        }
        send(viewer, channel, time_ns, data, keep);
    }
}

void Live::send(Viewer& viewer, std::uint16_t channel, std::uint64_t time_ns, mcap::ByteView data,
                bool keep) {
    if (const auto& subscription = viewer.subscriptions[channel]) {
        ++count_.messages;
        const auto head = message_head(*subscription, time_ns);
        if (keep) {
            viewer.session->send_binary({view_of(head), view_of(data)});
        } else {
            viewer.session->stream({view_of(head), view_of(data)});
        }
    }
}

void Live::on_open(const std::shared_ptr<serve::Session>& session) {
    session->send_text(server_info(options_.name, session_id_, !options_.parameters.empty(),
                                   !options_.services.empty()));
    const std::lock_guard lock(guards_all_);
    if (!channels_.empty()) {
        session->send_text(advertise(channels_));
    }
    if (!options_.services.empty()) {
        session->send_text(advertise_services(options_.services));
    }
    Viewer& viewer = viewers_[session.get()];
    viewer.session = session;
    viewer.subscriptions.resize(channels_.size());
    ++count_.viewers;
    has_viewers_ = true;
}

void Live::on_close(serve::Session& session) {
    const std::lock_guard lock(guards_all_);
    count_.dropped += session.dropped();
    viewers_.erase(&session);
    has_viewers_ = !viewers_.empty();
}

void Live::subscribe(Viewer& viewer, std::uint32_t subscription, std::uint64_t channel) {
    serve::Session& session = *viewer.session;
    if (channel >= channels_.size()) {
        session.send_text(
            status(StatusLevel::warning, fmt::format("channel {} is not there", channel)));
        return;
    }
    const auto id = static_cast<std::uint16_t>(channel);
    if (viewer.channels.count(subscription) != 0 || viewer.subscriptions[id]) {
        session.send_text(status(
            StatusLevel::warning,
            fmt::format("subscription {} to channel {} is there already", subscription, channel)));
        return;
    }
    viewer.subscriptions[id] = subscription;
    viewer.channels[subscription] = id;
    watched_ = true;
    for (const auto& kept : {latches_[id].first, latches_[id].latest}) {
        if (kept) {
            send(viewer, id, kept->time_ns, kept->bytes, true);
        }
    }
}

void Live::unsubscribe(Viewer& viewer, std::uint32_t subscription) {
    const auto found = viewer.channels.find(subscription);
    if (found == viewer.channels.end()) {
        viewer.session->send_text(status(
            StatusLevel::warning, fmt::format("subscription {} is not there", subscription)));
        return;
    }
    viewer.subscriptions[found->second].reset();
    viewer.channels.erase(found);
}

void Live::fetch(serve::Session& session, std::uint32_t request, std::string_view uri) const {
    const auto mesh = meshes_.find(uri.substr(uri.rfind('/') + 1));
    if (mesh == meshes_.end()) {
        session.send_large(
            asset_failure(request, fmt::format("there is no {} in this flight", uri)));
    } else if (!session.send_large(asset_response(request, mesh->second))) {
        session.send_text(
            status(StatusLevel::warning, fmt::format("{}: too many requests at once", uri)));
    }
}

std::vector<LiveParameter> Live::wanted(const std::vector<std::string>& names) const {
    if (names.empty()) {
        return options_.parameters;
    }
    std::vector<LiveParameter> found;
    std::copy_if(options_.parameters.begin(), options_.parameters.end(), std::back_inserter(found),
                 [&](const LiveParameter& parameter) {
                     return std::find(names.begin(), names.end(), parameter.name) != names.end();
                 });
    return found;
}

/// Why a viewer may not set it so; empty: it may.
std::string Live::refusal(const std::string& name, double value) const {
    const LiveParameter* found = find_named(options_.parameters, name);
    if (found == nullptr) {
        return fmt::format("there is no parameter {}", name);
    }
    if (!found->settable) {
        return fmt::format("{} cannot be changed in flight", name);
    }
    if (!(value >= found->minimum && value <= found->maximum)) {
        return fmt::format("{} = {:g} is out of range, allowed {:g}..{:g}", name, value,
                           found->minimum, found->maximum);
    }
    if (found->whole && value != std::floor(value)) {
        return fmt::format("{} = {:g} must be a whole number", name, value);
    }
    return "";
}

/// @return false: too many are waiting already
bool Live::queue(Request request) {
    if (requests_.size() >= kMostRequests) {
        return false;
    }
    requests_.push_back(std::move(request));
    asked_ = true;
    return true;
}

/// Those that may be set are left for the flight; the others are refused, one by one.
/// @throws nlohmann::json::exception
void Live::set_parameters(Viewer& viewer, const nlohmann::json& asked) {
    Request request{.from = viewer.session, .id = asked.value("id", "")};
    std::vector<std::string> all;
    for (const nlohmann::json& one : asked.at("parameters")) {
        const auto name = one.at("name").get<std::string>();
        const nlohmann::json& given = one.at("value");
        const double value =
            given.is_boolean() ? (given.get<bool>() ? 1.0 : 0.0) : given.get<double>();
        all.push_back(name);
        if (const std::string why = refusal(name, value); !why.empty()) {
            viewer.session->send_text(status(StatusLevel::error, why));
        } else {
            request.set.emplace_back(name, value);
        }
    }
    if (request.set.empty() || !queue(std::move(request))) {
        viewer.session->send_text(parameter_values(wanted(all), asked.value("id", "")));
    }
}

void Live::on_text(serve::Session& session, std::string_view text) {
    const std::lock_guard lock(guards_all_);
    Viewer& viewer = viewers_.at(&session);
    try {
        const nlohmann::json asked = nlohmann::json::parse(text);
        const auto op = asked.at("op").get<std::string>();
        const auto names = [&asked] {
            return asked.at("parameterNames").get<std::vector<std::string>>();
        };
        if (op == "subscribe") {
            for (const nlohmann::json& one : asked.at("subscriptions")) {
                subscribe(viewer, id_in(one.at("id")), id_in(one.at("channelId")));
            }
        } else if (op == "unsubscribe") {
            for (const nlohmann::json& id : asked.at("subscriptionIds")) {
                unsubscribe(viewer, id_in(id));
            }
        } else if (op == "getParameters") {
            session.send_text(parameter_values(wanted(names()), asked.value("id", "")));
        } else if (op == "setParameters") {
            set_parameters(viewer, asked);
        } else if (op == "fetchAsset") {
            fetch(session, id_in(asked.at("requestId")), asked.at("uri").get<std::string>());
        } else if (op == "subscribeParameterUpdates") {
            for (const LiveParameter& parameter : wanted(names())) {
                viewer.parameters.insert(parameter.name);
            }
        } else if (op == "unsubscribeParameterUpdates") {
            for (const std::string& name : names()) {
                viewer.parameters.erase(name);
            }
        } else {
            session.send_text(
                status(StatusLevel::warning, fmt::format("'{}' is not understood here", op)));
        }
    } catch (const nlohmann::json::exception& error) {
        session.send_text(status(StatusLevel::error, error.what()));
    } catch (const InputError& error) {
        session.send_text(status(StatusLevel::error, error.what()));
    }
}

void Live::on_binary(serve::Session& session, std::string_view bytes) {
    const auto call = read_service_call(bytes);
    if (!call) {
        session.send_text(status(StatusLevel::error, "no call of a service"));
        return;
    }
    const std::lock_guard lock(guards_all_);
    const char* amiss = call->service >= options_.services.size() ? "there is no such service"
                        : call->encoding != "cdr"                 ? "must be encoded as cdr"
                                                                  : nullptr;
    if (amiss == nullptr && !queue({.from = viewers_.at(&session).session,
                                    .service = call->service,
                                    .call = call->call})) {
        amiss = "too many calls are waiting";
    }
    if (amiss != nullptr) {
        session.send_text(service_failure(call->service, call->call, amiss));
    }
}

void Live::answer(const LiveDesk& desk) {
    if (!asked_) {
        return;
    }
    std::vector<Request> requests;
    {
        const std::lock_guard lock(guards_all_);
        std::swap(requests, requests_);
        asked_ = false;
    }
    for (const Request& request : requests) {
        apply(request, desk);
    }
}

void Live::apply(const Request& request, const LiveDesk& desk) {
    if (request.set.empty()) {
        const LiveAnswer answer = desk.serve(options_.services[request.service]);
        request.from->send_binary(
            {service_response(request.service, request.call, answer.done, answer.message)});
        return;
    }
    std::vector<std::string> names;
    for (const auto& [name, value] : request.set) {
        desk.set(name, value);
        names.push_back(name);
    }
    const std::lock_guard lock(guards_all_);
    for (const auto& [name, value] : request.set) {
        if (LiveParameter* parameter = find_named(options_.parameters, name)) {
            parameter->value = value;
        }
    }
    for (const auto& [session, viewer] : viewers_) {
        std::vector<LiveParameter> changed = wanted(names);
        if (viewer.session != request.from) {
            std::erase_if(changed, [&viewer = viewer](const LiveParameter& parameter) {
                return viewer.parameters.count(parameter.name) == 0;
            });
        }
        if (!changed.empty()) {
            viewer.session->send_text(
                parameter_values(changed, viewer.session == request.from ? request.id : ""));
        }
    }
}

std::string Live::report() const {
    const LiveCount all = count();
    return fmt::format(
        "{} came to watch, {} messages, {} frames dropped that they read too slowly for",
        all.viewers, all.messages, all.dropped);
}

void Live::say(StatusLevel level, std::string_view text) {
    const std::string line = status(level, text);
    const std::lock_guard lock(guards_all_);
    for (const auto& [session, viewer] : viewers_) {
        viewer.session->send_text(line);
    }
}

LiveCount Live::count() const {
    const std::lock_guard lock(guards_all_);
    LiveCount all = count_;
    for (const auto& [session, viewer] : viewers_) {
        all.dropped += session->dropped();
    }
    return all;
}

}  // namespace limpet::live
