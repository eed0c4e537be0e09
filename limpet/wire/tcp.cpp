// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <thread>

#include "limpet/wire/stream_transport.hpp"

namespace limpet::wire {
namespace {

using boost::asio::ip::tcp;
using boost::system::error_code;
using std::chrono::nanoseconds;

// Assumed: short compared with the start of an autopilot, long compared with a refusal on loopback
// (some 50 us).
constexpr nanoseconds kRetry = std::chrono::milliseconds(100);

constexpr short kGoing = POLLRDHUP | POLLHUP | POLLERR;

/// Small messages go at once (TCP_NODELAY): in lockstep each waits for the answer to the last.
void make_ready(tcp::socket& socket) {
    error_code ignored;  // a peer that is gone already shows at the first transfer
    socket.set_option(tcp::no_delay(true), ignored);
    socket.non_blocking(true, ignored);
    close_on_exec(socket.native_handle());
}

class TcpServer final : public StreamTransport<tcp::socket> {
public:
    explicit TcpServer(const TransportAddress& address)
        : StreamTransport(address, TransferStatus::timed_out) {
        const tcp::endpoint here(boost::asio::ip::make_address(address.host), address.port);
        acceptor_.open(here.protocol());
        close_on_exec(acceptor_.native_handle());
        acceptor_.set_option(tcp::acceptor::reuse_address(true));  // else TIME_WAIT bars a restart
        // Otherwise accept() sleeps, for ever, after a client that gave up in the queue.
        acceptor_.set_option(boost::asio::socket_base::enable_connection_aborted(true));
        acceptor_.non_blocking(true);
        error_code error;
        acceptor_.bind(here, error);
        if (!error) {
            acceptor_.listen(kQueue, error);
        }
        if (error) {
            refuse_address(address_, error.value());
        }
        address_.port = acceptor_.local_endpoint().port();
    }

    bool wait_for_peer(nanoseconds timeout) override {
        const Deadline deadline(timeout);
        if (stream_.is_open()) {
            (void)wait(0, Deadline({}));  // turns away who knocks meanwhile
        }
        return !closed_ && found(deadline);
    }

    void close() override {
        StreamTransport::close();
        error_code ignored;
        acceptor_.close(ignored);
    }

    std::string describe() const override {
        error_code error;
        const tcp::endpoint peer = stream_.remote_endpoint(error);
        return fmt::format(
            "{} (server, {})", to_text(address_),
            closed_ ? "closed"
            : error ? "nobody there"
                    : fmt::format("peer {}:{}", peer.address().to_string(), peer.port()));
    }

private:
    static constexpr int kQueue = 4;

    bool found(const Deadline& deadline) override {
        while (!stream_.is_open() && !accept_one()) {
            pollfd knock{acceptor_.native_handle(), POLLIN, 0};
            if (!wait_ready({&knock, 1}, deadline)) {
                return false;
            }
        }
        return true;
    }

    bool accept_one() {
        error_code error;
        acceptor_.accept(stream_, error);
        if (error) {
            return false;
        }
        make_ready(stream_);
        ++statistics_.peers;
        return true;
    }

    /// Closes a second client by a reset, so that it sees at once that it is not wanted.
    void turn_away_one() {
        error_code error;
        tcp::socket newcomer(io_);
        acceptor_.accept(newcomer, error);
        if (!error) {
            close_on_exec(newcomer.native_handle());
            newcomer.set_option(boost::asio::socket_base::linger(true, 0), error);
            newcomer.close(error);  // its destructor would take the linger back
            ++statistics_.peers_refused;
        }
    }

    /// Waits for `events` of the client, and meanwhile turns away others. While the client is
    /// going, they stay in the queue: one of them is likely the same client, back again.
    bool wait(short events, const Deadline& deadline) override {
        bool door = true;
        for (;;) {
            std::array<pollfd, 2> fds{
                pollfd{stream_.native_handle(), static_cast<short>(events | POLLRDHUP), 0},
                pollfd{door ? acceptor_.native_handle() : -1, POLLIN, 0}};
            if (events == POLLOUT && !door) {
                fds[0].events = POLLOUT;  // it may still read; its hang-up is known and would spin
            }
            if (!wait_ready(fds, deadline)) {
                return false;
            }
            if (fds[0].revents & (events | POLLHUP | POLLERR)) {
                if (!(fds[0].revents & kGoing) && fds[1].revents != 0) {
                    turn_away_one();
                }
                return true;
            }
            if (fds[0].revents & kGoing) {
                if (events != POLLOUT) {
                    return true;
                }
                door = false;
            } else if (fds[1].revents != 0) {
                turn_away_one();
            }
        }
    }

    tcp::acceptor acceptor_{io_};
};

class TcpClient final : public StreamTransport<tcp::socket> {
public:
    explicit TcpClient(const TransportAddress& address)
        : StreamTransport(address, TransferStatus::timed_out),
          there_(boost::asio::ip::make_address(address.host), address.port) {}

    std::string describe() const override {
        return fmt::format("{} (client, {})", to_text(address_),
                           closed_      ? "closed"
                           : connected_ ? "connected"
                                        : "not connected");
    }

private:
    /// Goes on where the last call stopped: with the pause after a refusal, or a pending
    /// connection.
    bool found(const Deadline& deadline) override {
        while (!connected_) {
            if (!stream_.is_open()) {
                std::this_thread::sleep_for(std::min(deadline.remaining(), next_try_.remaining()));
                if (!next_try_.passed()) {
                    return false;
                }
                begin();
            }
            if (stream_.is_open()) {
                if (!wait(POLLOUT, deadline)) {
                    return false;
                }
                finish();
            }
        }
        return true;
    }

    // By hand: Asio's connect() would wait as long as the network does, two minutes and more.
    void begin() {
        stream_.open(tcp::v4());
        make_ready(stream_);
        if (::connect(stream_.native_handle(), there_.data(),
                      static_cast<socklen_t>(there_.size())) != 0 &&
            errno != EINPROGRESS && errno != EINTR) {
            give_up();
        }
    }

    void finish() {
        int error = 0;
        socklen_t size = sizeof(error);
        getsockopt(stream_.native_handle(), SOL_SOCKET, SO_ERROR, &error, &size);
        error_code ignored;
        // A port of the kernel's own range can be given to this very socket, which then meets
        // itself.
        connected_ =
            error == 0 && stream_.local_endpoint(ignored) != stream_.remote_endpoint(ignored);
        if (connected_) {
            ++statistics_.peers;
        } else {
            give_up();
        }
    }

    void give_up() {
        shut();
        next_try_ = Deadline(kRetry);
    }

    void shut() override {
        connected_ = false;
        StreamTransport::shut();
    }

    tcp::endpoint there_;
    Deadline next_try_{nanoseconds(0)};
    bool connected_ = false;
};

}  // namespace

std::unique_ptr<Transport> listen_tcp(const TransportAddress& address) {
    return std::make_unique<TcpServer>(address);
}

std::unique_ptr<Transport> connect_tcp(const TransportAddress& address) {
    return std::make_unique<TcpClient>(address);
}

}  // namespace limpet::wire
