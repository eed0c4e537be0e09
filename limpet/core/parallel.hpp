// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <system_error>
#include <vector>

namespace limpet {

/// Calls work(0), ..., work(count - 1) on `jobs` threads; each writes to a place of its own. An
/// exception stops what has not begun and is thrown here.
template <class Work>
void for_each_index(std::size_t count, int jobs, const Work& work) {
    std::atomic<std::size_t> next = 0;
    const auto take = [&] {
        try {
            for (std::size_t i = next++; i < count; i = next++) {
                work(i);
            }
        } catch (...) {
            next = count;
            throw;
        }
    };
    std::vector<std::future<void>> threads;
    const auto wanted = std::min(count, static_cast<std::size_t>(std::max(1, jobs)));
    try {
        threads.reserve(wanted);
        while (threads.size() < wanted) {
            threads.push_back(std::async(std::launch::async, take));
        }
    } catch (const std::system_error&) {  // no more threads to be had: those there are will do
        if (threads.empty()) {
            take();
        }
    }
    for (std::future<void>& thread : threads) {
        thread.get();  // the others end before their futures do
    }
}

}  // namespace limpet
