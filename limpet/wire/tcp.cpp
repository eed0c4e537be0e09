// SPDX-License-Identifier: Apache-2.0
#include "limpet/wire/tcp.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <thread>

#include "limpet/core/errors.hpp"
#include "limpet/wire/readiness.hpp"
#include "limpet/wire/socket_errors.hpp"
#include "limpet/wire/stream_transfer.hpp"

namespace limpet::wire {
namespace {

using boost::asio::ip::tcp;
using boost::system::error_code;
using std::chrono::nanoseconds;

// Assumed: short beside the start of an autopilot, long beside a refusal on loopback (some 50 us).
constexpr nanoseconds kRetry = std::chrono::milliseconds(100);

constexpr short kGoing = POLLRDHUP | POLLHUP | POLLERR;

/// Small messages go at once (TCP_NODELAY): in lockstep each waits for the answer to the last.
void make_ready(tcp::socket& socket) {
    error_code ignored;  // a peer that is gone already shows at the first transfer
    socket.set_option(tcp::no_delay(true), ignored);
    socket.non_blocking(true, ignored);
    close_on_exec(socket.native_handle());
}

void shut(tcp::socket& socket) {
    error_code ignored;
    socket.close(ignored);
}

class TcpServer final : public Transport {
public:
    explicit TcpServer(const TransportAddress& address)
        : address_(address), io_(1), acceptor_(io_), client_(io_), newcomer_(io_) {
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
            refuse_address(address_, error);
        }
        address_.port = acceptor_.local_endpoint().port();
    }

    Transfer send(std::span<const std::byte> bytes, nanoseconds timeout) override {
        if (closed_) {
            return {TransferStatus::closed, 0};
        }
        if (!client_.is_open() && !accept_one()) {
            ++statistics_.void_sends;
            return {TransferStatus::no_peer, 0};
        }
        const Deadline deadline(timeout);
        return noticing_loss(send_all(
            client_, bytes, [&](short events) { return wait(events, deadline); }, statistics_));
    }

    Transfer receive(std::span<std::byte> into, nanoseconds timeout) override {
        require(!into.empty(), "receive is given room");
        if (closed_) {
            return {TransferStatus::closed, 0};
        }
        const Deadline deadline(timeout);
        if (!accepted(deadline)) {
            return {TransferStatus::timed_out, 0};
        }
        return noticing_loss(receive_some(
            client_, into, [&](short events) { return wait(events, deadline); }, statistics_));
    }

    bool wait_for_peer(nanoseconds timeout) override {
        if (closed_) {
            return false;
        }
        const Deadline deadline(timeout);
        if (client_.is_open()) {
            (void)wait(0, Deadline(nanoseconds(0)));  // turns away who knocks meanwhile
        }
        return accepted(deadline);
    }

    void close() override {
        closed_ = true;
        shut(client_);
        error_code ignored;
        acceptor_.close(ignored);
    }

    TransportAddress address() const override { return address_; }

    std::string describe() const override {
        if (closed_) {
            return to_text(address_) + " (server, closed)";
        }
        return fmt::format("{} (server, {})", to_text(address_), peer_text(client_));
    }

    const TransportStatistics& statistics() const override { return statistics_; }

private:
    static constexpr int kQueue = 4;

    bool accepted(const Deadline& deadline) {
        while (!client_.is_open() && !accept_one()) {
            pollfd knock{acceptor_.native_handle(), POLLIN, 0};
            if (!wait_ready({&knock, 1}, deadline)) {
                return false;
            }
        }
        return true;
    }

    bool accept_one() {
        error_code error;
        acceptor_.accept(client_, error);
        if (error) {
            if (!try_again(error) && error != boost::asio::error::connection_aborted) {
                statistics_.last_error = error.value();
            }
            return false;
        }
        make_ready(client_);
        ++statistics_.peers;
        return true;
    }

    /// Closes a second client by a reset, so that it sees at once that it is not wanted.
    void turn_away_one() {
        error_code error;
        acceptor_.accept(newcomer_, error);
        if (!error) {
            newcomer_.set_option(boost::asio::socket_base::linger(true, 0), error);
            shut(newcomer_);
            ++statistics_.peers_refused;
        }
    }

    /// Waits for `events` of the client, and meanwhile turns away others. While the client is
    /// going, they stay in the queue: one of them is likely the same client, back again.
    bool wait(short events, const Deadline& deadline) {
        bool door = true;
        for (;;) {
            std::array<pollfd, 2> fds{
                pollfd{client_.native_handle(), static_cast<short>(events | POLLRDHUP), 0},
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

    Transfer noticing_loss(Transfer transfer) {
        if (transfer.status == TransferStatus::peer_lost) {
            shut(client_);
            ++statistics_.peers_lost;
        }
        return transfer;
    }

    TransportAddress address_;
    boost::asio::io_context io_;
    tcp::acceptor acceptor_;
    tcp::socket client_;
    tcp::socket newcomer_;
    TransportStatistics statistics_;
    bool closed_ = false;
};

class TcpClient final : public Transport {
public:
    explicit TcpClient(const TransportAddress& address)
        : address_(address),
          there_(boost::asio::ip::make_address(address.host), address.port),
          io_(1),
          server_(io_) {}

    Transfer send(std::span<const std::byte> bytes, nanoseconds timeout) override {
        if (closed_) {
            return {TransferStatus::closed, 0};
        }
        if (!connected(Deadline(nanoseconds(0)))) {
            ++statistics_.void_sends;
            return {TransferStatus::no_peer, 0};
        }
        const Deadline deadline(timeout);
        return noticing_loss(send_all(
            server_, bytes, [&](short events) { return wait(events, deadline); }, statistics_));
    }

    Transfer receive(std::span<std::byte> into, nanoseconds timeout) override {
        require(!into.empty(), "receive is given room");
        if (closed_) {
            return {TransferStatus::closed, 0};
        }
        const Deadline deadline(timeout);
        if (!connected(deadline)) {
            return {TransferStatus::timed_out, 0};
        }
        return noticing_loss(receive_some(
            server_, into, [&](short events) { return wait(events, deadline); }, statistics_));
    }

    bool wait_for_peer(nanoseconds timeout) override {
        return !closed_ && connected(Deadline(timeout));
    }

    void close() override {
        closed_ = true;
        connected_ = false;
        shut(server_);
    }

    TransportAddress address() const override { return address_; }

    std::string describe() const override {
        return fmt::format("{} (client, {})", to_text(address_),
                           closed_      ? "closed"
                           : connected_ ? "connected"
                                        : "not connected");
    }

    const TransportStatistics& statistics() const override { return statistics_; }

private:
    bool wait(short events, const Deadline& deadline) {
        pollfd fd{server_.native_handle(), events, 0};
        return wait_ready({&fd, 1}, deadline);
    }

    /// Goes on where the last call stopped: with the pause after a refusal, or a pending
    /// connection.
    bool connected(const Deadline& deadline) {
        while (!connected_) {
            if (!server_.is_open()) {
                const Deadline pause = deadline.sooner(next_try_.remaining());
                std::this_thread::sleep_for(pause.remaining());
                if (!next_try_.passed()) {
                    return false;
                }
                begin();
            }
            if (server_.is_open() && !wait(POLLOUT, deadline)) {
                return false;
            }
            finish();
        }
        return true;
    }

    // By hand: Asio's connect() would wait as long as the network does, two minutes and more.
    void begin() {
        server_.open(tcp::v4());
        make_ready(server_);
        if (::connect(server_.native_handle(), there_.data(),
                      static_cast<socklen_t>(there_.size())) != 0 &&
            errno != EINPROGRESS && errno != EINTR) {
            give_up(errno);
        }
    }

    void finish() {
        if (!server_.is_open()) {
            return;
        }
        int error = 0;
        socklen_t size = sizeof(error);
        getsockopt(server_.native_handle(), SOL_SOCKET, SO_ERROR, &error, &size);
        error_code ignored;
        // A port of the kernel's own range can be given to this very socket, which then meets
        // itself.
        if (error == 0 && server_.local_endpoint(ignored) == server_.remote_endpoint(ignored)) {
            error = ECONNREFUSED;
        }
        if (error != 0) {
            give_up(error);
            return;
        }
        connected_ = true;
        ++statistics_.peers;
    }

    void give_up(int error) {
        statistics_.last_error = error;
        shut(server_);
        next_try_ = Deadline(kRetry);
    }

    Transfer noticing_loss(Transfer transfer) {
        if (transfer.status == TransferStatus::peer_lost) {
            connected_ = false;
            shut(server_);
            ++statistics_.peers_lost;
        }
        return transfer;
    }

    TransportAddress address_;
    tcp::endpoint there_;
    boost::asio::io_context io_;
    tcp::socket server_;
    Deadline next_try_{nanoseconds(0)};
    TransportStatistics statistics_;
    bool connected_ = false;
    bool closed_ = false;
};

}  // namespace

std::unique_ptr<Transport> listen_tcp(const TransportAddress& address) {
    return std::make_unique<TcpServer>(address);
}

std::unique_ptr<Transport> connect_tcp(const TransportAddress& address) {
    return std::make_unique<TcpClient>(address);
}

}  // namespace limpet::wire
