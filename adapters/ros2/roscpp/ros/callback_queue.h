// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace ros {

/// Calls that wait for the thread that is to make them.
class CallbackQueue {
public:
    void add(std::function<void()> call) {
        const std::lock_guard lock(mutex_);
        calls_.push_back(std::move(call));
        more_.notify_one();
    }
    /// Wakes the caller, who looks whether a timer is due.
    void poke() {
        const std::lock_guard lock(mutex_);
        poked_ = true;
        more_.notify_one();
    }
    /// Makes those that wait; without any waits for the first, or a poke.
    void call_available(std::chrono::steady_clock::duration patience) {
        std::deque<std::function<void()>> now;
        {
            std::unique_lock lock(mutex_);
            more_.wait_for(lock, patience, [this] { return poked_ || !calls_.empty(); });
            poked_ = false;
            now.swap(calls_);
        }
        for (const auto& call : now) {
            call();
        }
    }

private:
    std::mutex mutex_;
    std::condition_variable more_;
    std::deque<std::function<void()>> calls_;
    bool poked_ = false;
};

/// Makes a queue's calls in a separate thread; always one.
class AsyncSpinner {
public:
    AsyncSpinner(unsigned /*threads*/, CallbackQueue* queue) : queue_(queue) {}
    ~AsyncSpinner() { stop(); }
    AsyncSpinner(const AsyncSpinner&) = delete;
    AsyncSpinner& operator=(const AsyncSpinner&) = delete;

    void start() {
        thread_ = std::jthread([this](const std::stop_token& over) {
            while (!over.stop_requested()) {
                queue_->call_available(std::chrono::milliseconds(100));
            }
        });
    }
    void stop() {
        if (thread_.joinable()) {
            thread_.request_stop();
            queue_->poke();
            thread_.join();
        }
    }

private:
    CallbackQueue* queue_;
    std::jthread thread_;
};

}  // namespace ros
