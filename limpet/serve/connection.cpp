// SPDX-License-Identifier: Apache-2.0
#include "limpet/serve/connection.hpp"

#include <algorithm>
#include <boost/asio/dispatch.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <new>
#include <optional>
#include <system_error>

#include "limpet/core/errors.hpp"
#include "limpet/serve/address.hpp"

namespace limpet::serve {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using beast::error_code;

namespace {

constexpr std::uint32_t kMostHeaderBytes = 16 * 1024;

std::string text_of(beast::string_view view) {
    return {view.data(), view.size()};
}

/// Exactly, else the longest that ends in '/' and begins `path`.
template <class Map>
const typename Map::mapped_type* find_route(const Map& routes, std::string_view path) {
    if (const auto exact = routes.find(path); exact != routes.end()) {
        return &exact->second;
    }
    for (std::size_t end = path.rfind('/'); end != std::string_view::npos && end > 0;
         end = path.rfind('/', end - 1)) {
        if (const auto found = routes.find(path.substr(0, end + 1)); found != routes.end()) {
            return &found->second;
        }
    }
    return nullptr;
}

/// The first of those spoken that the client offers ("a, b"); nothing if it offers none of them.
std::optional<std::string> choose_subprotocol(const std::vector<std::string>& spoken,
                                              beast::string_view offered) {
    if (spoken.empty()) {
        return "";
    }
    for (const std::string& one : spoken) {
        for (const auto& offer : http::token_list(offered)) {
            if (offer == one) {
                return one;
            }
        }
    }
    return std::nullopt;
}

}  // namespace

std::size_t Shared::known_ones() const {
    return static_cast<std::size_t>(
        std::count_if(connections.begin(), connections.end(),
                      [](const Connection* connection) { return connection->known(); }));
}

void Shared::make_space() {
    if (connections.size() - known_ones() < options.most_connections) {
        return;
    }
    Connection* oldest = nullptr;
    for (Connection* connection : connections) {
        if (!connection->known() && (oldest == nullptr || connection->since < oldest->since)) {
            oldest = connection;
        }
    }
    oldest->drop();  // leaves the set a moment later
}

/// The server's end of a session.
class WebSocket final : public Connection, public std::enable_shared_from_this<WebSocket> {
public:
    WebSocket(beast::tcp_stream stream, Shared& shared, Listener& listener, std::string subprotocol)
        : shared_(shared),
          listener_(listener),
          socket_(std::move(stream)),
          session_(
              std::make_shared<Session>(shared.options.most_queued_bytes, std::move(subprotocol))) {
        shared_.connections.insert(this);
    }
    ~WebSocket() override {
        shared_.connections.erase(this);
        session_->open_ = false;
        if (opened_) {
            try {
                listener_.on_close(*session_);
            } catch (const std::exception&) {  // it is over anyway
            }
        }
    }

    void run(const http::request<http::string_body>& upgrade) {
        auto times = websocket::stream_base::timeout::suggested(beast::role_type::server);
        times.handshake_timeout = shared_.options.request_time;
        times.idle_timeout = std::chrono::seconds(60);
        times.keep_alive_pings = true;  // who has vanished is found out
        socket_.set_option(times);
        socket_.read_message_max(shared_.options.most_request_bytes);
        socket_.set_option(websocket::stream_base::decorator(
            [name = session_->subprotocol()](websocket::response_type& response) {
                if (!name.empty()) {
                    response.set(http::field::sec_websocket_protocol, name);
                }
            }));
        socket_.async_accept(upgrade, [self = shared_from_this()](error_code error) {
            if (!error) {
                self->opened_ = true;
                self->guarded([&] { self->listener_.on_open(self->session_); });
                self->flush();
                self->read();
            }
        });
    }

    [[nodiscard]] bool known() const override { return true; }
    void flush() override {
        if (!opened_ || writing_ || closing_) {
            return;
        }
        FrameQueue::Frame frame;
        if (session_->next(frame)) {
            writing_ = true;
            socket_.text(frame.text);
            socket_.async_write(
                boost::asio::buffer(frame.bytes.data(), frame.bytes.size()),
                [self = shared_from_this()](error_code error, std::size_t /*bytes*/) {
                    self->writing_ = false;
                    if (!error) {
                        self->shared_.last_frame_out = std::chrono::steady_clock::now();
                        self->flush();
                    }
                });
        } else if (session_->asked_to_close_) {
            closing_ = true;
            socket_.async_close(reason_, [self = shared_from_this()](error_code) {});
        }
    }

    void finish() override {
        reason_ = websocket::close_code::going_away;
        session_->close();
        flush();
    }

    void drop() override { beast::get_lowest_layer(socket_).close(); }

private:
    template <class Call>
    void guarded(const Call& call) {
        try {
            call();
        } catch (const std::exception&) {
            reason_ = websocket::close_code::internal_error;
            session_->close();
        }
    }

    void read() {
        socket_.async_read(incoming_, [self = shared_from_this()](error_code error, std::size_t) {
            if (error) {
                self->session_->open_ = false;
                return;
            }
            const auto bytes = self->incoming_.cdata();
            const std::string_view message(static_cast<const char*>(bytes.data()), bytes.size());
            self->guarded([&] {
                if (self->socket_.got_text()) {
                    self->listener_.on_text(*self->session_, message);
                } else {
                    self->listener_.on_binary(*self->session_, message);
                }
            });
            self->incoming_.consume(bytes.size());
            self->flush();
            self->read();
        });
    }

    Shared& shared_;
    Listener& listener_;
    websocket::stream<beast::tcp_stream> socket_;
    beast::flat_buffer incoming_;
    std::shared_ptr<Session> session_;
    websocket::close_reason reason_ = websocket::close_code::normal;
    bool opened_ = false, writing_ = false, closing_ = false;
};

namespace {

class HttpConnection final : public Connection,
                             public std::enable_shared_from_this<HttpConnection> {
public:
    HttpConnection(boost::asio::ip::tcp::socket socket, Shared& shared)
        : shared_(shared), stream_(std::move(socket)) {
        shared_.connections.insert(this);
    }
    ~HttpConnection() override { shared_.connections.erase(this); }

    void read() {
        parser_.emplace();
        parser_->header_limit(kMostHeaderBytes);
        parser_->body_limit(shared_.options.most_request_bytes);
        stream_.expires_after(shared_.options.request_time);
        http::async_read(stream_, incoming_, *parser_,
                         [self = shared_from_this()](error_code error, std::size_t /*bytes*/) {
                             self->answer_to(error);
                         });
    }

    [[nodiscard]] bool known() const override { return known_; }
    void flush() override {}
    void finish() override {
        if (!writing_) {
            drop();
        }
    }
    void drop() override { stream_.close(); }

private:
    void answer_to(error_code error) {
        if (error == http::error::end_of_stream || error == beast::error::timeout) {
            return;
        }
        if (error == http::error::body_limit || error == http::error::header_limit) {
            send({.status = error == http::error::body_limit ? 413U : 431U,
                  .body = "the request is too large\n"},
                 false);
        } else if (error.category() == make_error_code(http::error::bad_method).category()) {
            send({.status = 400, .body = "this is no HTTP request\n"}, false);
        } else if (!error) {
            const bool upgrade = websocket::is_upgrade(parser_->get());
            if (auto response = respond(upgrade)) {
                send(std::move(*response), !upgrade && parser_->get().keep_alive());
            }
        }
    }

    /// Nothing once it has become a WebSocket.
    std::optional<Response> respond(bool upgrade) {
        auto& message = parser_->get();
        if (message.count(http::field::host) > 1 || message.count(http::field::origin) > 1) {
            return Response{.status = 400, .body = "one Host and one Origin, not several\n"};
        }
        const std::string host = text_of(message[http::field::host]);
        if (!host_allowed(host)) {
            return Response{.status = 403,
                            .body = "call this by localhost or an address in digits\n"};
        }
        if (!origin_allowed(text_of(message[http::field::origin]), host, shared_.options.origins)) {
            return Response{.status = 403, .body = "pages of others may not come in\n"};
        }
        try {
            const std::string& token = shared_.options.token;
            Target target = parse_target(text_of(message.target()), token);
            if (!token.empty() && !same_token(target.token, token)) {
                return Response{.status = 403,
                                .body = "the address lacks its token: take it as printed\n"};
            }
            if (!known_ && shared_.known_ones() >= shared_.options.most_connections) {
                return Response{.status = 503, .body = "too many are connected\n"};
            }
            known_ = true;
            if (upgrade) {
                return become_websocket(target.request.path);
            }
            return call(std::move(target.request));
        } catch (const InputError& error) {
            return Response{.status = 400, .body = std::string(error.what()) + "\n"};
        } catch (const std::bad_alloc&) {
            return Response{.status = 503, .body = "not enough memory\n"};
        } catch (const std::system_error& error) {
            const bool for_now = error.code() == std::errc::resource_unavailable_try_again;
            return Response{.status = for_now ? 503U : 500U,  // no thread to be had
                            .body = std::string(error.what()) + "\n"};
        } catch (const std::exception& error) {
            return Response{.status = 500, .body = std::string(error.what()) + "\n"};
        }
    }

    std::optional<Response> become_websocket(const std::string& path) {
        const auto& message = parser_->get();
        const Routes::Socket* route = find_route(shared_.routes.sockets, path);
        if (route == nullptr) {
            return Response{.status = 404, .body = "no such WebSocket\n"};
        }
        auto subprotocol =
            choose_subprotocol(route->subprotocols, message[http::field::sec_websocket_protocol]);
        if (!subprotocol) {
            return Response{.status = 400, .body = "none of the offered subprotocols is spoken\n"};
        }
        stream_.expires_never();  // the WebSocket has times of its own
        std::make_shared<WebSocket>(std::move(stream_), shared_, *route->listener,
                                    std::move(*subprotocol))
            ->run(message);
        return std::nullopt;
    }

    Response call(Request request) {
        auto& message = parser_->get();
        const bool is_get = message.method() == http::verb::get;
        const bool is_post = message.method() == http::verb::post;
        const Routes& routes = shared_.routes;
        const Handler* handler = is_get    ? find_route(routes.get, request.path)
                                 : is_post ? find_route(routes.post, request.path)
                                           : nullptr;
        if (handler == nullptr) {
            const bool known = find_route(routes.get, request.path) != nullptr ||
                               find_route(routes.post, request.path) != nullptr;
            return {.status = known ? 405U : 404U,
                    .body = known ? "not by this method\n" : "no such page\n"};
        }
        request.method = text_of(message.method_string());
        request.content_type = text_of(message[http::field::content_type]);
        request.body = std::move(message.body());
        return (*handler)(request);
    }

    void send(Response response, bool keep_alive) {
        answer_ = {};
        answer_.version(11);
        answer_.result(response.status);
        answer_.set(http::field::content_type, response.content_type);
        // A page with a token in its address sends it to nobody, and nobody keeps or guesses what
        // it is.
        answer_.set(http::field::cache_control, "no-store");
        answer_.set("Referrer-Policy", "no-referrer");
        answer_.set("X-Content-Type-Options", "nosniff");
        for (const auto& [name, value] : response.headers) {
            answer_.set(name, value);
        }
        answer_.keep_alive(keep_alive && !shared_.stopping);
        answer_.body() = std::move(response.body);
        answer_.prepare_payload();
        stream_.expires_after(shared_.options.request_time);
        writing_ = true;
        http::async_write(stream_, answer_,
                          [self = shared_from_this()](error_code error, std::size_t /*bytes*/) {
                              self->writing_ = false;
                              self->after_sending(error);
                          });
    }

    void after_sending(error_code error) {
        if (!error && answer_.keep_alive() && !shared_.stopping) {
            read();
            return;
        }
        error_code ignored;
        stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
        drain();
    }

    /// What is still coming is read and thrown away, for a while: closed at once, the answer to a
    /// request that is too large would be lost with it.
    void drain() {
        stream_.async_read_some(boost::asio::buffer(waste_),
                                [self = shared_from_this()](error_code error, std::size_t bytes) {
                                    self->drained_bytes_ += bytes;
                                    if (!error && self->drained_bytes_ < kMostDrainedBytes) {
                                        self->drain();
                                    }
                                });
    }

    static constexpr std::size_t kMostDrainedBytes = std::size_t{16} << 20U;

    Shared& shared_;
    beast::tcp_stream stream_;
    beast::flat_buffer incoming_;
    std::optional<http::request_parser<http::string_body>> parser_;
    http::response<http::string_body> answer_;
    std::array<char, 4096> waste_{};
    std::size_t drained_bytes_ = 0;
    bool writing_ = false;
    bool known_ = false;
};

}  // namespace

void serve_connection(boost::asio::ip::tcp::socket socket, Shared& shared) {
    std::make_shared<HttpConnection>(std::move(socket), shared)->read();
}

}  // namespace limpet::serve
