// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/live/protocol.hpp"
#include "limpet/record/message_sink.hpp"
#include "limpet/serve/server.hpp"

namespace limpet::live {

/// The reply to a request.
struct LiveAnswer {
    bool done = false;
    std::string message;
};

/// Who does what viewers ask for, on the thread of answer().
struct LiveDesk {
    std::function<LiveAnswer(std::string_view service)> serve;
    /// A settable parameter, its value within its range.
    std::function<void(std::string_view name, double value)> set;
};

/// On this machine alone, with a new token, for the lab's page, Foxglove's, and those of the
/// viewers' programs.
/// @param port  0: any that is free
[[nodiscard]] serve::ServerOptions server_for_viewers(std::uint16_t port);

struct LiveOptions {
    serve::ServerOptions server;
    std::string name;                        ///< of what is flown
    std::vector<std::string> services = {};  ///< "/abort"
    std::vector<LiveParameter> parameters = {};
};

struct LiveCount {
    std::uint64_t viewers = 0;  ///< that came
    std::uint64_t messages = 0;
    std::uint64_t dropped = 0;  ///< of them, for viewers that read slowly
};

/// What a recording takes goes to viewers too, by Foxglove's WebSocket protocol (protocol.hpp): the
/// same topics, types and bytes, at the same times. Who comes late gets what stands still:
/// description, /tf_static, the wall. The description's meshes are there to be fetched. A second
/// flight's channels are the first one's. A viewer that is slow or gone costs the flight nothing;
/// what viewers ask for waits until the flight takes it up in answer().
class Live final : public record::MessageSink, private serve::Listener {
public:
    /// Listens from now on.
    /// @throws InputError if the port cannot be had
    explicit Live(LiveOptions options);
    ~Live() override;
    Live(const Live&) = delete;
    Live& operator=(const Live&) = delete;

    /// "ws://127.0.0.1:8765/?token=..."
    [[nodiscard]] std::string address() const { return server_.address("ws"); }

    void channel(const record::SinkChannel& channel) override;
    void attachment(const mcap::Attachment& attachment) override;
    void message(std::uint16_t channel, std::uint64_t time_ns, mcap::ByteView data) override;

    /// A viewer has subscribed to something.
    [[nodiscard]] bool watched() const { return watched_; }
    /// There are requests since the last answer().
    [[nodiscard]] bool asked() const { return asked_; }
    /// Handles the requests.
    void answer(const LiveDesk& desk);
    /// A line for all who watch.
    void say(StatusLevel level, std::string_view text);

    [[nodiscard]] LiveCount count() const;
    /// One line: who came, what went.
    [[nodiscard]] std::string report() const;

private:
    struct Kept {
        std::uint64_t time_ns;  // no default: clang would not have it in an optional of this class
        std::vector<std::uint8_t> bytes;
    };
    /// Of a channel whose messages hold on: its first one and the latest.
    struct Latch {
        bool holds = false;
        bool rare = false;  ///< none is dropped for later ones, as events
        std::optional<Kept> first = {}, latest = {};
    };
    struct Viewer {
        std::shared_ptr<serve::Session> session;
        std::vector<std::optional<std::uint32_t>> subscriptions;  ///< by channel
        std::map<std::uint32_t, std::uint16_t> channels;          ///< by subscription
        std::set<std::string, std::less<>> parameters;  ///< that it is sent when they change
    };
    struct Request {
        std::shared_ptr<serve::Session> from;
        std::uint32_t service = 0, call = 0;
        std::vector<std::pair<std::string, double>> set = {};  ///< parameters; else a service
        std::string id = {};
    };

    void on_open(const std::shared_ptr<serve::Session>& session) override;
    void on_text(serve::Session& session, std::string_view text) override;
    void on_binary(serve::Session& session, std::string_view bytes) override;
    void on_close(serve::Session& session) override;

    void subscribe(Viewer& viewer, std::uint32_t subscription, std::uint64_t channel);
    void unsubscribe(Viewer& viewer, std::uint32_t subscription);
    void fetch(serve::Session& session, std::uint32_t request, std::string_view uri) const;
    void send(Viewer& viewer, std::uint16_t channel, std::uint64_t time_ns, mcap::ByteView data,
              bool keep);
    [[nodiscard]] std::vector<LiveParameter> wanted(const std::vector<std::string>& names) const;
    [[nodiscard]] std::string refusal(const std::string& name, double value) const;
    void set_parameters(Viewer& viewer, const nlohmann::json& asked);
    [[nodiscard]] bool queue(Request request);
    void apply(const Request& request, const LiveDesk& desk);

    LiveOptions options_;
    std::string session_id_ = serve::make_token();
    mutable std::mutex guards_all_;
    std::vector<LiveChannel> channels_;
    std::vector<Latch> latches_;
    std::map<const serve::Session*, Viewer> viewers_;
    std::vector<Request> requests_;
    std::map<std::string, std::string, std::less<>> meshes_;  ///< by the name in their URI
    LiveCount count_;
    std::uint64_t next_time_ns_ = 0;
    std::atomic<bool> watched_ = false, asked_ = false, has_viewers_ = false;
    serve::Server server_;  ///< the last to come, the first to go
};

}  // namespace limpet::live
