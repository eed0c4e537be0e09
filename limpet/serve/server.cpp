// SPDX-License-Identifier: Apache-2.0
#include "limpet/serve/server.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/steady_timer.hpp>
#include <thread>

#include "limpet/core/errors.hpp"
#include "limpet/serve/connection.hpp"

namespace limpet::serve {
namespace {

using boost::asio::ip::tcp;
using boost::system::error_code;
using std::chrono::milliseconds;

// Assumed: quicker than a viewer draws, and so seldom that nobody notices the waking.
constexpr milliseconds kFlush(10);
// What is on its way can't be dropped any more for what is new.
constexpr int kMostOnTheWay_bytes = 1 << 18;
// Assumed: who takes nothing for so long has gone, a page that draws slowly has not; nobody is
// waited for longer than that.
constexpr milliseconds kLastWords(5000), kLongestGoodbye(30'000);

tcp::endpoint endpoint_of(const ServerOptions& options) {
    error_code error;
    const auto address = boost::asio::ip::make_address_v4(
        options.host == "localhost" ? "127.0.0.1" : options.host, error);
    if (error) {
        throw InputError(fmt::format("cannot serve on '{}': an IPv4 address in digits or localhost",
                                     options.host));
    }
    return {address, options.port};
}

}  // namespace

struct Server::Inside {
    explicit Inside(ServerOptions options) : shared{.options = std::move(options)} {
        const tcp::endpoint here = endpoint_of(shared.options);
        acceptor.open(here.protocol());
        fcntl(acceptor.native_handle(), F_SETFD, FD_CLOEXEC);
        acceptor.set_option(tcp::acceptor::reuse_address(true));  // else TIME_WAIT bars a restart
        error_code error;
        acceptor.bind(here, error);
        if (!error) {
            acceptor.listen(boost::asio::socket_base::max_listen_connections, error);
        }
        if (error) {
            throw InputError(fmt::format("cannot serve on {}:{}: {}", shared.options.host,
                                         shared.options.port, error.message()));
        }
        port = acceptor.local_endpoint().port();
    }

    void accept() {
        acceptor.async_accept([this](error_code error, tcp::socket socket) {
            accepting = false;
            if (!acceptor.is_open()) {
                return;
            }
            if (!error) {
                shared.make_space();
                fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
                error_code ignored;
                socket.set_option(tcp::no_delay(true), ignored);
                socket.set_option(tcp::socket::send_buffer_size(kMostOnTheWay_bytes), ignored);
                serve_connection(std::move(socket), shared);
                accept();
            } else {  // no file descriptors left, say: not again and again at once
                pause.expires_after(milliseconds(100));
                pause.async_wait([this](error_code) {
                    if (acceptor.is_open()) {
                        accept();
                    }
                });
                accepting = true;
            }
        });
        accepting = true;
    }

    /// Until all is sent. What throws (memory is at its end) loses its own connection alone; who
    /// accepts and who flushes go on.
    void run() {
        for (;;) {
            try {
                if (!accepting && acceptor.is_open()) {
                    accept();
                }
                if (!flushing) {
                    keep_flushing();
                }
                io.run();
                return;
            } catch (const std::exception&) {
                std::this_thread::sleep_for(milliseconds(10));
            }
        }
    }

    void keep_flushing() {
        timer.expires_after(kFlush);
        timer.async_wait([this](error_code) {
            flushing = false;
            const auto all = shared.connections;  // who ends leaves the set
            for (Connection* connection : all) {
                if (shared.connections.count(connection) != 0) {
                    connection->flush();
                }
            }
            if (shared.stopping && (shared.connections.empty() || all_is_said())) {
                const auto rest = shared.connections;
                for (Connection* connection : rest) {
                    connection->drop();
                }
                flushing = true;  // it need not any more
            } else {
                keep_flushing();
            }
        });
        flushing = true;
    }

    /// Or there is nobody who listens.
    [[nodiscard]] bool all_is_said() const {
        const auto now = std::chrono::steady_clock::now();
        return now > std::max(shared.last_frame_out, stopped) + kLastWords ||
               now > stopped + kLongestGoodbye;
    }

    void finish() {
        shared.stopping = true;
        stopped = std::chrono::steady_clock::now();
        error_code ignored;
        acceptor.close(ignored);
        pause.cancel();
        const auto all = shared.connections;
        for (Connection* connection : all) {
            connection->finish();
        }
    }

    Shared shared;
    boost::asio::io_context io{1};
    tcp::acceptor acceptor{io};
    boost::asio::steady_timer timer{io}, pause{io};
    std::chrono::steady_clock::time_point stopped;
    std::uint16_t port = 0;
    bool accepting = false, flushing = false;  ///< that is under way
    std::thread thread;
};

Server::Server(ServerOptions options) : inside_(std::make_unique<Inside>(std::move(options))) {}

Server::~Server() {
    stop();
}

void Server::get(std::string path, Handler handler) {
    inside_->shared.routes.get[std::move(path)] = std::move(handler);
}

void Server::post(std::string path, Handler handler) {
    inside_->shared.routes.post[std::move(path)] = std::move(handler);
}

void Server::websocket(std::string path, std::vector<std::string> subprotocols,
                       Listener& listener) {
    inside_->shared.routes.sockets[std::move(path)] = {std::move(subprotocols), &listener};
}

void Server::start() {
    require(!inside_->thread.joinable(), "a server is started once");
    inside_->thread = std::thread([this] { inside_->run(); });
}

void Server::stop() {
    if (inside_->thread.joinable()) {
        boost::asio::post(inside_->io, [this] { inside_->finish(); });
        inside_->thread.join();
    }
}

std::uint16_t Server::port() const {
    return inside_->port;
}

std::string Server::address(std::string_view scheme) const {
    const ServerOptions& options = inside_->shared.options;
    return fmt::format("{}://{}:{}/{}{}", scheme, options.host, inside_->port,
                       options.token.empty() ? "" : "?token=", options.token);
}

}  // namespace limpet::serve
