// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace limpet::serve {

/// What has been sent to a client and has not yet gone out. Any thread puts in, the server's takes
/// out; of a bounded size, which is reserved at once: put() neither waits nor allocates.
class FrameQueue {
public:
    explicit FrameQueue(std::size_t most_bytes);

    enum class Kind : std::uint32_t {
        stream,  ///< binary; where there is no space, what was is dropped for what is
        kept,    ///< binary
        text     ///< kept
    };
    /// One frame made of `parts`. Frames that are dropped are counted.
    /// @return false where there is no space, though all that streams was dropped
    bool put(Kind kind, std::initializer_list<std::string_view> parts);

    struct Frame {
        bool text = false;
        std::string_view bytes;
    };
    /// The next frame, valid until the next call; false without any. The server's thread alone.
    [[nodiscard]] bool next(Frame& frame);

    [[nodiscard]] std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

private:
    void drop_stream();

    const std::size_t most_bytes_;
    std::mutex guards_filling_;
    std::vector<char> filling_;  ///< frames, each behind its size and kind
    std::size_t filled_ = 0;     ///< of it
    std::vector<char> leaving_;  ///< of the server's thread alone, as the next two
    std::size_t to_leave_ = 0;   ///< of it
    std::size_t left_ = 0;       ///< of that, gone out
    std::atomic<std::uint64_t> dropped_ = 0;
};

/// A client at the other end of a WebSocket. It may be held and sent to by any thread as long as
/// one likes; what is sent to one who has gone is dropped. Frames go out within some 10 ms.
class Session {
public:
    Session(std::size_t most_bytes, std::string subprotocol)
        : queue_(most_bytes), subprotocol_(std::move(subprotocol)) {}

    // Never wait, never allocate.
    /// @return false: dropped, the queue is full or the client has gone
    bool send_text(std::string_view text);
    bool send_binary(std::initializer_list<std::string_view> parts);
    /// Of many that follow one another, each older than the next: who reads slowly gets the
    /// newest ones.
    bool stream(std::initializer_list<std::string_view> parts);
    /// What a client has requested and no queue has space for, on the server's thread: one of any
    /// size, more up to 64 MiB in all. They go out when the queue is empty.
    /// @return false: too much waits already, or the client has gone
    bool send_large(std::string bytes);
    /// Ends the session once what has been sent is out.
    void close() { asked_to_close_ = true; }

    [[nodiscard]] bool is_open() const { return open_; }
    [[nodiscard]] const std::string& subprotocol() const { return subprotocol_; }
    /// Frames that had no space.
    [[nodiscard]] std::uint64_t dropped() const { return queue_.dropped(); }

private:
    friend class WebSocket;  // the server's end of it

    /// The next frame to go out, valid until the next call; false without any.
    [[nodiscard]] bool next(FrameQueue::Frame& frame);

    static constexpr std::size_t kMostLarge_bytes = std::size_t{64} << 20U;

    FrameQueue queue_;
    std::deque<std::string> large_;  ///< of the server's thread alone, as the next two
    std::size_t large_bytes_ = 0;    ///< of them
    std::string leaving_;
    std::string subprotocol_;
    std::atomic<bool> open_ = true, asked_to_close_ = false;
};

}  // namespace limpet::serve
