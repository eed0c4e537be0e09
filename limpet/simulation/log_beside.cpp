// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/log_beside.hpp"

#include <utility>

namespace limpet::simulation {
namespace {

/// A third of a second or so: waking a thread costs as much as some ticks do.
constexpr std::size_t kBatch = 256;

}  // namespace

LogBeside::LogBeside(FlightLog& log, std::shared_ptr<const FlightModel> model)
    : log_(log), model_(std::move(model)) {
    filling_.moments.reserve(kBatch);
    written_.moments.reserve(kBatch);
    thread_ = std::jthread([this](const std::stop_token& over) { work(over); });
}

LogBeside::~LogBeside() {
    try {
        finish();
    } catch (...) {  // the disk is full: what led here says more
        return;
    }
}

void LogBeside::tick(const FlightState& state, const guidance::EventList& events) {
    for (std::size_t k = 0; k < events.count; ++k) {
        filling_.events.push_back({filling_.moments.size(), events.events[k]});
    }
    filling_.moments.push_back(moment_of(state));
    filling_.moments.back().consistency = honesty_.next(*model_, state);
    if (filling_.moments.size() >= kBatch) {
        hand_over();
    }
}

void LogBeside::hand_over() {
    std::unique_lock lock(mutex_);
    settle(lock);
    std::swap(filling_, written_);
    filling_.moments.clear();
    filling_.events.clear();
    busy_ = true;
    changed_.notify_all();
}

void LogBeside::settle(std::unique_lock<std::mutex>& lock) {
    changed_.wait(lock, [this] { return !busy_; });
    if (failure_) {
        std::rethrow_exception(failure_);
    }
}

void LogBeside::finish() {
    hand_over();
    std::unique_lock lock(mutex_);
    settle(lock);
}

void LogBeside::work(const std::stop_token& over) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, over, [this] { return busy_; })) {
        lock.unlock();
        std::exception_ptr failure;
        try {
            write(written_);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        failure_ = failure;
        busy_ = false;
        changed_.notify_all();
    }
}

void LogBeside::write(const Batch& batch) {
    auto event = batch.events.begin();
    for (std::size_t k = 0; k < batch.moments.size(); ++k) {
        for (; event != batch.events.end() && event->moments_before == k; ++event) {
            log_.event(event->event);
        }
        log_.moment(*model_, batch.moments[k]);
    }
}

}  // namespace limpet::simulation
