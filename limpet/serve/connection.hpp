// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "limpet/serve/server.hpp"

// The connections behind a Server; all of it on its thread.
namespace limpet::serve {

/// Where requests go.
struct Routes {
    struct Socket {
        std::vector<std::string> subprotocols;
        Listener* listener = nullptr;
    };
    std::map<std::string, Handler, std::less<>> get, post;
    std::map<std::string, Socket, std::less<>> sockets;
};

/// One who is connected, by HTTP or as a WebSocket.
class Connection {
public:
    virtual ~Connection() = default;
    /// Has shown the token, and so may stay; who has not makes space for newcomers.
    [[nodiscard]] virtual bool known() const = 0;
    /// Sends what has been queued meanwhile.
    virtual void flush() = 0;
    /// Ends it once what has been queued is out.
    virtual void finish() = 0;
    /// Ends it at once.
    virtual void drop() = 0;

    const std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();

protected:
    Connection() = default;
    Connection(const Connection&) = default;
    Connection& operator=(const Connection&) = default;
};

/// What the connections share; it outlives them.
struct Shared {
    ServerOptions options;
    Routes routes = {};
    std::set<Connection*> connections = {};
    bool stopping = false;
    std::chrono::steady_clock::time_point last_frame_out = {};  ///< to anybody

    [[nodiscard]] std::size_t known_ones() const;
    /// A place for a newcomer: the stranger who is here longest leaves where there are
    /// options.most_connections of them.
    void make_space();
};

/// Serves requests until the client goes, or becomes a WebSocket.
void serve_connection(boost::asio::ip::tcp::socket socket, Shared& shared);

}  // namespace limpet::serve
