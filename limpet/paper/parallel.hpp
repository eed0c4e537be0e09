// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace limpet::paper {

/// Calls work(0), ..., work(count - 1) on `jobs` threads; each writes to a place of its own. The
/// first exception stops what has not begun and is thrown here.
template <class Work>
void for_each_index(std::size_t count, int jobs, const Work& work) {
    std::atomic<std::size_t> next = 0;
    std::exception_ptr problem;
    std::mutex mutex;
    const auto take = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                work(i);
            } catch (...) {
                const std::lock_guard lock(mutex);
                problem = problem ? problem : std::current_exception();
                next = count;
            }
        }
    };
    std::vector<std::thread> threads;
    const auto wanted = std::min(count, static_cast<std::size_t>(std::max(1, jobs)));
    for (std::size_t i = 1; i < wanted; ++i) {
        threads.emplace_back(take);
    }
    take();
    for (std::thread& thread : threads) {
        thread.join();
    }
    if (problem) {
        std::rethrow_exception(problem);
    }
}

}  // namespace limpet::paper
