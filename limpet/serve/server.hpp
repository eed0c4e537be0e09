// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "limpet/serve/session.hpp"

namespace limpet::serve {

struct ServerOptions {
    std::string host = "127.0.0.1";  ///< IPv4 in digits, or "localhost"
    std::uint16_t port = 0;          ///< 0: any that is free
    /// Who does not show it gets 403: as `/TOKEN/...` or `?token=TOKEN`. Empty: no token is needed.
    std::string token = {};
    /// Pages of others that may come in too ("https://app.example.org", "http://localhost:*" at any
    /// port); those of this server and programs, which name no origin, may anyway.
    std::vector<std::string> origins = {};
    /// Of those who have shown the token, and as many of those who have not yet: of these the one
    /// who has been there longest makes space for the next.
    std::size_t most_connections = 32;
    std::size_t most_request_bytes = std::size_t{1} << 20U;  ///< a body, a frame from a client
    std::size_t most_queued_bytes = std::size_t{1} << 20U;   ///< to a client, its frame queue
    std::chrono::milliseconds request_time = std::chrono::seconds(10);  ///< to send or take one
};

struct Request {
    std::string method;  ///< "GET", "POST"
    std::string path;    ///< decoded, without token and query: "/", "/api/flights/3"
    /// Decoded, in order, without the token.
    std::vector<std::pair<std::string, std::string>> query;
    std::string content_type;
    std::string body;

    /// The first `key` of the query, else `otherwise`.
    [[nodiscard]] std::string value(std::string_view key, std::string_view otherwise = {}) const;
};

struct Response {
    unsigned status = 200;
    std::string content_type = "text/plain; charset=utf-8";
    std::string body = {};
    std::vector<std::pair<std::string, std::string>> headers = {};
};

/// On the server's thread: everyone else waits meanwhile, so what takes long belongs elsewhere. An
/// InputError becomes 400 with its text, anything else 500.
using Handler = std::function<Response(const Request&)>;

/// Whom the clients of one WebSocket path talk to. Called on the server's thread; what is thrown
/// ends that session alone.
class Listener {
public:
    virtual ~Listener() = default;
    virtual void on_open(const std::shared_ptr<Session>& session) = 0;
    virtual void on_text(Session& session, std::string_view text) = 0;
    virtual void on_binary(Session& session, std::string_view bytes) = 0;
    virtual void on_close(Session& session) = 0;

protected:
    Listener() = default;
    Listener(const Listener&) = default;
    Listener& operator=(const Listener&) = default;
};

/// A small HTTP and WebSocket server on a thread of its own, for one user and a few viewers.
///
/// A request comes in when its Host is `localhost` or an address in digits (no name of a page that
/// points here), its Origin, if it names one, this server or one of `origins`, and the token is
/// right; else 403. Two Hosts or Origins are 400, too large is 413, too many who know the token and
/// no memory 503. Where the machine has no memory left, that request is lost, not the server.
class Server {
public:
    /// Takes the port; answers nobody before start().
    /// @throws InputError naming the address if it cannot be had
    explicit Server(ServerOptions options);
    /// stop()
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    // Before start(). A path that ends in '/' (but "/") takes all that begin with it; the longest
    // that fits is taken.
    void get(std::string path, Handler handler);
    void post(std::string path, Handler handler);
    /// @param subprotocols  those spoken; the first of them that a client offers is taken, a client
    ///                      that offers none of them gets 400. Empty: none is requested.
    /// @param listener      outlives the server
    void websocket(std::string path, std::vector<std::string> subprotocols, Listener& listener);

    void start();
    /// Sends what is queued, to who takes some of it within five seconds and for thirty at
    /// most, ends all sessions and the thread.
    void stop();

    [[nodiscard]] std::uint16_t port() const;
    /// "http://127.0.0.1:8080/?token=..."
    [[nodiscard]] std::string address(std::string_view scheme = "http") const;

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

/// 128 random bits as 32 hexadecimal digits.
[[nodiscard]] std::string make_token();

}  // namespace limpet::serve
