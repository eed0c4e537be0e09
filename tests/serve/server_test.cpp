// SPDX-License-Identifier: Apache-2.0
#include "limpet/serve/server.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <future>
#include <list>
#include <system_error>
#include <thread>
#include <vector>

#include "../support/allocations.hpp"
#include "client.hpp"
#include "limpet/core/errors.hpp"

using namespace limpet;
using namespace limpet::serve;
using namespace limpet::serve::test;
using testing::HasSubstr;
using testing::StartsWith;

namespace {

/// Repeats what it hears and gives its session away.
class Echo final : public Listener {
public:
    void on_open(const std::shared_ptr<Session>& session) override { opened.set_value(session); }
    void on_text(Session& session, std::string_view text) override {
        if (text == "throw") {
            throw InputError("a listener's own mistake");
        }
        session.send_text(text);
    }
    void on_binary(Session& session, std::string_view bytes) override {
        session.send_binary({"<", bytes, ">"});
    }
    void on_close(Session& /*session*/) override { closed.set_value(); }

    std::promise<std::shared_ptr<Session>> opened;
    std::promise<void> closed;
};

struct Served : testing::Test {
    Echo echo;
    std::unique_ptr<Server> server;

    void serve(ServerOptions options = {}) {
        options.token = "secret";
        server = std::make_unique<Server>(std::move(options));
        server->get("/", [](const Request&) { return Response{.body = "home"}; });
        server->get("/things/", [](const Request& asked) {
            return Response{.content_type = "application/json", .body = asked.path};
        });
        server->post("/things", [](const Request& asked) -> Response {
            if (asked.body == "thread") {
                throw std::system_error(EAGAIN, std::generic_category());
            }
            if (asked.body == "memory") {
                throw std::bad_alloc();
            }
            if (asked.body == "bad") {
                throw InputError("things are good");
            }
            return {.status = 201, .body = asked.body};
        });
        server->websocket("/", {"new", "old"}, echo);
        server->start();
    }
    HttpResponse ask(const HttpRequest& asked) const {
        return HttpClient(server->port()).ask(asked);
    }
    unsigned status(http::verb verb, const std::string& target) const {
        return ask(request(verb, target)).result_int();
    }
};

TEST_F(Served, AnswersWhoKnowsTheToken) {
    serve();
    EXPECT_EQ(server->address("ws"),
              "ws://127.0.0.1:" + std::to_string(server->port()) + "/?token=secret");
    EXPECT_EQ(ask(request(http::verb::get, "/?token=secret")).body(), "home");
    const HttpResponse thing = ask(request(http::verb::get, "/secret/things/3"));
    EXPECT_EQ(thing.body(), "/things/3");
    EXPECT_EQ(thing[http::field::content_type], "application/json");
    HttpRequest sent = request(http::verb::post, "/secret/things");
    sent.body() = "a thing";
    EXPECT_EQ(ask(sent).body(), "a thing");
    sent.body() = "bad";
    EXPECT_EQ(ask(sent).result_int(), 400U);
    EXPECT_EQ(ask(sent).body(), "things are good\n");
}

TEST_F(Served, AWrongTokenIsForbidden) {
    serve();
    for (const char* target : {"/", "/?token=wrong", "/wrong/", "/nowhere", "/?token="}) {
        EXPECT_EQ(status(http::verb::get, target), 403U) << target;
        EXPECT_EQ(status(http::verb::post, target), 403U) << target;
        EXPECT_EQ(handshake_status(server->port(), target, "new"), 403U) << target;
    }
}

TEST_F(Served, AForeignOriginIsForbidden) {
    serve({.origins = {"https://viewer.example"}});
    HttpRequest asked = request(http::verb::get, "/secret/");
    asked.set(http::field::origin, "https://evil.example");
    EXPECT_EQ(ask(asked).result_int(), 403U);
    asked.set(http::field::origin, "http://localhost");
    EXPECT_EQ(ask(asked).result_int(), 200U);
    const std::uint16_t port = server->port();
    EXPECT_EQ(handshake_status(port, "/secret/", "new", "https://evil.example"), 403U);
    EXPECT_EQ(handshake_status(port, "/secret/", "new", "https://viewer.example"), 101U);
}

TEST_F(Served, ANameThatPointsHereIsForbidden) {
    serve();
    HttpRequest asked = request(http::verb::get, "/secret/");
    asked.set(http::field::host, "evil.example");
    EXPECT_EQ(ask(asked).result_int(), 403U);
    EXPECT_EQ(handshake_status(server->port(), "/secret/", "new", "", "evil.example"), 403U);
}

TEST_F(Served, WhatIsNotThereIsNotFound) {
    serve();
    EXPECT_EQ(status(http::verb::get, "/secret/nowhere"), 404U);
    EXPECT_EQ(status(http::verb::post, "/secret/"), 405U);
    EXPECT_EQ(status(http::verb::delete_, "/secret/"), 405U);
    EXPECT_EQ(handshake_status(server->port(), "/secret/nowhere", "new"), 404U);
    EXPECT_EQ(handshake_status(server->port(), "/secret/", "newest"), 400U);
    EXPECT_EQ(handshake_status(server->port(), "/secret/"), 400U);
}

TEST_F(Served, ARequestIsBounded) {
    serve({.most_request_bytes = 100'000});
    HttpRequest sent = request(http::verb::post, "/secret/things");
    sent.body() = std::string(100'000, 'x');
    EXPECT_EQ(ask(sent).result_int(), 201U);
    sent.body() += 'x';
    EXPECT_EQ(ask(sent).result_int(), 413U);
    EXPECT_EQ(status(http::verb::get, "/secret/" + std::string(20'000, 'x')), 431U);
    HttpClient other(server->port());
    boost::asio::write(other.socket(),
                       boost::asio::buffer(std::string("\x16\x03 no HTTP\r\n\r\n")));
    std::string answer(12, ' ');
    boost::asio::read(other.socket(), boost::asio::buffer(answer));
    EXPECT_EQ(answer, "HTTP/1.1 400");
}

TEST_F(Served, AFrameIsBounded) {
    serve({.most_request_bytes = 1000});
    SocketClient client(server->port());
    client.shake_hands("/secret/", "new");
    client.send(std::string(1000, 'x'));
    EXPECT_EQ(client.receive().size(), 1000U);
    client.send(std::string(1001, 'x'));
    EXPECT_EQ(client.receive(), "");
    EXPECT_EQ(client.stream().reason().code, beast::websocket::close_code::too_big);
}

TEST_F(Served, WhoSaysNothingIsLetGo) {
    serve({.request_time = std::chrono::milliseconds(50)});
    HttpClient silent(server->port());
    std::array<char, 1> nothing{};
    beast::error_code error;
    silent.socket().read_some(boost::asio::buffer(nothing), error);
    EXPECT_EQ(error, boost::asio::error::eof);
}

TEST_F(Served, ManyClientsAreBounded) {
    serve({.most_connections = 3});
    std::list<HttpClient> clients;
    for (int i = 0; i < 3; ++i) {
        clients.emplace_back(server->port());
        EXPECT_EQ(clients.back().ask(request(http::verb::get, "/secret/")).result_int(), 200U);
    }
    EXPECT_EQ(status(http::verb::get, "/secret/"), 503U) << "knows the token, there is no place";
    // Those who are there are served on.
    for (HttpClient& client : clients) {
        EXPECT_EQ(client.ask(request(http::verb::get, "/secret/")).result_int(), 200U);
    }
}

/// Who is silent takes no place from who knows the token, however many there are.
TEST_F(Served, SilentStrangersLockNobodyOut) {
    serve({.most_connections = 3});
    HttpClient owner(server->port());
    EXPECT_EQ(owner.ask(request(http::verb::get, "/secret/")).result_int(), 200U);
    std::list<HttpClient> strangers;
    for (int i = 0; i < 40; ++i) {
        strangers.emplace_back(server->port());
        if (i % 2 == 0) {  // half a request
            boost::asio::write(strangers.back().socket(),
                               boost::asio::buffer(std::string("GET / HTTP/1.1\r\nHo")));
        }
    }
    EXPECT_EQ(status(http::verb::get, "/secret/"), 200U) << "a second page of the owner's";
    EXPECT_EQ(handshake_status(server->port(), "/secret/", "new"), 101U);
    EXPECT_EQ(owner.ask(request(http::verb::get, "/secret/")).result_int(), 200U);
    std::array<char, 1> nothing{};
    beast::error_code error;
    strangers.front().socket().read_some(boost::asio::buffer(nothing), error);
    EXPECT_TRUE(error) << "the first of them had to leave";
}

TEST_F(Served, TwoHostsAreOneTooMany) {
    serve();
    for (const http::field twice : {http::field::host, http::field::origin}) {
        HttpRequest asked = request(http::verb::get, "/secret/");
        asked.set(http::field::origin, "http://localhost");
        asked.insert(twice, twice == http::field::host ? "evil.example" : "http://evil.example");
        EXPECT_EQ(ask(asked).result_int(), 400U) << to_string(twice);
    }
}

TEST_F(Served, WithoutMemoryARequestIsRefusedAndTheNextIsServed) {
    serve();
    HttpRequest sent = request(http::verb::post, "/secret/things");
    sent.body() = "memory";
    const HttpResponse answer = ask(sent);
    EXPECT_EQ(answer.result_int(), 503U);
    EXPECT_EQ(answer.body(), "not enough memory\n");
    sent.body() = "thread";
    EXPECT_EQ(ask(sent).result_int(), 503U);
    EXPECT_EQ(status(http::verb::get, "/secret/"), 200U);
}

TEST_F(Served, SessionsSpeakTheFirstSubprotocolThatBothKnow) {
    serve();
    SocketClient client(server->port());
    client.shake_hands("/?token=secret", "other, old, new");
    EXPECT_EQ(client.subprotocol(), "new");
    EXPECT_EQ(echo.opened.get_future().get()->subprotocol(), "new");
    client.send("hello");
    EXPECT_EQ(client.receive(), "hello");
    EXPECT_TRUE(client.got_text());
    client.send_binary("bytes");
    EXPECT_EQ(client.receive(), "<bytes>");
    EXPECT_FALSE(client.got_text());
}

TEST_F(Served, AListenersMistakeEndsThatSessionAlone) {
    serve();
    SocketClient client(server->port());
    client.shake_hands("/secret/", "new");
    client.send("throw");
    EXPECT_EQ(client.receive(), "");
    EXPECT_EQ(client.stream().reason().code, beast::websocket::close_code::internal_error);
    EXPECT_EQ(status(http::verb::get, "/secret/"), 200U);
}

TEST_F(Served, ASlowReaderGetsWhatIsNewAndNobodyWaits) {
    serve({.most_queued_bytes = 100'000});
    SocketClient client(server->port(), 4096);
    client.shake_hands("/secret/", "new");
    const auto session = echo.opened.get_future().get();
    // It reads nothing: what kernel and queue hold, some megabytes at most, is full some time.
    int last = 0;
    const auto send = [&] {
        std::string frame = std::to_string(++last);
        frame.resize(1000);
        return session->stream({frame});
    };
    while (session->dropped() == 0 && last < 100'000) {
        EXPECT_TRUE(send());
        if (last == 3) {
            EXPECT_TRUE(session->send_text("you are slow"));
        }
    }
    EXPECT_TRUE(session->send_binary({"kept"}));
    const std::string two(2000, 'x');
    const long before = allocations();
    for (int i = 0; i < 1000; ++i) {
        session->stream({two});
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_TRUE(send());
    // In order, with a gap; what is kept and the newest are there.
    std::vector<std::string> heard;
    int highest = 0;
    while (highest < last) {
        heard.push_back(client.receive());
        ASSERT_FALSE(heard.back().empty());
        if (const int number = std::atoi(heard.back().c_str()); number > 0) {
            EXPECT_GT(number, highest);
            highest = number;
        }
    }
    EXPECT_THAT(heard, testing::Contains("you are slow"));
    EXPECT_THAT(heard, testing::Contains("kept"));
    EXPECT_GT(session->dropped(), 500U);
}

TEST_F(Served, WhatIsKeptIsBounded) {
    serve({.most_queued_bytes = 10'000});
    SocketClient client(server->port(), 4096);
    client.shake_hands("/secret/", "new");
    const auto session = echo.opened.get_future().get();
    const std::string frame(1000, 'x');
    int sent = 0;
    while (session->send_binary({frame}) && sent < 100'000) {
        ++sent;
    }
    EXPECT_LT(sent, 100'000);
    EXPECT_EQ(session->dropped(), 1U);
    EXPECT_FALSE(session->stream({frame})) << "there is nothing to drop for it";
    EXPECT_EQ(client.receive(), frame);
}

TEST_F(Served, WhoHasVanishedCostsNothing) {
    serve();
    std::shared_ptr<Session> session;
    {
        SocketClient client(server->port());
        client.shake_hands("/secret/", "new");
        session = echo.opened.get_future().get();
    }
    echo.closed.get_future().wait();
    EXPECT_FALSE(session->is_open());
    EXPECT_FALSE(session->send_text("anyone?"));
}

TEST_F(Served, StopSendsWhatIsQueuedAndSaysGoodbye) {
    serve();
    SocketClient client(server->port());
    client.shake_hands("/secret/", "new");
    const auto session = echo.opened.get_future().get();
    for (int i = 0; i < 100; ++i) {
        session->send_text("last words");
    }
    auto heard = std::async(std::launch::async, [&client] {
        int count = 0;
        while (client.receive() == "last words") {
            ++count;
        }
        return count;
    });
    server->stop();
    EXPECT_EQ(heard.get(), 100);
    EXPECT_EQ(client.stream().reason().code, beast::websocket::close_code::going_away);
    EXPECT_FALSE(session->is_open());
}

TEST_F(Served, StopWaitsForWhoReadsSlowly) {
    serve();
    SocketClient client(server->port(), 4096);
    client.shake_hands("/secret/", "new");
    const auto session = echo.opened.get_future().get();
    const std::string frame(10'000, 'x');
    int sent = 0;
    while (session->send_binary({frame})) {
        ++sent;
    }
    auto heard = std::async(std::launch::async, [&client, &frame] {
        int count = 0;
        while (client.receive() == frame) {
            ++count;
            std::this_thread::sleep_for(std::chrono::milliseconds(15));  // well over a second
        }
        return count;
    });
    server->stop();
    EXPECT_EQ(heard.get(), sent);
}

TEST_F(Served, StopDoesNotWaitForWhoDoesNotRead) {
    serve();
    SocketClient client(server->port(), 4096);
    client.shake_hands("/secret/", "new");
    const auto session = echo.opened.get_future().get();
    const std::string frame(10'000, 'x');
    while (session->dropped() == 0) {
        session->stream({frame});
    }
    server->stop();
    EXPECT_FALSE(session->is_open());
}

TEST(Server, APortThatIsTakenIsSaidInOneLine) {
    const Server first({});
    try {
        const Server second({.port = first.port()});
        FAIL() << "the port is taken";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(),
                    StartsWith("cannot serve on 127.0.0.1:" + std::to_string(first.port()) + ": "));
        EXPECT_THAT(error.what(), HasSubstr("Address already in use"));
    }
    EXPECT_THROW(Server({.host = "example.org"}), InputError);
}

}  // namespace
