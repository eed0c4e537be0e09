// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

// One who talks to a server on this machine, waiting for each answer.
namespace limpet::serve::test {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::asio::ip::tcp;

inline tcp::endpoint here(std::uint16_t port) {
    return {boost::asio::ip::address_v4::loopback(), port};
}

/// Waits for what another thread does, a minute at most: a test fails before its own limit.
/// @return whether it came
template <class Condition>
[[nodiscard]] bool comes(const Condition& condition) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > until) {
            return false;
        }
        std::this_thread::yield();
    }
    return true;
}

using HttpRequest = http::request<http::string_body>;
using HttpResponse = http::response<http::string_body>;

inline HttpRequest request(http::verb verb, const std::string& target) {
    HttpRequest asked(verb, target, 11);
    asked.set(http::field::host, "localhost");
    return asked;
}

class HttpClient {
public:
    explicit HttpClient(std::uint16_t port) { socket_.connect(here(port)); }

    HttpResponse ask(HttpRequest asked) {
        asked.prepare_payload();
        beast::error_code ignored;  // who is refused may be so before all is sent
        http::write(socket_, asked, ignored);
        HttpResponse answer;
        http::read(socket_, buffer_, answer);
        return answer;
    }
    tcp::socket& socket() { return socket_; }

private:
    boost::asio::io_context io_;
    tcp::socket socket_{io_};
    beast::flat_buffer buffer_;
};

/// The status that a WebSocket's handshake is answered with; 101: welcome.
inline unsigned handshake_status(std::uint16_t port, const std::string& target,
                                 const std::string& subprotocols = "",
                                 const std::string& origin = "",
                                 const std::string& host = "localhost") {
    HttpRequest asked = request(http::verb::get, target);
    asked.set(http::field::host, host);
    asked.set(http::field::connection, "Upgrade");
    asked.set(http::field::upgrade, "websocket");
    asked.set(http::field::sec_websocket_version, "13");
    asked.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
    if (!subprotocols.empty()) {
        asked.set(http::field::sec_websocket_protocol, subprotocols);
    }
    if (!origin.empty()) {
        asked.set(http::field::origin, origin);
    }
    return HttpClient(port).ask(asked).result_int();
}

class SocketClient {
public:
    using Stream = beast::websocket::stream<tcp::socket>;

    /// @param receive_bytes  of the kernel's buffer; 0: its own choice
    explicit SocketClient(std::uint16_t port, int receive_bytes = 0) : stream_(io_) {
        tcp::socket& socket = stream_.next_layer();
        socket.open(tcp::v4());
        if (receive_bytes != 0) {
            socket.set_option(boost::asio::socket_base::receive_buffer_size(receive_bytes));
        }
        socket.connect(here(port));
    }

    /// @throws boost::system::system_error if it is refused
    void shake_hands(const std::string& target, const std::string& subprotocols = "") {
        stream_.set_option(beast::websocket::stream_base::decorator(
            [subprotocols](beast::websocket::request_type& asked) {
                asked.set(http::field::sec_websocket_protocol, subprotocols);
            }));
        stream_.handshake(answer_, "localhost", target);
    }
    std::string subprotocol() const {
        const auto name = answer_[http::field::sec_websocket_protocol];
        return {name.data(), name.size()};
    }

    void send(const std::string& text) {
        stream_.text(true);
        stream_.write(boost::asio::buffer(text));
    }
    void send_binary(const std::string& bytes) {
        stream_.binary(true);
        stream_.write(boost::asio::buffer(bytes));
    }
    /// The next frame; empty once it is over.
    /// @throws std::runtime_error if nothing comes within a minute: a test fails before its own
    /// limit
    std::string receive() {
        beast::flat_buffer buffer;
        beast::error_code ended = boost::asio::error::in_progress;
        stream_.async_read(buffer,
                           [&ended](beast::error_code error, std::size_t) { ended = error; });
        io_.restart();
        io_.run_for(std::chrono::minutes(1));
        if (ended == boost::asio::error::in_progress) {
            stream_.next_layer().close();
            io_.run();  // the handler is called, while what it writes to is there
            throw std::runtime_error("nothing came within a minute");
        }
        return ended ? "" : beast::buffers_to_string(buffer.data());
    }
    bool got_text() const { return stream_.got_text(); }
    Stream& stream() { return stream_; }

private:
    boost::asio::io_context io_;
    Stream stream_;
    beast::websocket::response_type answer_;
};

}  // namespace limpet::serve::test
